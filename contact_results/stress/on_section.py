"""Stress below tractions on rings by finite elements, at the nodes of planes through the z axis.

The plane through z axis and load is shown. The largest stresses are searched in others as well.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import cos, pi, sin
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from contact_results.stress.body_response import BodyResponse
from contact_results.stress.points import StressField, StressPoints
from contact_scene.array_types import Field
from contact_scene.machine import one_thread
from contact_scene.quantities.stated_error import Part
from contact_scene.solver_errors import UnsupportedScene

if TYPE_CHECKING:
    from fem_reference.stress import SectionField
    from semi_analytical.frf.depth import Level

NEAR = 5.0  # extent of the files in loaded radii; the mesh extends to hundreds
# Planes through the z axis over half a circle. A stress that varies like cos 2θ is found to 2 % of
# its variation.
PLANES = 16
SHOWN = (2.0, 3.0)  # extent of figures to the sides and in depth, in loaded radii


@dataclass(frozen=True, eq=False)
class OnSection(BodyResponse):
    """One body below tractions on rings, by finite elements on its section.

    divided  False for elements of twice the size everywhere, also far from the contact
    widened  factor of the outer radius and the depth of the section
    """

    part: ClassVar[Part] = "elements"
    divided: bool = True
    widened: float = 1.0

    @one_thread()
    def stress(self, depths: Sequence[float] | None = None, *, volume: bool = False) -> StressField:
        """Compute the stress at the nodes of a new mesh; depths and volume have no effect.

        The mesh has as many elements over the loaded radius as the mesh of the contact solve has
        over the contact radius. Raises the errors of `fem_reference.stress.subsurface`.
        """
        from fem_reference.compliance.ring_edge import beyond_pressure
        from fem_reference.mesh.element_order import ELEMENTS
        from fem_reference.stress import SurfaceTractions, subsurface

        state, asked = self.state, self.state.discretisation
        assert asked is not None
        tractions = SurfaceTractions(
            radii=state.axes[state.radial],
            angles=state.axes.get("angles"),
            **state.tractions,
            rooted=state.no_root is None,
            edge=beyond_pressure(state.body, state.indenter),
            plane=state.of_strips,
            normal_force=state.normal_force,
        )
        # Fit the mesh to the radius that is loaded now, not to the largest one of the history.
        asked = asked.model_copy(update={"contact_radius": None})
        field = subsurface(
            self.body,
            tractions,
            asked,
            upper=self.indenter,
            divided=self.divided,
            widened=self.widened,
        )
        radius = tractions.loaded_radius
        section = state.add_bulk_stress(_section_points(field), self.indenter)
        if state.of_strips:  # the displacement below a line contact is not stated
            section = replace(section, displacement=np.full_like(section.displacement, np.nan))
        reach = NEAR * radius
        near = section.near(reach)
        others: list[StressPoints] = []
        if any(part.motion.harmonic for part in field.parts):
            # Without a mirror plane, the stress differs on the two halves of the circle.
            turns = 2 if any(part.turned for part in field.parts) else 1
            close = np.max(np.abs(field.points), axis=0) <= reach
            for theta in pi * np.arange(1, turns * PLANES) / PLANES:
                plane = _ray_points(field, theta).select(close)
                others.append(state.add_bulk_stress(plane, self.indenter))
        assert section.cells is not None
        assert near.cells is not None
        return StressField(
            self.body,
            StressPoints.concatenate([section, *others]),
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
                "recovery": ELEMENTS.recovery,
                "written_to": reach,
                "elements": len(section.cells[1]),
                "elements_written": len(near.cells[1]),
            },
            state.direction,
        )

    def stress_at(self, x: Field, y: Field, levels: Sequence[Level]) -> StressPoints:
        raise UnsupportedScene(
            "finite elements give the stress at their nodes in one plane; solve the scene with "
            "--solver semi-analytical or radial"
        )

    def compared(self) -> Sequence[OnSection]:
        return [self.on_larger_elements(every) for every in (1, 2)]

    def on_wider_section(self, factor: float) -> OnSection:
        return replace(self.on_larger_elements(), widened=factor)

    def on_larger_elements(self, every: int = 1) -> OnSection:
        """Return the response with elements of twice the size and fewer traction rings.

        A mesh of half the elements per radius would not do: far from the contact, its elements are
        at most √2 times as large, because their growth is proportional to the root of their size.

        every  1 to keep the tractions of all rings, 2 to keep those of every second ring
        """
        state = self.state
        radii = state.axes[state.radial]
        # An additional unloaded ring preserves the last ring if their number is even.
        pad = (len(radii) - 1) % every
        more = [*radii, *[2 * radii[-1] - radii[-2]] * pad]
        tractions = {}
        for name, field in state.tractions.items():
            pads = [(0, len(more) - len(field)), *[(0, 0)] * (field.ndim - 1)]
            tractions[name] = np.asarray(np.pad(field, pads)[::every])
        coarse = replace(
            state,
            axes={**state.axes, state.radial: np.array(more[::every])},
            tractions=tractions,
        )
        return replace(self, state=coarse, divided=False)

    def drawn_stress(self) -> None:
        """Return None: the mesh would take longer than the run."""


def _section_points(field: SectionField) -> StressPoints:
    """Return the stress points of a section through the z axis, on the rays along the load
    and opposite to it."""
    halves = [_ray_points(field, theta) for theta in (0.0, pi)]
    kind, cells = field.cells
    both = np.concatenate([cells, cells + field.points.shape[1]])
    return replace(StressPoints.concatenate(halves), cells=(kind, both))


def _ray_points(field: SectionField, theta: float) -> StressPoints:
    """Return the stress points on the ray at an angle from the load, in axes with x along it."""
    r, depth = field.points
    none = np.zeros_like(r)
    moved, stressed = field.displacement(theta), field.stress(theta)
    on_ray = StressPoints(r, none, depth, field.material, moved, stressed, at_edge=none > 0)
    return on_ray.rotate_to_scene((cos(theta), 0.0 if theta == pi else sin(theta)))


def _axis_points(section: StressPoints, reach: float) -> StressPoints:
    """Return the points on the z axis to the depth `reach`, each once."""
    on_it = np.flatnonzero((section.x == 0.0) & (section.depth <= reach))
    places = np.stack([section.depth[on_it], section.material[on_it]])
    return section.select(on_it[np.unique(places, axis=1, return_index=True)[1]])
