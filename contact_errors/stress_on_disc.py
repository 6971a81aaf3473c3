"""Errors of the largest stresses below the radial solver's tractions: from twice as many orders and
points; with shear from another fit of the edge, too, and by what increments leave in them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from contact_errors import estimate
from contact_errors.on_radii import ROUND_OFF, TIMES, TWICE
from contact_results.stress.extremes import Extreme
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.radial_body import RadialBody, is_sheared
from contact_scene.stated_error import Part, StatedError


def disc_stress_errors(
    state: LoadedBodies, found: Sequence[Extreme], *, indenter: bool = False
) -> tuple[StatedError, ...]:
    """Errors of the extremes that were found in a field: looked for anew about their places."""
    body = RadialBody.of(state, indenter, TWICE)
    by_increments = (state.by_increments or 0.0) if is_sheared(state) else 0.0
    errors: dict[tuple[str, float, float, float, float], StatedError] = {}
    for e in reversed(found):  # what is largest in the body is so in a layer, too
        if e.region in body.parts.named:
            again = float(np.max(body.largest(e).measures[e.measure]))
            size = TIMES * abs(again - e.value) + ROUND_OFF * abs(e.value)
            parts: dict[Part, np.ndarray] = {"quadrature": np.array([size])}
            if by_increments:
                parts["increments"] = np.array([by_increments * abs(e.value)])
            errors[_place(e)] = estimate.stated(parts, not e.at_window_edge)
    return tuple(errors.get(_place(e), estimate.UNKNOWN) for e in found)


def _place(e: Extreme) -> tuple[str, float, float, float, float]:
    return e.measure, e.value, e.x, e.y, e.depth
