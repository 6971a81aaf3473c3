"""Stress below tractions on rings by finite elements, in the plane through z axis and load."""

from __future__ import annotations

from math import cos, pi
from typing import TYPE_CHECKING

import numpy as np

from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import StressField, StressPoints
from contact_scene.machine import one_thread

if TYPE_CHECKING:
    from fem_reference.stress import SectionField

RECOVERY = (
    "stress at the 2 x 2 Gauss points, extrapolated bilinearly to the nodes and averaged over the "
    "elements of one material"
)
NEAR = 5.0  # extent of the files in loaded radii; the mesh extends to hundreds
SHOWN = (2.0, 3.0)  # extent of figures to the sides and in depth, in loaded radii


@one_thread()
def stress_on_section(state: LoadedBodies, *, indenter: bool = False) -> StressField:
    """Compute the stress in one body below tractions on rings by finite elements.

    The result is the stress at the nodes of a new mesh. The mesh has as many elements over the
    loaded radius as the mesh of the contact solve has over the contact radius.

    state     bodies and tractions that cause the stress
    indenter  True for the stress in the indenter, False for the lower body

    Raises the errors of `fem_reference.stress.subsurface`.
    """
    from fem_reference.compliance.ring_edge import beyond_pressure
    from fem_reference.stress import SurfaceTractions, subsurface

    assert state.discretisation is not None
    tractions = SurfaceTractions(
        radii=state.axes["radii"],
        angles=state.axes.get("angles"),
        **state.tractions,
        rooted=state.no_root is None,
        edge=beyond_pressure(state.body, state.indenter),
    )
    # Fit the mesh to the radius that is loaded now, not to the largest one of the history.
    asked = state.discretisation.model_copy(update={"contact_radius": None})
    body = state.loaded_body(indenter)
    field = subsurface(body, tractions, asked, upper=indenter)
    radius = tractions.loaded_radius
    section = state.add_bulk_stress(_section_points(field), indenter)
    reach = NEAR * radius
    near = section.near(reach)
    assert section.cells is not None
    assert near.cells is not None
    return StressField(
        body,
        section,
        None,
        near,
        _axis_points(near, reach),
        None,
        "x along the load",
        (SHOWN[0] * radius, min(SHOWN[1] * radius, float(section.depth.max()))),
        {
            "loaded_radius": radius,
            "elements_per_radius": asked.elements_per_radius,
            "edges": tractions.edges.tolist(),
            "recovery": RECOVERY,
            "written_to": reach,
            "elements": len(section.cells[1]),
            "elements_written": len(near.cells[1]),
        },
        state.direction,
    )


def _section_points(field: SectionField) -> StressPoints:
    """Return the stress points of both halves of a finite element section through the z axis.

    One half is on the ray along the load, the other on the opposite ray. The components of
    cylindrical axes become those of x, along the load, y and z. `at_edge` is False everywhere,
    because the mesh reaches so far that it represents a half-space.
    """
    halves = (0.0, pi)
    count = field.points.shape[1]
    moved, stressed = [], []
    for theta in halves:
        side = cos(theta)
        u_r, u_theta, u_z = field.displacement(theta)
        rr, tt, zz, tz, rz, rt = field.stress(theta)
        moved.append(np.stack([side * u_r, side * u_theta, u_z]))
        stressed.append(np.stack([rr, tt, zz, side * tz, side * rz, rt]))
    nothing = np.zeros(len(halves) * count)
    return StressPoints(
        np.concatenate([cos(theta) * field.points[0] for theta in halves]),
        nothing,
        np.tile(field.points[1], len(halves)),
        np.tile(field.material, len(halves)),
        np.concatenate(moved, axis=1),
        np.concatenate(stressed, axis=1),
        at_edge=nothing > 0,
        cells=("quad9", np.concatenate([field.cells + k * count for k in range(len(halves))])),
    )


def _axis_points(section: StressPoints, reach: float) -> StressPoints:
    """Return the points on the z axis, downward, without the duplicates of the second half.

    section  points of both halves of the section
    reach    largest depth [length]
    """
    on_it = np.flatnonzero((section.x == 0.0) & (section.depth <= reach))
    places = np.stack([section.depth[on_it], section.material[on_it]])
    return section.select(on_it[np.unique(places, axis=1, return_index=True)[1]])
