"""Tangential loading of coupled bodies: Coulomb's law at points (r, θ), elasticity by harmonics."""
