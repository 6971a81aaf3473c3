"""Displacement and stress below the surface of a body under given surface tractions."""

from fem_reference.stress.section_field import SectionField
from fem_reference.stress.subsurface import subsurface
from fem_reference.stress.surface_tractions import SurfaceTractions

__all__ = ["SectionField", "SurfaceTractions", "subsurface"]
