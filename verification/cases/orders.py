"""Quantities whose order of convergence is not judged under a kind of refinement, and why."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product

from verification.cases.case import Followed, Refinement, Run
from verification.cases.outcome import CaseOutcome
from verification.cases.section_run import SectionRun

SURFACE, SECTION = Run.solver, SectionRun.solver
BY_COUPLING = "friction moves pressures by the coupling alone; the approach, their mean, is judged"
SCATTERS = "increments move it by less than a part of a cell or element: scatter, of no order"
NOTHING_TO_REFINE = (
    "alike bodies pressed and sheared or twisted once need one increment, which is exact"
)
ELSEWHERE = "judged by other cases, or from the standard level on"
REASONS = {
    (Followed.PRESSURE, SURFACE, Refinement.INCREMENTS): BY_COUPLING,
    (Followed.PRESSURE, SECTION, Refinement.INCREMENTS): BY_COUPLING,
    (Followed.PEAK_PRESSURE, SURFACE, Refinement.INCREMENTS): SCATTERS,
    (Followed.PEAK_PRESSURE, SECTION, Refinement.INCREMENTS): SCATTERS,
    (Followed.CONTACT_RADIUS, SURFACE, Refinement.INCREMENTS): SCATTERS,
    (Followed.CONTACT_RADIUS, SECTION, Refinement.MESH): (
        "the error is A h + B h², A from reading the edge off the last two pressures and B from "
        "these; on the meshes of fem_hertz neither dominates, as its chart shows"
    ),
    (Followed.SHIFT, SECTION, Refinement.INCREMENTS): NOTHING_TO_REFINE,
    (Followed.TWIST, SURFACE, Refinement.MESH): (
        "the rim of a punch is a staircase of cells; torsion judges the order of its shear"
    ),
    (Followed.TWIST, SURFACE, Refinement.INCREMENTS): NOTHING_TO_REFINE,
    (Followed.TWIST, SECTION, Refinement.INCREMENTS): NOTHING_TO_REFINE,
}


@dataclass(frozen=True)
class NotJudged:
    """A gap in the table of orders."""

    of: Followed
    solver: str
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
        for place in product(Followed, (SURFACE, SECTION), Refinement)
        if place not in judged
    )
