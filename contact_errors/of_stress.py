"""Errors of the largest stresses: by another fit of the edge of the contact where there is
one, else by the same tractions on cells twice as wide, or by more orders and points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

from contact_errors import estimate
from contact_errors.rules import AT_EDGE, INTERIOR, TENSION, Rule
from contact_errors.stress_on_rings import ring_stress_errors
from contact_results.stress.extremes import Extreme, extremes
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.on_cells import stress_on_cells
from contact_results.stress.points import FittedEdge, StressField, StressPoints
from contact_scene.stated_error import Part, StatedError

Field = NDArray[np.float64]

# Regions that the edge of the contact belongs to.
AT_SURFACE = "body", "layer 1"
# Cells from the surface within which a stress feels the edges of the tractions.
NEAR = 2.0
# Of stress at a fitted edge, over itself: what the pressure of a solver that knows no edge leaves
# wrong grows with the m cells per radius, .0006 + .00004 m, at most .002; few leave 4/m⁴ in the fit
# (Hertz's, sliding and coated contacts of 5 to 50 cells).
BY_CELL, MOST_BY_PRESSURE = 4e-5, 2e-3
FEW_CELLS = 4.0
# The same of pressures with their edges inside the cells, for which number of cells does not count.
WITHIN, FEW_CELLS_WITHIN = 1e-3, 1.0
# Two fits of a smooth edge are as far apart however right they are; what is beyond counts.
ALWAYS_APART = 7e-4
# Of what parabolas find between the points; points are too few for them to be exact.
BETWEEN = 1.1
# Tractions that are means leave nothing that would make up for it.
BETWEEN_WITHIN = 1.4


def stress_errors(
    state: LoadedBodies, field: StressField, found: Sequence[Extreme], *, indenter: bool = False
) -> tuple[StatedError, ...]:
    """Errors of the extremes that were found in a field.

    Of the tractions counts what increments leave wrong in them; what cells do is far less than what
    they leave wrong in the stress.
    """
    if state.pressed is not None:
        from contact_errors.stress_on_disc import disc_stress_errors

        return disc_stress_errors(state, found, indenter=indenter)
    if state.on_rings:
        return ring_stress_errors(state, field, found, indenter=indenter)
    more = BETWEEN_WITHIN if state.edges else BETWEEN
    depths = np.unique(field.points.depth).tolist()
    wide = stress_on_cells(on_wide_cells(state), indenter=indenter, depths=depths, see_edge=False)
    body = state.indenter if indenter else state.body
    there = {
        (e.region, e.measure): (e.value, more * beyond(wide.points, e))
        for e in extremes(wide, body)
    }
    errors = []
    per_radius = sqrt(np.count_nonzero(state.tractions["pressure"]) / pi)
    by_edge = 0.0 if field.edge is None else _by_edge(per_radius, field.edge, within=state.edges)
    for e in found:
        between = 0.0 if e.on_edge else more * beyond(field.points, e)
        rule, by_increments = rule_of(state, field.edge, e), state.by_increments or 0.0
        if field.edge is not None and (e.on_edge or rule is AT_EDGE):
            errors.append(_at_edge(e, by_edge, between, by_increments))
            continue
        error = _error(e, between, there.get((e.region, e.measure)), rule, by_increments)
        reach = _reach(field.edge, by_edge, e)
        if error.error is not None and np.max(error.error) < reach:
            error = estimate.stated({"cells": np.array([reach])}, not e.at_window_edge)
        errors.append(error)
    return tuple(errors)


def _reach(edge: FittedEdge | None, by_edge: float, extreme: Extreme) -> float:
    """Difference of the largest stress that an undetermined edge may have to an extreme."""
    if edge is None or edge.determined or extreme.region not in AT_SURFACE:
        return 0.0
    largest = float(np.max(edge.points.measures[extreme.measure]))
    return largest + by_edge * abs(largest) - extreme.value


def rule_of(state: LoadedBodies, edge: FittedEdge | None, extreme: Extreme) -> Rule:
    """The law of its error by cells.

    edge  of the field in which it was found
    """
    from semi_analytical.stress import near_surface

    x, y = state.axes["x"], state.axes["y"]
    spacing = (x[1] - x[0], y[1] - y[0])
    if extreme.depth >= NEAR * sqrt(spacing[0] * spacing[1]):
        return INTERIOR
    seen = edge is not None and edge.determined
    return AT_EDGE if seen and near_surface(extreme.depth, spacing) else TENSION


def on_wide_cells(state: LoadedBodies) -> LoadedBodies:
    """The same forces on cells twice as wide, whose tractions are the means of four."""
    pads = {axis: len(state.axes[axis]) % 2 for axis in ("x", "y")}
    axes = {axis: _pairs(state.axes[axis], pads[axis]) for axis in ("x", "y")}
    return replace(
        state,
        axes=axes,
        tractions={name: _means(field, *pads.values()) for name, field in state.tractions.items()},
    )


def _pairs(centres: Field, pad: int) -> Field:
    """Centres of pairs of cells; an odd one gets a partner behind it."""
    h = centres[1] - centres[0]
    return np.asarray(centres[::2] + h / 2 if pad else (centres[::2] + centres[1::2]) / 2)


def _means(field: Field, pad_x: int, pad_y: int) -> Field:
    lead = [(0, 0)] * (field.ndim - 2)
    even = np.pad(field, [*lead, (0, pad_x), (0, pad_y)])
    return np.asarray(
        (even[..., ::2, ::2] + even[..., 1::2, ::2] + even[..., ::2, 1::2] + even[..., 1::2, 1::2])
        / 4
    )


def beyond(points: StressPoints, extreme: Extreme) -> float:
    """By how much a stress is larger between the points than at any: by the parabolas through the
    largest and its neighbours, in depth and along x and y, within one material [force/length^2]."""
    values = points.measures[extreme.measure]
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
    """Of three values the highest of their parabola, above the middle one, which is at zero."""
    left, right = (f[0] - f[1]) / x[0], (f[2] - f[1]) / x[2]
    bend = (right - left) / (x[2] - x[0])
    slope = left - bend * x[0]
    return float(-(slope**2) / (4 * bend)) if bend < 0 else 0.0


def _by_edge(per_radius: float, edge: FittedEdge, *, within: bool) -> float:
    """Error of a stress at a fitted edge, over itself.

    per_radius  cells per contact radius
    within      whether the tractions have their edges inside the cells
    """
    by_fit = AT_EDGE.factor * max(edge.apart - ALWAYS_APART, 0.0)
    if within:
        by_fit += WITHIN + FEW_CELLS_WITHIN / per_radius**4
    else:
        by_fit += min(AT_EDGE.floor + BY_CELL * per_radius, MOST_BY_PRESSURE)
        by_fit += FEW_CELLS / per_radius**4
    return max(by_fit, edge.least)


def _at_edge(extreme: Extreme, by_edge: float, between: float, by_increments: float) -> StatedError:
    size = np.array([abs(extreme.value)])
    parts: dict[Part, Field] = {"cells": between + by_edge * size}
    if by_increments:
        parts["increments"] = by_increments * size
    return estimate.stated(parts, not extreme.at_window_edge)


def _error(
    extreme: Extreme,
    beyond_here: float,
    wide: tuple[float, float] | None,
    rule: Rule,
    by_increments: float,
) -> StatedError:
    if wide is None:
        return estimate.UNKNOWN
    value, beyond_there = wide
    change = abs(extreme.value - value)
    cells = np.zeros(1)
    if rule is INTERIOR:
        change = abs(extreme.value + beyond_here - value - beyond_there)
        cells = np.array([beyond_here])
    differs, largest = np.array([change]), np.array([abs(extreme.value)])
    parts: dict[Part, Field] = {"cells": cells + estimate.by_cells(rule, differs, 2.0, np.zeros(1))}
    if by_increments:
        parts["increments"] = by_increments * largest
    apart = estimate.contradicts(differs, largest, 0.0)
    return estimate.stated(parts, not (apart or extreme.at_window_edge))
