"""Stress below a contact, for the results of any solver: points, largest values, files."""
