"""Influence coefficients: displacement at a cell centre by a unit traction on one cell of the
surface."""
