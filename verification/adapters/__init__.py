"""Adapters that let each code solve the challenges by one interface, one module per code."""
