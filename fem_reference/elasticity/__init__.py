"""Elasticity of one axisymmetric body: weak form, factorisation and compliance of its surface."""
