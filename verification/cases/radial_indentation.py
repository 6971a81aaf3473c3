"""Pressing with friction by the radial solver, against integral equations and Goodman's limit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from verification.closed_forms.goodman import stick_ratio
from verification.judging.case import Case, Level
from verification.judging.declared_case import Within, case, judged
from verification.judging.ladder import on_radii
from verification.judging.observable import Observable, error_norm
from verification.judging.observables import APPROACH, CONTACT_RADIUS
from verification.observed.end_state import contact_radius, stick_radius
from verification.problems.indentation import (
    COATED,
    FEW,
    NU_ZERO,
    OVER_HERTZ_RADIUS,
    STRONG,
    WEAK,
)
from verification.problems.layered_scene import half_space, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ, pressing
from verification.problems.problem import Problem
from verification.problems.sheared import OVER_LIMIT

CONTACTS = (WEAK, STRONG, NU_ZERO, COATED)
INCREMENTS = 64  # twice as many where the cells take twice as many
RINGS = 512  # to compare shear between them
INNERMOST = 0.05  # radii from which on shear is compared, over the contact's
BESIDE = 0.05  # and how near to the front it is not, over the front's
ASKED = "asked of the radial solver at these increments"

# Nearly without coupling, by which Goodman's answer is off by about β².
NU = 0.49
BETA = (1 - 2 * NU) / (2 * (1 - NU))
RATIOS = (0.5, 1.0)  # µ/β
ONE = "1"


def _mean_shear(result: Any, _: int, problem: Problem) -> float:
    """At the radii of the row, by the shear over √(1-x²), which has no root, between rings."""
    end, one = result.steps[-1], problem.ends[-1]
    r = end.radii[end.pressure > 0] / end.contact_radius
    smooth = end.shear_radial[: len(r)] / np.sqrt(1 - r**2)
    x = one.radii / one.contact_radius
    told = (x >= INNERMOST) & (np.abs(x / one.stick_part - 1) > BESIDE)
    off = np.interp(x, r, smooth) * np.sqrt(1 - x**2) - one.shear(one.radii)
    return float(np.mean(np.abs(off[told]))) / problem.scale(OVER_LIMIT)


STICK_RADIUS = Observable(
    "stick_radius", "stick radius", "m", lambda result, *_: stick_radius(result),
    lambda one: one.stick_part * one.contact_radius, OVER_HERTZ_RADIUS,
)  # fmt: skip
STICK_PART = Observable(
    "stick_part", "stick radius over contact radius", "",
    lambda result, *_: stick_radius(result) / contact_radius(result),
    lambda exact: float(exact.stick_part), ONE,
)  # fmt: skip
MEAN_SHEAR = error_norm(
    "mean_shear", f"mean error of the shear from {INNERMOST:g} a on, beside the front",
    _mean_shear, OVER_LIMIT,
)  # fmt: skip
OF_CONTACTS = (
    Within(APPROACH, 1e-6, ASKED),
    Within(CONTACT_RADIUS, 1e-6, ASKED),
    Within(STICK_RADIUS, 1e-3, ASKED),
    Within(MEAN_SHEAR, 1e-4, ASKED),
)
OF_GOODMAN = (
    Within(STICK_PART, 1e-3, f"asked of the stick radius; {BETA**2:.0e} of it is Goodman's"),
)


@dataclass(frozen=True)
class _Goodman:
    stick_part: float


def _goodman(ratio: float) -> Problem:
    title, friction = f"ν = {NU:g}, µ = {ratio:g} β", ratio * BETA
    scene = pressed(title, rigid_ball(), half_space(NU), pressing(INCREMENTS), friction=friction)
    return Problem(
        scene,
        (_Goodman(stick_ratio(friction, BETA)),),
        HERTZ.contact_radius,
        "Goodman 1962; Spence 1975",
        uncertainty=BETA**2,
        scales={ONE: 1.0},
    )


def radial_indentation(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    return case(
        "radial_indentation",
        "Pressing with friction in one dimension",
        "The paper's ball, rigid, pressed by 1 kN on half-spaces and on a coating that "
        f"move towards the axis below it, in {INCREMENTS} increments, or twice as many where "
        "nearly all sticks, by the radial solver. The references come from integral equations "
        "over the radius. Where bodies hardly couple, the stick radius is Goodman's.",
        *(
            judged(
                on_radii(one.problem(INCREMENTS * one.increments // FEW), one.name, rings=RINGS),
                OF_CONTACTS,
            )
            for one in CONTACTS
        ),
        *(
            judged(on_radii(problem, problem.scene.title, rings=RINGS), OF_GOODMAN)
            for problem in map(_goodman, RATIOS)
        ),
    )
