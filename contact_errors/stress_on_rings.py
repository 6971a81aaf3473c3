"""Errors of the largest stresses by finite elements: the same tractions on half the elements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from contact_errors import estimate
from contact_errors.element_rules import AT_EDGE, INSIDE, ON_SURFACE
from contact_errors.rules import Rule
from contact_results.stress.extremes import Extreme, extremes, layer_name
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.on_section import stress_on_section
from contact_results.stress.points import StressField, StressPoints
from contact_scene.accuracy import LARGEST_TENSION
from contact_scene.stated_error import Part, StatedError

Field = NDArray[np.float64]

# Elements from the surface within which a stress feels the edges of the tractions.
NEAR = 2.0


def ring_stress_errors(
    state: LoadedBodies, field: StressField, found: Sequence[Extreme], *, indenter: bool = False
) -> tuple[StatedError, ...]:
    """Errors of the extremes that were found in a field below tractions on rings.

    Where a region has the surface, the error of its largest tension reaches as far as the tension
    at the surface may: on few elements that is so much too low that one inside exceeds it.
    Of the tractions counts what increments leave wrong in them; what elements do is far less than
    what they leave wrong in the stress.
    """
    wide = stress_on_section(on_half_the_rings(state), indenter=indenter)
    body = state.indenter if indenter else state.body
    there = {(e.region, e.measure): e.value for e in extremes(wide, body)}
    radius, count = _loaded(state)
    near, by_increments = NEAR * radius / count, state.by_increments or 0.0
    on_surface = AT_EDGE if field.how["edges"] else ON_SURFACE
    tension, there_too = (_tension_near(one.points, near) for one in (field, wide))
    reached = tension + _by_elements(on_surface, tension, there_too, count)
    outermost = {"body", layer_name(0, len(body.layers))}
    errors = []
    for e in found:
        coarse = there.get((e.region, e.measure))
        if coarse is None:
            errors.append(estimate.UNKNOWN)
            continue
        rule = INSIDE if e.depth >= near else on_surface
        elements = _by_elements(rule, e.value, coarse, count)
        if e.measure == LARGEST_TENSION and e.region in outermost:
            elements = max(elements, reached - e.value)
        parts: dict[Part, Field] = {"elements": np.array([elements])}
        if by_increments:
            parts["increments"] = np.array([by_increments * abs(e.value)])
        apart = estimate.contradicts(np.array([e.value - coarse]), np.array([abs(e.value)]), 0.0)
        errors.append(estimate.stated(parts, not (apart or e.at_window_edge)))
    return tuple(errors)


def on_half_the_rings(state: LoadedBodies) -> LoadedBodies:
    """The tractions of every second ring, linear in between, for half as many elements."""
    asked, radii = state.discretisation, state.axes["radii"]
    assert asked is not None
    if len(radii) % 2 == 0:
        # The last one is kept, by one beyond it that carries nothing.
        radii = np.append(radii, 2 * radii[-1] - radii[-2])
    return replace(
        state,
        axes={**state.axes, "radii": radii[::2]},
        tractions={name: _every_second(t, len(radii)) for name, t in state.tractions.items()},
        discretisation=asked.model_copy(
            update={"elements_per_radius": max(2, asked.elements_per_radius // 2)}
        ),
    )


def _every_second(traction: Field, count: int) -> Field:
    pads = [(0, count - len(traction)), *[(0, 0)] * (traction.ndim - 1)]
    return np.asarray(np.pad(traction, pads)[::2])


def _loaded(state: LoadedBodies) -> tuple[float, float]:
    """Radius of the loaded circle [length], and the elements over it."""
    assert state.discretisation is not None
    pressure, radii = state.tractions["pressure"], state.axes["radii"]
    loaded = np.flatnonzero(pressure.reshape(len(radii), -1).max(axis=1) > 0)
    count = max(1, len(loaded))
    return float(radii[min(count, len(radii) - 1)]), float(
        min(count, state.discretisation.elements_per_radius)
    )


def _tension_near(points: StressPoints, depth: float) -> float:
    """The largest principal stress above a depth [force/length^2]."""
    return float(np.max(points.measures[LARGEST_TENSION][points.depth < depth]))


def _by_elements(rule: Rule, value: float, coarse: float, count: float) -> float:
    change, largest = np.array([abs(value - coarse)]), np.array([abs(value)])
    by_cells = estimate.by_cells(rule, change, 2.0, largest * rule.scatter(count))
    return float(by_cells[0]) + rule.floor * abs(value)
