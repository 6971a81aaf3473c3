"""Frequency response functions (FRF): surface displacement per unit traction at one wavenumber."""
