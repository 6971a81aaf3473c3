"""The largest stresses of a body below a result, with errors, as `slipstick stress` has them."""

from __future__ import annotations

from typing import Any

from contact_errors.stress_errors import stress_errors
from contact_results.stress.extremes import extremes
from contact_results.stress.loaded_bodies import state_of_result
from contact_results.stress.on_cells import stress_on_cells
from contact_results.stress.on_section import stress_on_section
from contact_scene.stated_error import StatedError

WHOLE = "body"  # among the regions


def stress_maxima(result: Any, step: int) -> dict[str, tuple[float, StatedError]]:
    """By measure, of all of the lower body at the end of a step [force/length²]."""
    state = state_of_result(result, step)
    field = stress_on_section(state) if state.on_rings else stress_on_cells(state)
    found = extremes(field, state.body)
    errors = stress_errors(state, field, found)
    return {
        e.measure: (e.value, error)
        for e, error in zip(found, errors, strict=True)
        if e.region == WHOLE
    }
