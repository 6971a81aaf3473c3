"""Frequency response functions: surface displacement per unit traction at one wavenumber."""
