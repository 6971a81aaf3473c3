"""Increments of coupled bodies: pressure and shear act on each other."""
