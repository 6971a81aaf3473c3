"""Torsion: shear along the circles of a contact that is twisted."""
