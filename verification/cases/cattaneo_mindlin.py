"""Cattaneo-Mindlin: constant normal force, tangential force raised step by step, ν = 0."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from verification.judging.case import Case, Level
from verification.judging.declared_case import Falls, Refined, Within, case, judged
from verification.judging.drawings import Drawn, convergence, profile
from verification.judging.ladder import on_cells, part_of_side
from verification.judging.observable import error_norm
from verification.judging.observables import ENERGY, SHEAR, SHIFT, STICK_RADIUS, WORK
from verification.judging.refinement import refinement
from verification.problems.paper_scene import FRICTION, HERTZ
from verification.problems.problem import Problem
from verification.problems.sheared import OVER_SLIDING_SHIFT, sheared
from verification.problems.shifted_grid import OFFSETS, UNLIKE
from verification.quantities import shear_of

PARTS = (0.3, 0.6, 0.9, 0.99)  # of µW, one loading step each
STOPS = dict(enumerate(PARTS, 1))  # by step
LOOPED = 3  # the step to 0.9 µW, the amplitude of the fretting loop
CATTANEO = sheared("Cattaneo-Mindlin, ν = 0", PARTS)
# Without stops on the way the shear is the same.
AT_ONCE = sheared("Cattaneo-Mindlin at once, ν = 0", (STOPS[LOOPED],))


def _slip_error(result: Any, step: int, problem: Problem) -> float:
    end = result.steps[step]
    exact = problem.on_surface(problem.ends[step].slip, *result.grid.coordinates())
    missed = np.hypot(end.slip[0] - exact, end.slip[1])
    return float(np.mean(missed[end.in_contact]))


SLIP = error_norm(
    "slip", "mean difference of the slip in the contact{when}", _slip_error, unit="m",
    over=OVER_SLIDING_SHIFT,
)  # fmt: skip
SHEARS = {part: SHEAR.at(step, part, "µW") for step, part in STOPS.items()}
ROWS = (
    *(
        row
        for step, part in STOPS.items()
        for row in (
            Within(
                SHEARS[part], 2e-3,
                "required of the fretting loop at 128 x 128, which passes through here",
            ),
            Refined(
                STICK_RADIUS.at(step, part, "µW"), 1.0, part_of_side(0.2),
                "order 1: the border is known to a part of a cell; the cap is a fifth of a cell",
            ),
            Within(
                SHIFT.at(step, part, "µW"), 3e-5,
                "four times what 128 cells leave; 1e-4 is required of the fretting loop",
            ),
            Refined(
                SLIP.at(step, part, "µW"), 1.5, 1e-4,
                "order 3/2 of the shear's L1 error; the cap is what is required of the shift, of "
                "which slip is a part",
            ),
        )
    ),
    Within(
        ENERGY.at(LOOPED, STOPS[LOOPED], "µW"), 1e-4,
        "four times what 128 cells leave; 5e-4 is required of the fretting loop's cycle",
    ),
)  # fmt: skip
EDGES = (
    "square-root edges of stick zone and contact: an error of O(√h) on rings one cell wide leaves "
    "O(h^3/2) in L1"
)
ORDERS = (Falls(SHEARS[STOPS[LOOPED]], 1.5, EDGES),)
ORDER_AT_ONCE = (Falls(SHEAR.at(1, STOPS[LOOPED], "µW"), 1.5, EDGES),)
STOPPED = "0.3, 0.6, 0.9 and 0.99 µW"
MEANS = (
    Falls(
        SHIFT.over_stops(STOPPED), 2.5,
        "the shift is the difference of two approaches, of the contact and of the stick zone "
        "(Cattaneo), and both are wrong by the same 0.04 h²/R; what is left depends on how circles "
        "cut the cells, O(h^5/2)",
    ),
)  # fmt: skip


def cattaneo_mindlin(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids at higher levels. Orders of means are judged above the quick one,
    where coarse grids tell that of the shear only together with shifted ones."""
    finest = {Level.QUICK: 128, Level.STANDARD: 256, Level.FULL: 512}[level]
    shifted = () if level is Level.QUICK else refinement(32, 256)
    return cattaneo_mindlin_on(
        refinement(32, finest), shifted, refinement(32, finest) if level is Level.QUICK else ()
    )


def cattaneo_mindlin_on(
    cells: tuple[int, ...], shifted: tuple[int, ...] = (), at_once: tuple[int, ...] = ()
) -> Case:
    """The case on square grids of these many cells per side.

    shifted  cells per side of grids that fall on the contact in other ways too
    at_once  of such grids on which the order of the shear is judged, sheared without stops; none:
             it is judged on `cells`
    """
    grids = on_cells(CATTANEO, cells)
    others = [on_cells(CATTANEO, shifted, offsets=OFFSETS)] if shifted else []
    orders = (
        judged(on_cells(AT_ONCE, at_once, offsets=UNLIKE, of="at once"), ORDER_AT_ONCE)
        if at_once
        else judged(grids, ORDERS)
    )
    return case(
        "cattaneo_mindlin",
        "Cattaneo-Mindlin partial slip",
        "The paper's contact with ν = 0 and the same E*, under 1 kN, sheared by 0.3, 0.6, 0.9 "
        "and 0.99 of µW. Only for ν = 0 does the slip of the closed form oppose its traction "
        "everywhere, so only there is it the exact answer to Coulomb's vector law.",
        judged(grids, ROWS),
        orders,
        *(judged(one, MEANS) for one in others),
        charts=(
            profile(
                grids,
                "cattaneo_profiles",
                "Shear next to y = 0",
                f"Computed shear on {cells[-1]} x {cells[-1]} cells at four tangential forces over "
                "the closed form, and their difference: it sits at the border of the stick zone "
                "and at the edge of the contact.",
                "qₓ / µp₀",
                FRICTION * HERTZ.peak_pressure,
                *(
                    replace(one, profile="cattaneo_mindlin") if one.step == LOOPED else one
                    for one in shears_along_x(STOPS)
                ),
            ),
            convergence(
                grids,
                ORDERS,
                "cattaneo_convergence",
                "Convergence of the shear",
                "Σ|q - q_exact| / Σµp against cell side for four tangential forces, with a line of "
                "the expected slope 3/2.",
                also=[shear for part, shear in SHEARS.items() if part != STOPS[LOOPED]],
            ),
            *(
                convergence(
                    one,
                    MEANS,
                    "cattaneo_convergence_of_means",
                    "Convergence of shift and dissipated energy",
                    "Errors at all four tangential forces on grids that fall on the contact in "
                    "several ways, root mean square: single ones change their sign.",
                    also=(WORK.over_stops(STOPPED),),
                )
                for one in others
            ),
        ),
    )


def shears_along_x(stops: dict[int, float]) -> list[Drawn]:
    """The shear at the end of every step, beside the exact one."""
    return [
        Drawn(lambda end: shear_of(end)[0], lambda exact: exact.shear, f"{part:g} µW", step)
        for step, part in stops.items()
    ]
