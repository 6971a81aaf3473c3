"""Compliance of the surface: normal and tangential displacement of rings and angles."""
