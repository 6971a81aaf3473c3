"""Stress below the tractions of the radial solver, in a plane through the z axis."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import hypot
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from contact_results.stress.body_response import BodyResponse
from contact_results.stress.points import MEASURES, StressField, StressPoints
from contact_results.stress.radial_body import RadialBody, is_sheared
from contact_results.stress.stress_maxima import Extreme, extremes, interface_sides
from contact_scene.array_types import Field
from contact_scene.machine import one_thread
from contact_scene.quantities.stated_error import Part

if TYPE_CHECKING:
    from semi_analytical.frf.depth import Level

# Factor of the reach of the points beside a contact whose largest stresses lie at their outer end.
WIDER = 3.0
# Thickness of all layers in contact radii up to which a wider section does not look for tension of
# interfaces: its waves, as short as the thickness, would take most of the time and memory.
LEAST_THICKNESS = 0.1
SHOWN = 3.0  # extent of figures to the sides and in depth, in contact radii


@dataclass(frozen=True, eq=False)
class OnDisc(BodyResponse):
    """One body below the tractions of the radial solver.

    fineness  multiple of the numbers of polynomials and quadrature points
    measures  names of the stress measures whose maxima are refined
    """

    fineness: int = 1
    measures: Collection[str] = tuple(MEASURES)

    part: ClassVar[Part] = "quadrature"

    @cached_property
    def radial_body(self) -> RadialBody:
        """The body with the functions that compute its stress.

        Raises UnsupportedScene as `RadialBody.from_state` does.
        """
        return RadialBody.from_state(self.state, self.indenter, self.fineness)

    @one_thread()
    def stress(self, depths: Sequence[float] | None = None, *, volume: bool = False) -> StressField:
        """Compute the stress in the plane of the load, on a grid of positions and depths.

        Without given depths, the maxima are refined. Both sides of every interface are always
        included. A volume has no effect.
        """
        body = self.radial_body
        levels, x, radius = tuple(body.parts.stress_levels(depths)), body.section, body.parts.radius
        grid = body.stress_points(levels, x, np.zeros_like(x))
        whole = _both_sides(grid) if body.is_round else grid
        section = whole.add_cells()
        found = [grid.flattened, *([] if body.is_round else [body.beside(levels).flattened])]
        field = StressField(
            self.body,
            StressPoints.concatenate(found),
            None,
            section,
            section.select(section.x == 0),
            None,
            "x at y = 0" if body.is_round else "x along the load",
            (SHOWN * radius, min(SHOWN * radius, float(np.max(section.depth)))),
            {
                "contact_radius": radius,
                "first_depth": body.parts.first,
                "edge_from": body.centre - radius,
                "edge_to": body.centre + radius,
            },
            body.direction,
        )
        field, wide = self._beyond_section(field, body)
        if depths is not None:
            return field
        centre_x, centre_y = (body.centre * component for component in body.direction)
        inner = (1 - 1e-9) * body.reach * radius  # at its end, the largest may lie farther out
        nearer = [
            (body if hypot(one.x - centre_x, one.y - centre_y) < inner else wide).largest(one)
            for one in extremes(field)
            if one.region in body.parts.named and one.measure in self.measures
        ]
        return replace(field, points=StressPoints.concatenate([field.points, *nearer]))

    def _beyond_section(
        self, field: StressField, body: RadialBody
    ) -> tuple[StressField, RadialBody]:
        """Add points beyond the section at interfaces, and where a largest stress lies at its end.

        The shear at the interface of a thick layer is largest at about half its thickness from the
        axis. The tension of an interface may begin farther out only: a first wider section looks
        for it, but not below thin layers. The reach grows until the largest stresses that decay lie
        within it.

        Returns the field, and the body with this reach.
        """
        from semi_analytical.frf.depth import Level
        from semi_analytical.frf.stack import stack_of
        from semi_analytical.stress.strips import spread

        thickness = sum(layer.thickness for layer in self.body.layers)
        looked_for: set[float] = set()
        if thickness > LEAST_THICKNESS * body.parts.radius:
            looked_for = {depth for _, _, depth, _ in interface_sides(self.body)}
        while True:
            points, ends = field.points, body.reach * body.parts.radius
            distance = np.hypot(points.x - body.centre, points.y)
            outer = points.at_edge & (distance >= (1 - 1e-9) * ends)
            outer &= points.depth != body.parts.deepest
            measures = points.measures
            largest = [
                _index_of(one, points, measures)
                for one in extremes(field)
                if one.measure in self.decaying
            ]
            far = looked_for | {float(points.depth[k]) for k in largest if outer[k]}
            looked_for = set()
            deepest = max(far, default=0.0)
            if not far or ends > spread(stack_of(self.body), body.parts.radius, deepest):
                break
            body = RadialBody.from_state(
                self.state, self.indenter, self.fineness, WIDER * body.reach
            )
            followed = outer & np.isin(points.depth, [*far])
            both_sides = zip(points.depth[followed], points.material[followed], strict=True)
            levels = [Level(float(depth), int(layer)) for depth, layer in sorted({*both_sides})]
            x = body.section[np.abs(body.section - body.centre) > ends]
            beyond = body.stress_points(levels, x, np.zeros_like(x)).flattened
            inner = replace(points, at_edge=points.at_edge & ~followed)
            field = replace(field, points=StressPoints.concatenate([inner, beyond]))
        return field, body

    @one_thread()
    def stress_at(self, x: Field, y: Field, levels: Sequence[Level]) -> StressPoints:
        body = self.radial_body
        farthest = float(np.max(np.hypot(x, y))) + abs(body.centre)
        if farthest > body.reach * body.parts.radius:
            reach = farthest / body.parts.radius
            body = RadialBody.from_state(self.state, self.indenter, self.fineness, reach)
        c, s = body.direction
        along, across = c * x + s * y, c * y - s * x
        found = []
        for px, py, level in zip(along, across, levels, strict=True):
            if body.is_round:
                r = np.hypot(px, py)
                point = body.stress_points([level], np.array([r]), np.zeros(1)).flattened
                found.append(point.rotate_to_scene((px / r, py / r) if r else (1.0, 0.0)))
            else:
                found.append(body.stress_points([level], np.array([px]), np.array([py])).flattened)
        return StressPoints.concatenate(found).rotate_to_scene(body.direction)

    def contains(self, region: str, other: str) -> bool:
        """Return True if a region of the body contains another one, or is the same."""
        named = self.radial_body.parts.named
        if region not in named:  # the whole body
            return True
        (layer, top, bottom), (within, highest, lowest) = (
            named[region],
            named.get(other, (-1, 0, 0)),
        )
        return layer == within and top <= highest and lowest <= bottom

    @one_thread()
    def values_near(
        self, found: Sequence[Extreme], levels: Sequence[Level], moves: Sequence[bool]
    ) -> list[float]:
        """Compute the values of largest stresses that were found below other tractions.

        found   largest stresses, with their places and measures
        levels  depth and layer of each of them
        moves   True for those whose place depends on the tractions: the largest value next to it is
                searched
        """
        x, y = np.array([(each.x, each.y) for each in found]).T
        measures = self.stress_at(x, y, levels).measures
        values = [float(measures[each.measure][k]) for k, each in enumerate(found)]
        body = self.radial_body
        searched: dict[tuple[str, float, float, float], float] = {}
        centre_x, centre_y = (body.centre * component for component in body.direction)
        inside = np.hypot(x - centre_x, y - centre_y) < body.reach * body.parts.radius
        for k, (each, free) in enumerate(zip(found, inside & moves, strict=True)):
            if free and each.region in body.parts.named:
                near = float(np.max(body.largest(each).measures[each.measure]))
                place = each.measure, each.x, each.y, each.depth
                searched[place] = max(near, searched.get(place, near))
                values[k] = near
        # The largest stress of the whole body is that of one of its regions.
        for k, each in enumerate(found):
            if each.region not in body.parts.named:
                place = each.measure, each.x, each.y, each.depth
                values[k] = searched.get(place, values[k])
        return values

    def compared(self) -> Sequence[OnDisc]:
        return [replace(self, fineness=2 * self.fineness)]

    def drawn_stress(self) -> StressField | None:
        return None if is_sheared(self.state) else self.stress()


def _index_of(extreme: Extreme, points: StressPoints, measures: Mapping[str, Field]) -> int:
    at_value = measures[extreme.measure] == extreme.value
    return int(np.argmax((points.depth == extreme.depth) & at_value))


def _both_sides(right: StressPoints) -> StressPoints:
    """Extend points (levels, n) from x >= 0 to x < 0,
    where r points along -x and θ along -y, so that signs of components change."""
    behind = replace(
        right,
        x=-right.x,
        displacement=right.displacement * np.array([-1.0, -1, 1])[:, None, None],
        stress=right.stress * np.array([1.0, 1, 1, -1, -1, 1])[:, None, None],
    )
    return StressPoints.concatenate([behind.select_columns(slice(None, 0, -1)), right])
