"""Stress below tractions on rings, in the plane of the load."""

from __future__ import annotations

from math import cos, pi
from typing import TYPE_CHECKING

import numpy as np

from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import StressField, StressPoints
from contact_scene.solver_errors import UnsupportedScene

if TYPE_CHECKING:
    from fem_reference.stress import SectionField

RECOVERY = (
    "stress at the 2 x 2 Gauss points, extrapolated bilinearly to the nodes and averaged over the "
    "elements of one material"
)
LISTED = 10.0  # loaded radii that tables reach
SHOWN = (2.0, 3.0)  # loaded radii to the sides and in depth


def stress_on_section(state: LoadedBodies, *, indenter: bool = False) -> StressField:
    """Stress at the nodes of a mesh of its own, as fine over the loaded circle as the contact was
    computed. Raises UnsupportedScene for tractions that no elements have found, and what
    `fem_reference.stress.subsurface` raises."""
    from fem_reference.stress import SurfaceTractions, subsurface

    if state.discretisation is None:
        raise UnsupportedScene(
            "the radial solver has no stress below the surface; solve the scene with another solver"
        )
    tractions = SurfaceTractions(
        radii=state.axes["radii"], angles=state.axes.get("angles"), **state.tractions
    )
    # Elements over the circle that is loaded now, not over the largest one.
    asked = state.discretisation.model_copy(update={"contact_radius": None})
    body = state.indenter if indenter else state.body
    field = subsurface(body, tractions, asked, upper=indenter)
    radius = tractions.loaded_radius
    section = _section(field)
    half = field.is_axisymmetric
    return StressField(
        section,
        None,
        section,
        _axis(section, LISTED * radius),
        None,
        "radius r" if half else "x along the load",
        ("r", "θ") if half else ("x", "y"),
        (SHOWN[0] * radius, min(SHOWN[1] * radius, float(section.depth.max()))),
        LISTED * radius,
        {
            "loaded_radius": radius,
            "elements_per_radius": asked.elements_per_radius,
            "recovery": RECOVERY,
        },
    )


def _section(field: SectionField) -> StressPoints:
    """One half where the angle does not matter, else both, the one behind the axis at negative x;
    nothing ends at the edge of the mesh, which stands for all beyond."""
    halves = (0.0,) if field.is_axisymmetric else (0.0, pi)
    count = field.points.shape[1]
    moved = []
    for theta in halves:
        u_r, u_theta, u_z = field.displacement(theta)
        moved.append(np.stack([cos(theta) * u_r, cos(theta) * u_theta, u_z]))
    nothing = np.zeros(len(halves) * count)
    return StressPoints(
        np.concatenate([cos(theta) * field.points[0] for theta in halves]),
        nothing,
        np.tile(field.points[1], len(halves)),
        np.tile(field.material, len(halves)),
        np.concatenate(moved, axis=1),
        np.concatenate([field.stress(theta) for theta in halves], axis=1),
        cylindrical=True,
        at_edge=nothing > 0,
        cells=("quad9", np.concatenate([field.cells + k * count for k in range(len(halves))])),
    )


def _axis(section: StressPoints, reach: float) -> StressPoints:
    """Points on the axis, downward, once each: both halves have them."""
    on_it = np.flatnonzero((section.x == 0.0) & (section.depth <= reach))
    places = np.stack([section.depth[on_it], section.material[on_it]])
    return section.chosen(on_it[np.unique(places, axis=1, return_index=True)[1]])
