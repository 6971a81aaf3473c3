"""Figures of a run and of a stress, drawn with matplotlib."""
