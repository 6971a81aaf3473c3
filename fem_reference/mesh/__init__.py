"""Meshes of the meridional section of a body: outline, graded rectangles, and gmsh."""
