"""Cone and flat punch by finite elements: an infinite pressure at the apex or at the rim."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from verification.cases.fem_levels import levels
from verification.judging.case import Case, Level
from verification.judging.declared_case import Falls, Within, case, judged
from verification.judging.drawings import convergence
from verification.judging.ladder import asked, on_elements, part_of_side, with_edge_at
from verification.judging.observable import error_norm
from verification.judging.observables import APPROACH, CENTRAL_PRESSURE, CONTACT_RADIUS
from verification.judging.order_of_convergence import NotYetAsymptotic
from verification.problems.classical import CONE, PUNCH
from verification.problems.problem import Problem

BECAUSE = "set by hand at 64 elements per radius, on other meshes what the order makes of it"
RIM = "what hats cannot follow of the infinite pressure at the rim has an energy of O(h)"
SLOWLY = NotYetAsymptotic(
    0.15,
    "the error is A h - B h² with B = 3.5 A / a: neighbours from 22 elements per radius on give "
    "0.86, 0.90, 0.93",
)
JUDGED = (0.2, 0.8)  # part of the radius of the cone, away from apex and edge


def _between(result: Any, step: int, problem: Problem) -> float:
    end = result.steps[step]
    part = end.radii / problem.radius
    away = (part > JUDGED[0]) & (part < JUDGED[1])
    exact = problem.ends[step].pressure(end.radii[away])
    return float(abs(end.pressure[away] / exact - 1).max())


PRESSURE_BETWEEN = error_norm(
    "pressure_of_cone",
    "largest error of the pressure over its exact value, from 0.2 to 0.8 of the radius",
    _between,
    "the exact one",
)
OF_CONE = (
    Within(APPROACH, asked(1e-4, 2), BECAUSE, name="approach_of_cone"),
    Within(CONTACT_RADIUS, part_of_side(0.05), "a twentieth of an element", name="radius_of_cone"),
    Within(PRESSURE_BETWEEN, asked(5e-4, 2), BECAUSE),
)
OF_PUNCH = (
    Within(APPROACH, asked(5e-4, 1), f"{BECAUSE}; {RIM}", name="approach_of_punch"),
    Within(CENTRAL_PRESSURE, asked(1e-3, 1), f"{BECAUSE}; {RIM}", name="central_pressure_of_punch"),
    Falls(APPROACH, 1.0, RIM),
)
OF_FINE_PUNCH = (Falls(CENTRAL_PRESSURE, 1.0, RIM, SLOWLY),)
FINE = 22  # elements per radius; on coarser meshes the second term makes 0.8 of that order


def fem_classical(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels; there the order of the central pressure is
    judged too."""
    cones = with_edge_at(CONE, levels(level), of="cone")
    punches = on_elements(PUNCH, levels(level), of="punch")
    fine = tuple(rung for rung in punches.rungs if rung.count >= FINE)
    followed = [] if level is Level.QUICK else [replace(punches, followed=fine)]
    caption = "Relative errors against the side of an element over the contact radius."
    return case(
        "fem_classical",
        "Finite elements: cone and flat punch",
        "The scenes of cone_contact and flat_punch by finite elements. Below the punch the hats of "
        "the pressure end at the rim with half a hat.",
        judged(cones, OF_CONE),
        judged(punches, OF_PUNCH),
        *(judged(one, OF_FINE_PUNCH) for one in followed),
        charts=(
            convergence(
                punches, (*OF_PUNCH, *OF_FINE_PUNCH), "fem_classical_convergence",
                "Convergence of the punch", caption,
            ),
            convergence(
                cones, (), "fem_classical_cone", "Convergence of the cone", caption,
                also=(APPROACH,),
            ),
        ),
    )  # fmt: skip
