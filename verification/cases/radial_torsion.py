"""Torsion by the radial solver: closed forms, Masing's rule, and a Fredholm equation for layers."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

import radial
from contact_scene import Scene
from contact_scene.residuals import worst
from radial import Increment
from verification.cases.torsion_coated import twisted
from verification.judging.case import Case, Check, Level, Required
from verification.problems.problem import Problem
from verification.problems.reference import Reference
from verification.problems.sheared import OVER_LIMIT
from verification.problems.torsion import LARGEST, LED, PARTS, STUCK, TO_AND_FRO, TWISTED

STUCK_SHEAR = float(STUCK.ends[1].shear(STUCK.radius / 2))
WITHIN = 0.995  # radii up to which shear is compared: at the edge it has no finite slope
MASING = "Lubkin 1951; Masing's rule"
# Of the area under the virgin curve 1e-10 is uncertain, and the energy is half as large.
ENERGY_ERROR = 2e-10

TWICE = "twice what the reference may be wrong by"


def radial_torsion(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    parts = ", ".join(f"{part:g}" for part in PARTS.values())
    return Case(
        name="radial_torsion",
        title="Torsion in one dimension",
        problem=f"The paper's ball under 1 kN, twisted by {parts} of the torque at which all "
        "slips, by a given twist, and to and fro; a flat punch that sticks all over; and coated "
        "balls as in torsion_coated; by the radial solver. It follows reversals by the branches "
        "that are open, and energies from them without increments.",
        runs=(),
        quantities=(),
        checks=(
            _relative("ball", TWISTED, "twist"),
            _relative("ball", TWISTED, "stick_radius"),
            _shear("ball", TWISTED, TWISTED.scale(OVER_LIMIT), "µp_H"),
            _relative("led", LED, "torque", "moment"),
            _relative("stuck", STUCK, "twist"),
            _shear("stuck", STUCK, STUCK_SHEAR, "q(a/2)"),
            _check(
                "loop_twist", TO_AND_FRO, "largest error of the twist at the reversals",
                _loop_twist, "the largest twist", source=MASING,
            ),
            _check(
                "loop_energy", TO_AND_FRO, "error of the energy per cycle relative to itself",
                _loop_energy, "1", source=MASING, uncertainty=ENERGY_ERROR,
            ),
            _relative("coated", twisted(), "twist"),
            _relative("coated", twisted(), "stick_radius"),
        ),
        limits=(
            "The friction limit of the coated reference comes from the response of layers to "
            "pressure that the solver has, too; its torsion does not.",
        ),
    )  # fmt: skip


def _check(
    name: str, problem: Problem, meaning: str, error: Callable[[], float],
    unit: str, source: str = "", uncertainty: float | None = None,
) -> Check:  # fmt: skip
    wrong = problem.uncertainty if uncertainty is None else uncertainty
    reference = Reference(0.0, problem.kind, source or problem.source, wrong)
    required = Required(2 * wrong, TWICE)
    return Check(name, meaning, "", problem.scene.title, error, reference, required, 1.0, unit)


def _relative(name: str, problem: Problem, of: str, exact: str = "") -> Check:
    """Of a scalar, by its name and by that which the answer has for it."""

    def error() -> float:
        return worst(
            *(
                abs(getattr(end, of) / getattr(known, exact or of) - 1)
                for end, known in _twisted(problem)
            )
        )

    meaning = f"largest error of the {of.replace('_', ' ')} relative to itself"
    return _check(f"{name}_{of}", problem, meaning, error, "1")


def _shear(name: str, problem: Problem, scale: float, unit: str) -> Check:
    def error() -> float:
        return worst(*(_shear_error(problem, *both) / scale for both in _twisted(problem)))

    meaning = f"largest error of the shear up to {WITHIN:g} a"
    return _check(f"{name}_shear", problem, meaning, error, unit)


def _shear_error(problem: Problem, end: Increment, known: Any) -> float:
    assert end.shear_circumferential is not None
    inside = end.radii < WITHIN * problem.radius
    off = end.shear_circumferential[inside] - known.shear(end.radii[inside])
    return float(np.max(np.abs(off)))


def _loop_twist() -> float:
    return worst(
        *(abs(end.twist - known.twist) / LARGEST.twist for end, known in _twisted(TO_AND_FRO))
    )


def _loop_energy() -> float:
    (first, _), *_, (last, known) = _twisted(TO_AND_FRO)
    return float(
        abs((last.dissipated_energy - first.dissipated_energy) / known.energy_per_cycle - 1)
    )


def _twisted(problem: Problem) -> list[tuple[Any, Any]]:
    """The ends of the steps after the pressing, ours and exact."""
    steps = _of_scene(problem.scene.model_dump_json())
    return list(zip(steps[1:], problem.ends[1:], strict=True))


@cache
def _of_scene(text: str) -> tuple[Increment, ...]:
    return radial.solve(Scene.model_validate_json(text)).steps
