"""Verification report: HTML pages, JUnit table and Markdown summary.

All are rendered from the record `report.json`, so that a report can be rendered again from that
file alone.
"""
