"""Torsion: circumferential shear of a contact, in closed form, with a stick disc."""
