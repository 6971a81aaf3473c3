"""Displacement and stress below the surface."""

from semi_analytical.frf.depth import Level
from semi_analytical.stress.field import (
    Extreme,
    SubsurfaceField,
    subsurface,
    subsurface_section,
)
from semi_analytical.stress.invariants import greatest_shear, principal_stresses, von_mises
from semi_analytical.stress.levels import default_depths, interfaces

__all__ = [
    "Extreme",
    "Level",
    "SubsurfaceField",
    "default_depths",
    "greatest_shear",
    "interfaces",
    "principal_stresses",
    "subsurface",
    "subsurface_section",
    "von_mises",
]
