"""Operators from tractions to surface displacements, and their approximate inverses.

The fields are on the full window or on a reduced domain.
"""
