"""Stability study: which contacts the solvers can solve, over friction, load, coating, path and
scale."""
