"""Errors of the largest stresses below pressure that is known at every radius: from twice as many
orders and points."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from contact_errors import estimate
from contact_errors.on_radii import ROUND_OFF, TIMES, TWICE
from contact_results.stress.disc_body import DiscBody
from contact_results.stress.extremes import Extreme
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_scene.stated_error import Part, StatedError


def disc_stress_errors(
    state: LoadedBodies, found: Sequence[Extreme], *, indenter: bool = False
) -> tuple[StatedError, ...]:
    """Errors of the extremes that were found in a field: looked for anew about their places."""
    body = DiscBody.of(state, indenter, TWICE)
    errors: dict[tuple[str, float, float, float], StatedError] = {}
    for e in reversed(found):  # what is largest in the body is so in a layer, too
        if e.region in body.regions:
            again = float(np.max(body.largest(e).measures[e.measure]))
            size = TIMES * abs(again - e.value) + ROUND_OFF * abs(e.value)
            parts: dict[Part, np.ndarray] = {"quadrature": np.array([size])}
            errors[_place(e)] = estimate.stated(parts, not e.at_window_edge)
    return tuple(errors.get(_place(e), estimate.UNKNOWN) for e in found)


def _place(e: Extreme) -> tuple[str, float, float, float]:
    return e.measure, e.value, e.x, e.depth
