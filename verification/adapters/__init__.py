"""Adapters of codes to the challenges, one module per code, with one interface."""
