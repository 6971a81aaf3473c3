"""Compliance of an axisymmetric section: weak form, factorisation, condensation."""
