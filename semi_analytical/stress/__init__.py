"""Displacement and stress below the surface."""

from semi_analytical.frf.depth import Level
from semi_analytical.stress.field import SubsurfaceField, subsurface, subsurface_section
from semi_analytical.stress.levels import default_depths, interfaces

__all__ = [
    "Level",
    "SubsurfaceField",
    "default_depths",
    "interfaces",
    "subsurface",
    "subsurface_section",
]
