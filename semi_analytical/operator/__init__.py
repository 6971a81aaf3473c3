"""Displacement operators and their approximate inverses on the full window or a reduced domain."""
