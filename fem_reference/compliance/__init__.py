"""Compliance of the contact surface: displacement of rings and of points per traction on them."""
