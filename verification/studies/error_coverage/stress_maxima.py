"""The largest stresses of a body below a result, as `slipstick stress` finds them."""

from __future__ import annotations

from typing import Any

from contact_results.stress.extremes import extremes
from contact_results.stress.loaded_bodies import state_of_result
from contact_results.stress.on_cells import stress_on_cells
from contact_results.stress.on_section import stress_on_section


def stress_maxima(result: Any, step: int) -> dict[str, float]:
    """By measure, of the lower body at the end of a step [force/length²]."""
    state = state_of_result(result, step)
    field = stress_on_section(state) if state.on_rings else stress_on_cells(state)
    return {e.measure: e.value for e in extremes(field.points, state.body) if e.region == "body"}
