"""Refinement of any scene: orders of convergence, limits and what the levels leave open."""
