"""Influence coefficients: surface displacement at a cell centre by a unit traction on one cell."""
