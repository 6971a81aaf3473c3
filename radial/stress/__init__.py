"""Displacement and stress below the surface, from the pressure and shear of a contact."""
