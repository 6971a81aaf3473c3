"""Responses of layered bodies to axisymmetric loads, and quadrature."""
