"""Tractions to displacements and approximately back, on the full window or a reduced domain."""
