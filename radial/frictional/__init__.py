"""Indentation with friction under a normal load: pressure and radial shear on rings."""
