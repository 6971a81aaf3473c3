"""Frictional contact of points: pressure and shear from compliance, gap, friction and loads.

The package knows arrays and functions only. Each solver passes the map from tractions to
displacements of its points: cells, nodes or rings. Modules are imported directly.
"""
