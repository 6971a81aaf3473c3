"""Quantities whose order of convergence is not judged under a kind of refinement, and why.

The tables are complete for the standard and for the full level: a test compares them with what
these judge.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product

from verification.judging.order_of_convergence import Followed, Refinement
from verification.judging.outcome import CaseOutcome
from verification.solver import Solver

BY_COUPLING = "friction moves pressures by the coupling alone; the approach, their mean, is judged"
SCATTERS = "increments move it by less than a part of a cell or element: scatter, of no order"
NOTHING_TO_REFINE = (
    "a twist does not act back on the pressure: bodies pressed and twisted once need one increment"
)
ELSEWHERE = "judged by other cases, or from the standard level on"
FASTER = (
    "friction along slip is the mean of both ends, of second order, beside slip of first: it falls "
    "ever faster, with 1.4 to 1.8 while pressed in 4 to 64 increments and with 1.6 to 2.0 while "
    "sheared in 4 to 256"
)
OF_RADII = {
    Refinement.MESH: "discs are exact to rounding; of a push fronts fall anywhere between rings: "
    "the shift falls with 1.9 ± 0.5 over 15 sets of rings, too wide to hold it to 2",
    Refinement.INCREMENTS: "held against references at one number of increments; cells and "
    "elements show the orders of the same paths",
}
REASONS = {
    **{
        (of, Solver.RADII, refined): reason
        for of in Followed
        for refined, reason in OF_RADII.items()
    },
    (Followed.ENERGY, Solver.CELLS, Refinement.MESH): (
        "what is left of it depends on how circles cut the cells: 2.4 ± 0.2 from 96 or 128 grids, "
        "too wide to hold it to 5/2"
    ),
    (Followed.PRESSURE, Solver.CELLS, Refinement.INCREMENTS): BY_COUPLING,
    (Followed.PRESSURE, Solver.ELEMENTS, Refinement.INCREMENTS): BY_COUPLING,
    (Followed.PEAK_PRESSURE, Solver.CELLS, Refinement.INCREMENTS): SCATTERS,
    (Followed.PEAK_PRESSURE, Solver.ELEMENTS, Refinement.INCREMENTS): SCATTERS,
    (Followed.CONTACT_RADIUS, Solver.CELLS, Refinement.INCREMENTS): SCATTERS,
    (Followed.CONTACT_RADIUS, Solver.ELEMENTS, Refinement.MESH): (
        "the error is A h + B h², A from reading the edge off the last two pressures and B from "
        "these; on the meshes of fem_hertz neither dominates, as its chart shows"
    ),
    (Followed.ENERGY, Solver.CELLS, Refinement.INCREMENTS): FASTER,
    (Followed.ENERGY, Solver.ELEMENTS, Refinement.INCREMENTS): FASTER,
    (Followed.SHIFT, Solver.ELEMENTS, Refinement.INCREMENTS): (
        "bodies that are alike need one increment; of those that couple coupled_history holds the "
        "shift against the other solver on the same increments, and sheared_increments judges the "
        "order of that one"
    ),
    (Followed.TWIST, Solver.CELLS, Refinement.MESH): (
        "the rim of a punch is a staircase of cells; torsion judges the order of its shear"
    ),
    (Followed.TWIST, Solver.CELLS, Refinement.INCREMENTS): NOTHING_TO_REFINE,
    (Followed.TWIST, Solver.ELEMENTS, Refinement.INCREMENTS): NOTHING_TO_REFINE,
}


@dataclass(frozen=True)
class NotJudged:
    """A gap in the table of orders."""

    of: Followed
    solver: Solver
    refined: Refinement
    reason: str


def not_judged(outcomes: Iterable[CaseOutcome]) -> tuple[NotJudged, ...]:
    """What no verdict of these cases judges the order of."""
    judged = {
        (verdict.order.of, verdict.order.solver, verdict.order.refined)
        for case in outcomes
        for verdict in case.verdicts
        if verdict.order is not None
    }
    return tuple(
        NotJudged(*place, REASONS.get(place, ELSEWHERE))
        for place in product(Followed, Solver, Refinement)
        if place not in judged
    )
