"""Displacement and stress below the surface."""
