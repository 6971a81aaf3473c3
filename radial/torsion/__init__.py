"""Torsion: circumferential shear of a twisted contact."""
