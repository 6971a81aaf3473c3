"""Largest stresses of the lower body with their errors, as `slipstick stress` states them."""

from __future__ import annotations

from typing import Any

from contact_errors.stress_errors import stress_errors
from contact_results.stress.loaded_bodies import state_of_result
from contact_results.stress.on_cells import stress_on_cells
from contact_results.stress.on_disc import stress_on_disc
from contact_results.stress.on_section import stress_on_section
from contact_results.stress.stress_maxima import extremes
from contact_scene.quantities.stated_error import (
    StatedError,
    StatedErrors,
)

WHOLE = "body"  # among the regions


def stress_maxima(
    result: Any, step: int, errors: StatedErrors | None = None
) -> dict[str, tuple[float, StatedError]]:
    """Return those of the whole body at the end of a step, by measure [force/length²]."""
    state = state_of_result(result, step, errors)
    below = stress_on_disc if state.pressed else stress_on_section if state.on_rings else None
    field = (below or stress_on_cells)(state)
    found = extremes(field, state.body)
    of_stress = stress_errors(state, field, found)
    return {
        e.measure: (e.value, error)
        for e, error in zip(found, of_stress, strict=True)
        if e.region == WHOLE
    }
