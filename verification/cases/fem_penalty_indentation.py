"""A rigid ball pressed with friction, by finite elements with a penalty and return mapping."""

from __future__ import annotations

from typing import Any

from verification.cases.consistent_tangent import consistent_tangent
from verification.cases.fem_indentation import pressed, shear_profile
from verification.cases.levels import finest
from verification.judging.case import Case, Level
from verification.judging.declared_case import Reported, Within, case, judged
from verification.judging.ladder import on_springs, part_of_side
from verification.judging.observable import error_norm
from verification.judging.observables import APPROACH, CONTACT_RADIUS
from verification.judging.pressing_errors import PRESSURE, SHEAR
from verification.problems.indentation import COATED, FEW, STRONG, WEAK

ASKED = "asked of the finite elements with a penalty, at their default penalty"
ALTERNATION = "alternation"


def by_newton(result: Any) -> float:
    """Increments that the alternating iteration alone did not solve."""
    return float(sum(increment.path != ALTERNATION for increment in result.increments))


def systems_per_increment(result: Any) -> float:
    """Linear systems, in the mean."""
    return sum(i.iterations for i in result.increments) / len(result.increments)


ROWS = (
    Within(APPROACH, 1e-3, ASKED),
    Within(CONTACT_RADIUS, part_of_side(0.12), "an eighth of an element: the last points ripple"),
    Within(PRESSURE, 5e-3, ASKED),
    Within(SHEAR, 3e-2, ASKED),
    Reported(
        error_norm(
            "by_newton", "increments that took Newton's method",
            lambda result, *_: by_newton(result),
        ),
        "none: pressure and shear in turn, with Anderson mixing, converge in all",
    ),
    Reported(
        error_norm(
            "systems", "linear systems per increment",
            lambda result, *_: systems_per_increment(result),
        ),
        "two passes each: springs, and springs beside the forces of the first pass",
    ),
)  # fmt: skip


def fem_penalty_indentation(level: Level = Level.QUICK) -> Case:
    """The case, on a finer mesh at higher levels."""
    n = finest(level)
    meshes = {
        one: on_springs(pressed(one, n, FEW), f"{one.name}, {FEW} increments, penalty")
        for one in (WEAK, STRONG, COATED)
    }
    return case(
        "fem_penalty_indentation",
        "Finite elements with a penalty: pressing with friction",
        "The scenes of fem_indentation with springs at Gauss points instead of exact contact, "
        "and Coulomb's law by return mapping: a trial shear from what each point remembers, "
        "scaled back to µp where it is beyond. Pressure and shear are found in turn; where that "
        "does not converge, together by Newton's method with the consistent tangent.",
        *(judged(mesh, ROWS) for mesh in meshes.values()),
        checks=(consistent_tangent(),),
        charts=tuple(
            shear_profile("fem_penalty_indentation", one, mesh) for one, mesh in meshes.items()
        ),
        limits=(
            f"The shear is that of {FEW} increments, whose error is part of what is judged: each "
            "place that the edge of stick has passed keeps a ripple, of 0.02 µp_H for µ = 0.3.",
        ),
    )
