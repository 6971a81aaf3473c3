"""Meshes of a section: its outline, graded by ourselves or by gmsh."""
