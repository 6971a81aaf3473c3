"""Responses of layered bodies to axisymmetric loads, and the quadrature of their integrals."""
