"""Verification report: its pages, its table for machines (JUnit) and its texts.

All are rendered from the record `report.json`, so that a report can be rendered again from that
file alone.
"""
