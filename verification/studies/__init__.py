"""Measurements for the report: what a choice costs in accuracy."""
