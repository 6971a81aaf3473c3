"""Convergence studies of a user's scene: limit, its uncertainty and the error that remains."""
