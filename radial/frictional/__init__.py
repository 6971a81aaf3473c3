"""Indentation with friction: pressure and radial shear on rings."""
