"""Displacement and stress below and at the surface of a body, from tractions on surface cells."""

from semi_analytical.frf.depth import Level
from semi_analytical.stress.depths import (
    default_depths,
    interfaces,
)
from semi_analytical.stress.field import (
    SubsurfaceField,
    fields_by_level,
    refuse_beyond_memory,
    subsurface,
)
from semi_analytical.stress.near_edge import EdgeNotSeen, NearEdge, near_edge, near_surface

__all__ = [
    "EdgeNotSeen",
    "Level",
    "NearEdge",
    "SubsurfaceField",
    "default_depths",
    "fields_by_level",
    "interfaces",
    "near_edge",
    "near_surface",
    "refuse_beyond_memory",
    "subsurface",
]
