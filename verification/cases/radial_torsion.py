"""Torsion by the radial solver: closed forms, Masing's rule, and a Fredholm equation for layers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from verification.cases import torsion_coated
from verification.cases.torsion import ENERGY_PER_CYCLE, LOOP_TWISTS, SLIDING, TORQUE
from verification.judging.case import Case, Level
from verification.judging.declared_case import Within, case, judged
from verification.judging.ladder import on_radii
from verification.judging.observable import Observable, error_norm
from verification.judging.observables import STICK_RADIUS, TWIST
from verification.problems.problem import Problem
from verification.problems.reference import ROUNDING
from verification.problems.sheared import OVER_LIMIT
from verification.problems.torsion import LED, PARTS, STUCK, TO_AND_FRO, TWISTED

WITHIN = 0.995  # radii up to which shear is compared: at the edge it has no finite slope
# Of the area under the virgin curve 1e-10 is uncertain, and the energy is half as large.
ENERGY_ERROR = 2e-10


def _shear_error(result: Any, step: int, problem: Problem) -> float:
    end, known = result.steps[step], problem.ends[step]
    scale = problem.scales.get(OVER_LIMIT) or float(known.shear(problem.radius / 2))
    inside = end.radii < WITHIN * problem.radius
    off = end.shear_circumferential[inside] - known.shear(end.radii[inside])
    return float(np.max(np.abs(off))) / scale


SHEAR = error_norm(
    "shear", f"largest error of the shear up to {WITHIN:g} a{{when}}", _shear_error,
    "µp_H, or the shear at half the radius of the punch",
)  # fmt: skip
STICK = replace(STICK_RADIUS, over="")


def _exact(*observables: Observable, error: float = ROUNDING) -> Iterator[Within]:
    because = "twice what the reference may be wrong by"
    return (Within(what, 2 * error, because) for what in observables)


def _at_parts(parts: dict[int, float], *observables: Observable) -> tuple[Observable, ...]:
    return tuple(
        what.at(step, part, SLIDING) for what in observables for step, part in parts.items()
    )


def radial_torsion(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    parts = ", ".join(f"{part:g}" for part in PARTS.values())
    coated = torsion_coated.twisted()
    of_coated = _at_parts(torsion_coated.PARTS, TWIST, STICK)
    of_loop = (*_exact(*LOOP_TWISTS), *_exact(ENERGY_PER_CYCLE, error=ENERGY_ERROR))
    return case(
        "radial_torsion",
        "Torsion in one dimension",
        f"The paper's ball under 1 kN, twisted by {parts} of the torque at which all "
        "slips, by a given twist, and to and fro; a flat punch that sticks all over; and coated "
        "balls as in torsion_coated; by the radial solver. It follows reversals by the branches "
        "that are open, and energies from them without increments.",
        judged(
            on_radii(TWISTED, "ball"),
            [*_exact(*_at_parts(PARTS, TWIST, STICK, SHEAR))],
        ),
        judged(on_radii(LED, "given twist"), [*_exact(TORQUE)]),
        judged(on_radii(STUCK, "stuck punch"), [*_exact(TWIST, SHEAR)]),
        judged(on_radii(TO_AND_FRO, "to and fro"), of_loop),
        judged(
            on_radii(coated, "coated"),
            [*_exact(*of_coated, error=torsion_coated.SEMI_CLOSED_ERROR)],
        ),
        limits=(
            "The friction limit of the coated reference comes from the response of layers to "
            "pressure that the solver has, too; its torsion does not.",
        ),
    )
