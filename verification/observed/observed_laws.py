"""Laws of contact, friction and energy in the stored fields of a result of any solver."""

from collections import Counter
from pkgutil import resolve_name
from typing import Any, NamedTuple

from verification.observed.contact_state import (
    ContactState,
    imbalances,
    largest_of,
    missed,
    violations,
)

# Functions that collect the states of a result, by the package of its solver.
STATES = {
    "semi_analytical": "verification.observed.cells:states_on_cells",
    "fem_reference": "verification.observed.elements:states_on_elements",
    "radial": "verification.observed.radii:states_on_radii",
}


class Observed(NamedTuple):
    """Hold the largest violations of laws that were evaluated from the fields of a result.

    violation  largest violation of any law of contact or friction in any increment; infinite if a
               number is not finite [1]
    imbalance  largest energy imbalance of any increment, over the largest energy so far [1]
    of_slip    number of increments in which a law of slip is not evaluated, by reason
    of_energy  number of increments in which energies are not fully compared, by reason
    """

    violation: float
    imbalance: float
    of_slip: Counter[str]
    of_energy: Counter[str]


def observed(result: Any) -> Observed:
    """Evaluate the laws of contact and friction and the energy balance in all increments of a
    result.

    result  result of any of the three solvers
    """
    states = _contact_states(result)
    return Observed(
        largest_of([*violations(states), *missed(result.scene, result.steps)]),
        largest_of(imbalances(states)),
        Counter(state.unseen for state in states if state.unseen),
        Counter(reason for state in states if (reason := state.not_compared)),
    )


def _contact_states(result: Any) -> list[ContactState]:
    package = result.solver.partition(".")[0]
    found: list[ContactState] = resolve_name(STATES[package])(result)
    return found
