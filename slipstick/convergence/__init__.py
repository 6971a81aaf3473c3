"""Convergence of a user's scene under refinement of every discretisation parameter."""
