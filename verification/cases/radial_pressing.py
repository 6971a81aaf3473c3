"""The radial solver against closed forms, and against other programs where there are layers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

import radial
from contact_scene import Scene
from contact_scene.residuals import worst
from radial import Increment
from radial.bodies import Bodies
from radial.disc import disc
from radial.surface import pressure
from verification.judging.case import Case, Check, Level, Required
from verification.problems.classical import CONE, PUNCH, mean_pressure
from verification.problems.coated_ball import BARE, ROWS, coated_ball
from verification.problems.paper_scene import HERTZ
from verification.problems.problem import Problem
from verification.problems.reference import Reference

ASKED = Required(
    1e-12, "both are right to rounding, of which forty times are allowed; 1e-10 was asked"
)
WITHIN = 0.995  # radii up to which pressures are compared: at the edge they have no finite slope
COATED = [coated_ball(row) for row in ROWS]
CLOSED = {"ball": (BARE, HERTZ.peak_pressure), "cone": (CONE, mean_pressure(CONE)),
          "punch": (PUNCH, mean_pressure(PUNCH))}  # fmt: skip


def radial_pressing(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    checks = [
        check for name, (problem, _) in CLOSED.items() for check in _of_loads(name, [problem])
    ]
    checks += [
        _check(
            f"{name}_pressure",
            [problem],
            f"largest error of the pressure up to {WITHIN:g} a",
            _PressureOver(scale),
        )
        for name, (problem, scale) in CLOSED.items()
    ]
    checks += _of_loads("coated", COATED)
    checks.append(
        _check(
            "coated_pressure",
            COATED,
            "largest error of the pressure at the radii of the rows, over p_H",
            _row_error,
        )
    )
    return Case(
        name="radial_pressing",
        title="Pressing in one dimension",
        problem="The paper's ball, a cone and a flat punch on half-spaces, and the ball, rigid, on "
        f"{len(COATED)} coatings, under 1 kN without friction, by the radial solver. It has the "
        "response of layers to a wavenumber in common with the semi-analytical solver; the "
        "references have neither that nor its polynomials.",
        runs=(),
        quantities=(),
        checks=tuple(checks),
    )


def _of_loads(name: str, problems: list[Problem]) -> list[Check]:
    return [
        _check(
            f"{name}_{of}",
            problems,
            f"largest error of the {of.replace('_', ' ')} relative to itself",
            _Relative(of),
        )
        for of in ("approach", "contact_radius")
    ]


def _check(
    name: str, problems: list[Problem], meaning: str, error: Callable[[Problem], float]
) -> Check:
    first = problems[0]
    return Check(
        name,
        meaning,
        "",
        f"{len(problems)} coatings" if len(problems) > 1 else first.scene.title,
        lambda: worst(*(error(problem) for problem in problems)),
        Reference(0.0, first.kind, first.source, max(of.uncertainty for of in problems)),
        ASKED,
        1.0,
        "1",
    )


@dataclass(frozen=True)
class _Relative:
    """Error of a scalar, by name."""

    name: str

    def __call__(self, problem: Problem) -> float:
        value, exact = (getattr(end, self.name) for end in (_solved(problem), problem.ends[0]))
        return float(abs(value / exact - 1))


@dataclass(frozen=True)
class _PressureOver:
    """Error of the pressure at the rings, against the function of the radius."""

    scale: float

    def __call__(self, problem: Problem) -> float:
        end = _solved(problem)
        inside = end.radii < WITHIN * problem.radius
        exact: Any = problem.ends[0]
        off = end.pressure[inside] - exact.pressure(end.radii[inside])
        return float(np.max(np.abs(off)) / self.scale)


@cache
def _of_scene(text: str) -> Increment:
    return radial.solve(Scene.model_validate_json(text)).steps[-1]


def _solved(problem: Problem) -> Increment:
    return _of_scene(problem.scene.model_dump_json())


def _row_error(problem: Problem) -> float:
    """Against the table, at its radii."""
    row: Any = problem.ends[0]
    made = disc(Bodies.of(problem.scene), problem.scene.indenter, _solved(problem).contact_radius)
    found = pressure(made, row.radii / made.radius)
    return float(np.max(np.abs(found - row.pressure(row.radii))) / HERTZ.peak_pressure)
