"""Frequency response functions (FRF): surface displacement per unit traction at one wavenumber.

The bodies are layers on a half-space or a rigid base.
"""
