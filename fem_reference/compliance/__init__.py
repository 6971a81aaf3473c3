"""Compliance of the contact surface: displacement of rings and of points per traction on them.

A ring is a circle around the axis on the surface. A ray is the set of surface points at one angle.
"""
