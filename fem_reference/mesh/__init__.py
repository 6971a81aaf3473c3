"""Meshes of the meridional section of a body: outline, and graded rectangles."""
