"""Solved states with their edges put inside the cells (deferred correction)."""
