"""Frictional contact of points: pressure and shear from compliance, gap, friction and loads.

The package depends on arrays and functions only. Each solver passes the function from tractions to
displacements of its points: cells, nodes or rings. Modules are imported directly.
"""
