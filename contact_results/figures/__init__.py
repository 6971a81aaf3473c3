"""Figures of a run; each file draws one of them as a matplotlib Figure and saves nothing."""
