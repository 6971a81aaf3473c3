"""Figures of a run and of a stress, drawn with matplotlib, and their HTML pages."""
