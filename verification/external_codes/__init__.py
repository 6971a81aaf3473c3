"""Codes of others, run once beside ours; README.md says how, and what their numbers are worth."""
