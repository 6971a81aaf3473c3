"""Displacement and stress of a section under the tractions on its surface."""

from fem_reference.stress.section_field import SectionField
from fem_reference.stress.subsurface import subsurface
from fem_reference.stress.surface_tractions import SurfaceTractions

__all__ = ["SectionField", "SurfaceTractions", "subsurface"]
