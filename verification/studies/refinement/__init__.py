"""Convergence studies of a user's scene: limit under refinement, its uncertainty,
remaining error."""
