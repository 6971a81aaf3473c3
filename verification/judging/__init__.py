"""Verdicts of verification cases."""
