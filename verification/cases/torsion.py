"""Torsion: a ball twisted into partial slip and back, and a stuck flat punch."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from verification.judging.case import Case, Level
from verification.judging.declared_case import Falls, Refined, Within, case, judged
from verification.judging.drawings import convergence
from verification.judging.ladder import named, on_cells, part_of_side
from verification.judging.observable import Observable, error_norm, number
from verification.judging.observables import STICK_RADIUS, TWIST
from verification.judging.order_of_convergence import Followed
from verification.judging.refinement import refinement
from verification.norms import shear_error
from verification.problems.paper_scene import FRICTION
from verification.problems.problem import Problem
from verification.problems.torsion import (
    LED,
    OVER_TWIST,
    PARTS,
    STUCK,
    TO_AND_FRO,
    TWISTED,
)
from verification.quantities import energy_between, shear_of

MASING = "Lubkin 1951, with Masing's rule for the reversal"
HALF_A_PER_CENT = "0.5 % of the twist was asked for at 128 x 128"
PUNCH_WINDOW_PER_RADIUS = 2.2
SLIDING = "of the sliding torque"


def _shear_error(result: Any, step: int, problem: Problem) -> float:
    end, a = result.steps[step], problem.radius
    x, y = result.grid.coordinates()
    r = np.hypot(x, y)
    exact = np.where(r < a, problem.ends[step].shear(np.minimum(r, a)), 0.0)
    across = np.stack([-y, x]) / np.where(r > 0, r, 1.0)
    return shear_error(shear_of(end), exact * across, FRICTION * end.pressure)


SHEAR = error_norm("shear", "Σ|q - q_exact| / Σµp{when}", _shear_error, "Σµp", of=Followed.SHEAR)
SHEARS = {step: SHEAR.at(step, part, SLIDING) for step, part in PARTS.items()}
OF_BALL = (
    *(
        row
        for step, part in PARTS.items()
        for row in (
            Refined(
                TWIST.at(step, part, SLIDING), 1.5, 5e-3,
                f"order 1.5 as the shear; the cap: {HALF_A_PER_CENT}",
            ),
            Refined(
                STICK_RADIUS.at(step, part, SLIDING), 1.0, part_of_side(0.25),
                "order 1: the border is known to a part of a cell; the cap is a quarter",
            ),
            Within(
                SHEARS[step], 2e-3, "as required of the Cattaneo-Mindlin shear on these grids"
            ),
        )
    ),
    Falls(
        SHEARS[2], 1.5,
        "square-root edges of stick zone and contact, as in the Cattaneo-Mindlin case",
    ),
)  # fmt: skip
LOOP_TWISTS = tuple(
    replace(
        TWIST, name=f"twist_{name}", meaning=f"twist after step {step + 1} of the loop", step=step,
        over=OVER_TWIST, source=MASING,
    )
    for step, name in {1: "loaded", 2: "unloaded", 3: "reversed", 4: "closed"}.items()
)  # fmt: skip
ENERGY_PER_CYCLE = Observable(
    "energy_per_cycle", "energy lost from the first to the second torque of + 0.9", "J",
    lambda result, *_: energy_between(result, 2, 5),
    lambda end: float(end.energy_per_cycle), source=MASING,
)  # fmt: skip
TORQUE = number("torque", "torque at the twist of 0.9 of the limit", exact="moment")
OF_LOOP = (
    *(
        Within(twist, 1e-4, f"four times what 128 cells leave; {HALF_A_PER_CENT}")
        for twist in LOOP_TWISTS[1:]
    ),
    Within(ENERGY_PER_CYCLE, 2e-4, f"four times what 128 cells leave; {HALF_A_PER_CENT}"),
)
OF_GIVEN_TWIST = (
    Within(
        TORQUE, 3e-5,
        "a quarter of what is allowed of a twist: near the limit the torque hardly depends on it",
        name="torque_of_given_twist",
    ),
)  # fmt: skip
OF_PUNCH = (
    Within(
        TWIST, part_of_side(1.5),
        "the twist goes as 1/radius³, and the rim is a staircase by which the radius seems to be "
        "wrong by up to half a cell",
        name="stuck_twist",
    ),
    Within(
        Observable(
            "stuck_area", "stick area over contact area of the stuck punch", "",
            lambda result, step, _: float(
                (result.steps[step].stick_area or np.nan) / result.steps[step].contact_area
            ),
            lambda _: 1.0,
        ),
        1e-12, "µ is twice what would make the rim slip",
    ),
)  # fmt: skip


def torsion(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    cells = refinement(32, 128 if level is Level.QUICK else 256)
    balls, finest = on_cells(TWISTED, cells), cells[-1:]
    punches = on_cells(STUCK, cells[::-2][::-1], PUNCH_WINDOW_PER_RADIUS, of="stuck punch")
    return case(
        "torsion",
        "Torsion with partial slip",
        "The paper's ball under 1 kN, twisted by 0.5, 0.9 and 0.99 of the torque at which all "
        "slips; to and fro by 0.9 of it; led to the twist of that torque; and a flat punch "
        "that sticks all over. Torsion moves the surfaces in circles, which no pressure "
        "couples with, so that the closed form holds for any pair of alike bodies.",
        judged(balls, OF_BALL),
        judged(named("to and fro", on_cells(TO_AND_FRO, finest)), OF_LOOP),
        judged(named("given twist", on_cells(LED, finest)), OF_GIVEN_TWIST),
        judged(named("stuck punch", punches), OF_PUNCH),
        charts=(
            convergence(
                balls,
                OF_BALL,
                "torsion_convergence",
                "Convergence of torsion",
                "Σ|q - q_exact| / Σµp against cell side for three torques, with a line of the "
                "expected slope 3/2.",
                also=(SHEARS[1], SHEARS[3]),
            ),
        ),
    )
