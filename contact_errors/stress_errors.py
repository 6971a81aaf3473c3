"""Errors of the largest stresses, from tractions on half of the cells, elements or points.

Each stress of a region has up to two places where it may be largest: inside, and at the surface
next to the edge of the contact. The error of the largest stress found is

    max over these places (value + its error) - largest stress found

Inside the stress converges with order 2; next to an edge that is not fitted with order ½. Half a
cell inside the edge of tractions that end in a square root, the tensile stress lacks m^-½ of its
value on m cells per contact radius. On a fitted edge two fits are compared, and the largest stress
with its neighbours along the edge, as they vary little over a cell. An edge that is not fitted and
may have the largest stress leaves the stress not converged. The von Mises stress is not largest at
an edge without shear, and has no such place unless it is found there.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

from contact_errors.error_formula import BELIEVED, LARGEST_SHARE, ROOT, SMOOTH, UNKNOWN, stated
from contact_results.stress.extremes import Extreme, extremes
from contact_results.stress.loaded_bodies import LoadedBodies, state_of_result
from contact_results.stress.on_cells import stress_on_cells
from contact_results.stress.on_section import stress_on_section
from contact_results.stress.points import FittedEdge, StressField, StressPoints
from contact_scene import Body
from contact_scene.accuracy import LARGEST_TENSION
from contact_scene.stated_error import Part, StatedError, StatedErrors

Field = NDArray[np.float64]
Found = Mapping[tuple[str, str], Extreme]

# Regions that the edge of the contact belongs to.
AT_SURFACE = "body", "layer 1"
# Cells from the surface within which a stress depends on the edge of the tractions.
NEAR = 2.0
COARSE = 2.0  # coarsening factor of the tractions
# Of double precision, with the cancellation in sums of a few hundred waves.
PRECISION = 1e-13


@dataclass(frozen=True)
class TensileStress:
    """Largest principal stress of the body [force/length^2] with its error and order."""

    value: float
    error: StatedError
    order: float = SMOOTH


def largest_tensile_stress(result: object, errors: StatedErrors, step: int) -> TensileStress | None:
    """Compute it at the end of a load step, from 1; None for a rigid body."""
    state = state_of_result(result, step, errors)  # type: ignore[arg-type]
    if not state.body.deforms:
        return None
    field = stress_on_cells(state)
    key = ("body", LARGEST_TENSION)
    (found,) = (e for e in extremes(field, state.body) if (e.region, e.measure) == key)
    (error,) = stress_errors(state, field, [found])
    near = found.depth < NEAR * _side(state)
    return TensileStress(abs(found.value), error, ROOT if near and field.edge is None else SMOOTH)


def stress_errors(
    state: LoadedBodies, field: StressField, found: Sequence[Extreme], *, indenter: bool = False
) -> tuple[StatedError, ...]:
    """Estimate the errors of the largest stresses that were found in a field.

    The error of the tractions counts as far as increments cause it; cells cause far less than
    their coarse representation does in the stress.
    """
    if state.pressed is not None:
        return _on_disc(state, found, indenter)
    body = state.indenter if indenter else state.body
    if state.on_rings:
        coarse = stress_on_section(on_half_the_rings(state), indenter=indenter)
        part: Part = "elements"
        fitted, edge = bool(field.how["edges"]), None
    else:
        depths = np.unique(field.points.depth).tolist()
        wide = on_wide_cells(state)
        coarse = stress_on_cells(wide, indenter=indenter, depths=depths, see_edge=False)
        part = "cells"
        edge = field.edge
        fitted = edge is not None and edge.determined
    places = _Places(field, coarse, body, NEAR * _side(state), _per_radius(state), fitted, edge)
    errors = []
    for extreme in found:
        size, converged = places.error(extreme)
        if size is None:
            errors.append(UNKNOWN)
            continue
        parts: dict[Part, Field] = {part: np.array([size])}
        if state.by_increments:
            parts["increments"] = np.array([state.by_increments * abs(extreme.value)])
        small = size <= LARGEST_SHARE * abs(extreme.value)
        errors.append(stated(parts, converged and small and not extreme.at_window_edge))
    return tuple(errors)


@dataclass(frozen=True)
class _Places:
    """Places where a stress may be largest, on fine and on coarse tractions.

    near    depth of the places at the surface [length]
    count   cells per contact radius
    fitted  whether the edge of the contact is fitted
    edge    as far as it was fitted to cells
    """

    field: StressField
    coarse: StressField
    body: Body
    near: float
    count: float
    fitted: bool
    edge: FittedEdge | None

    def error(self, found: Extreme) -> tuple[float | None, bool]:
        """Error of a largest stress, None where unknown; and whether it has converged."""
        candidates = []
        if (inside := self._inside(found)) is not None:
            candidates.append(inside)
        shallow = found.on_edge or found.depth < self.near
        edge = self._at_edge(found) if shallow or found.measure == LARGEST_TENSION else None
        if edge is not None:
            candidates.append(edge)
        if not candidates:
            return None, False
        size = max(value + error for value, error in candidates) - found.value
        open_edge = edge is not None and not self.fitted and sum(edge) > found.value
        return size, not (open_edge and found.measure == LARGEST_TENSION)

    def _inside(self, found: Extreme) -> tuple[float, float] | None:
        """Largest value below the surface, parabolas between points included, and its error."""
        here, there = (self._largest(one, found, deep=True) for one in (self.field, self.coarse))
        if here is None or there is None:
            return None
        between, between_there = beyond(self.field.points, here), beyond(self.coarse.points, there)
        change = abs(here.value + between - there.value - between_there)
        return here.value, between / BELIEVED + change / _growth(SMOOTH)

    def _at_edge(self, found: Extreme) -> tuple[float, float] | None:
        """Largest value next to the edge, and its error."""
        here, there = (self._largest(one, found, deep=False) for one in (self.field, self.coarse))
        if here is None:
            return None
        value = max(here.value, found.value if found.on_edge else 0.0)
        if self.edge is not None and found.region in AT_SURFACE:
            value = max(value, float(np.max(self.edge.points.measures[found.measure])))
            fits = max(self.edge.apart / _growth(ROOT), self.edge.least)
            return value, max(fits, _jump(self.edge.points, found.measure))
        change = abs(value) if there is None else abs(value - there.value)
        error = change / _growth(SMOOTH if self.fitted else ROOT)
        if found.measure == LARGEST_TENSION and not self.fitted:
            error = max(error, value / (sqrt(self.count) - 1))
        return value, error

    def _largest(self, field: StressField, found: Extreme, *, deep: bool) -> Extreme | None:
        """Largest value of a measure in a region, below or above the depth of the edge."""
        every = self._fine if field is self.field else self._coarse
        return every[deep].get((found.region, found.measure))

    @cached_property
    def _fine(self) -> tuple[Found, Found]:
        return self._both(self.field)

    @cached_property
    def _coarse(self) -> tuple[Found, Found]:
        return self._both(self.coarse)

    def _both(self, field: StressField) -> tuple[Found, Found]:
        """Largest stresses of all regions near the surface, and below."""
        near = field.points.depth < self.near
        found: list[Found] = []
        for places, edge in ((near, field.edge), (~near, None)):
            points = field.points.chosen(places)
            if edge is not None:
                points = points if points.x.size else edge.points
            some = replace(field, points=points, edge=edge if points.x.size else None)
            found.append({(e.region, e.measure): e for e in extremes(some, self.body)})
        return found[0], found[1]


def _jump(edge: StressPoints, measure: str) -> float:
    """Largest difference of the largest stress on an edge from points within `NEAR` along it.

    The exact stress varies little over so few cells, unlike the error of the tractions.
    """
    values = edge.measures[measure]
    around = values[np.argsort(np.arctan2(edge.y - edge.y.mean(), edge.x - edge.x.mean()))]
    steps = np.arange(-int(NEAR), int(NEAR) + 1)
    near = np.take(around, np.argmax(around) + steps, mode="wrap")
    return float(np.max(np.abs(np.max(values) - near)))


def _growth(order: float) -> float:
    return float(COARSE ** (BELIEVED * order) - 1)


def _side(state: LoadedBodies) -> float:
    """Side of a cell, or of a ring [length]."""
    if not state.on_rings:
        x, y = state.axes["x"], state.axes["y"]
        return sqrt(float((x[1] - x[0]) * (y[1] - y[0])))
    radii = state.axes["radii"]
    return float(radii[1] - radii[0])


def _per_radius(state: LoadedBodies) -> float:
    """Cells or elements per contact radius."""
    pressure = state.tractions["pressure"]
    if state.on_rings:
        rings = pressure.reshape(len(state.axes["radii"]), -1).max(axis=1)
        return max(float(np.count_nonzero(rings > 0)), 2.0)
    return max(sqrt(np.count_nonzero(pressure) / pi), 2.0)


def on_wide_cells(state: LoadedBodies) -> LoadedBodies:
    """Return equal forces on cells twice as wide, whose tractions are the means of four."""
    pads = {axis: len(state.axes[axis]) % 2 for axis in ("x", "y")}
    axes = {axis: _pairs(state.axes[axis], pads[axis]) for axis in ("x", "y")}
    return replace(
        state,
        axes=axes,
        tractions={name: _means(field, *pads.values()) for name, field in state.tractions.items()},
    )


def _pairs(centres: Field, pad: int) -> Field:
    """Centres of pairs of cells; an odd cell gets a partner behind it."""
    h = centres[1] - centres[0]
    return np.asarray(centres[::2] + h / 2 if pad else (centres[::2] + centres[1::2]) / 2)


def _means(field: Field, pad_x: int, pad_y: int) -> Field:
    lead = [(0, 0)] * (field.ndim - 2)
    even = np.pad(field, [*lead, (0, pad_x), (0, pad_y)])
    return np.asarray(
        (even[..., ::2, ::2] + even[..., 1::2, ::2] + even[..., ::2, 1::2] + even[..., 1::2, 1::2])
        / 4
    )


def on_half_the_rings(state: LoadedBodies) -> LoadedBodies:
    """Return the tractions of every second ring, linear in between, for half of the elements."""
    asked, radii = state.discretisation, state.axes["radii"]
    assert asked is not None
    if len(radii) % 2 == 0:
        # One unloaded ring more keeps the last one.
        radii = np.append(radii, 2 * radii[-1] - radii[-2])
    count = max(2, asked.elements_per_radius // 2)
    tractions = {}
    for name, field in state.tractions.items():
        pads = [(0, len(radii) - len(field)), *[(0, 0)] * (field.ndim - 1)]
        tractions[name] = np.asarray(np.pad(field, pads)[::2])
    return replace(
        state,
        axes={**state.axes, "radii": radii[::2]},
        tractions=tractions,
        discretisation=asked.model_copy(update={"elements_per_radius": count}),
    )


def beyond(points: StressPoints, extreme: Extreme) -> float:
    """Excess of a stress between the points over its largest value at a point.

    It is that of the parabolas through the largest value and its neighbours, in depth and along x
    and y, within one material [force/length^2]; 0 for points without a grid.
    """
    values = points.measures[extreme.measure]
    if values.ndim < 3:
        return 0.0
    here = (values == extreme.value) & (points.depth == extreme.depth)
    place = [int(n) for n in np.unravel_index(int(np.argmax(here)), values.shape)]
    found = 0.0
    for axis, places in enumerate((points.depth, points.x, points.y)):
        n = place[axis]
        if not 0 < n < values.shape[axis] - 1:
            continue
        x, f, material = (
            np.array([field[(*place[:axis], n + step, *place[axis + 1 :])] for step in (-1, 0, 1)])
            for field in (places, values, points.material)
        )
        if np.ptp(material) == 0:
            found += above_the_middle(x - x[1], f)
    return found


def above_the_middle(x: Field, f: Field) -> float:
    """Height of the parabola through three values above the middle one, which is at zero."""
    left, right = (f[0] - f[1]) / x[0], (f[2] - f[1]) / x[2]
    bend = (right - left) / (x[2] - x[0])
    slope = left - bend * x[0]
    return float(-(slope**2) / (4 * bend)) if bend < 0 else 0.0


def _on_disc(
    state: LoadedBodies, found: Sequence[Extreme], indenter: bool
) -> tuple[StatedError, ...]:
    """Errors below the tractions of `radial`: searched again with twice the orders and points."""
    from contact_results.stress.radial_body import RadialBody, is_sheared

    sheared = is_sheared(state)
    body = RadialBody.of(state, indenter, int(COARSE))
    errors: dict[tuple[str, float, float, float, float], StatedError] = {}
    for e in reversed(found):  # the largest of the body is the largest of a layer
        if e.region in body.parts.named:
            again = float(np.max(body.largest(e).measures[e.measure]))
            size = abs(again - e.value) / abs(COARSE ** (-BELIEVED * SMOOTH) - 1)
            parts: dict[Part, Field] = {"quadrature": np.array([size + PRECISION * abs(e.value)])}
            if sheared and state.by_increments:
                parts["increments"] = np.array([state.by_increments * abs(e.value)])
            errors[_place(e)] = stated(parts, not e.at_window_edge)
    return tuple(errors.get(_place(e), UNKNOWN) for e in found)


def _place(e: Extreme) -> tuple[str, float, float, float, float]:
    return e.measure, e.value, e.x, e.y, e.depth
