"""The largest tension in the body as a number with an error, for an accuracy asked of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from contact_errors.rules import Rule
from contact_scene.accuracy import LARGEST_TENSION
from contact_scene.stated_error import StatedError, StatedErrors

if TYPE_CHECKING:
    from semi_analytical import Result


@dataclass(frozen=True)
class Tension:
    """The largest principal stress of the body [force/length^2], its error, and the law of that."""

    value: float
    error: StatedError
    rule: Rule


def largest_tension(result: Result, stated: StatedErrors, step: int) -> Tension | None:
    """At the end of a loading step, from 1; None for a rigid body."""
    from contact_errors.of_stress import rule_of, stress_errors
    from contact_results.stress.extremes import extremes
    from contact_results.stress.loaded_bodies import state_of_result
    from contact_results.stress.on_cells import stress_on_cells

    state = state_of_result(result, step, stated)
    if not state.body.deforms:
        return None
    field = stress_on_cells(state)
    (found,) = (
        extreme
        for extreme in extremes(field, state.body)
        if (extreme.region, extreme.measure) == ("body", LARGEST_TENSION)
    )
    (error,) = stress_errors(state, field, [found])
    return Tension(abs(found.value), error, rule_of(state, field.edge, found))
