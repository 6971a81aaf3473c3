"""Convergence orders under refinement, and estimates of the remaining error."""
