"""Errors of the largest stresses by finite elements: the same tractions on half the elements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from contact_errors import estimate
from contact_errors.element_rules import INSIDE, ON_SURFACE
from contact_results.stress.extremes import Extreme, extremes
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.on_section import stress_on_section
from contact_scene.stated_error import Part, StatedError

Field = NDArray[np.float64]

# Elements from the surface within which a stress feels the edges of the tractions.
NEAR = 2.0


def ring_stress_errors(
    state: LoadedBodies, found: Sequence[Extreme], *, indenter: bool = False
) -> tuple[StatedError, ...]:
    """Errors of the extremes that were found below tractions on rings.

    Of the tractions counts what increments leave wrong in them; what elements do is far less than
    what they leave wrong in the stress.
    """
    wide = stress_on_section(on_half_the_rings(state), indenter=indenter)
    body = state.indenter if indenter else state.body
    there = {(e.region, e.measure): e.value for e in extremes(wide, body)}
    radius, count = _loaded(state)
    return tuple(
        _error(e, there.get((e.region, e.measure)), radius, count, state.by_increments or 0.0)
        for e in found
    )


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


def _error(
    extreme: Extreme, coarse: float | None, radius: float, count: float, by_increments: float
) -> StatedError:
    if coarse is None:
        return estimate.UNKNOWN
    rule = INSIDE if extreme.depth >= NEAR * radius / count else ON_SURFACE
    change, largest = np.array([abs(extreme.value - coarse)]), np.array([abs(extreme.value)])
    scatter = largest * rule.scatter(count)
    parts: dict[Part, Field] = {"elements": estimate.by_cells(rule, change, 2.0, scatter)}
    if by_increments:
        parts["increments"] = by_increments * largest
    apart = estimate.contradicts(change, largest, 0.0)
    return estimate.stated(parts, not (apart or extreme.at_window_edge))
