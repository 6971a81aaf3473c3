"""The paper's coatings under a rigid paraboloid, without friction."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from verification.cases.levels import ASKED, EDGE
from verification.judging.case import Case, Comparison, Level
from verification.judging.declared_case import Falls, Refined, Within, case, judged
from verification.judging.drawings import PRESSURE, convergence, profile
from verification.judging.ladder import on_cells, part_of_side
from verification.judging.observable import Observable
from verification.judging.observables import (
    APPROACH,
    CENTRAL_PRESSURE,
    CONTACT_RADIUS,
    PRESSURE_L2,
)
from verification.judging.refinement import refinement
from verification.problems.coated_ball import BARE, ROWS, coated_ball, solved_here
from verification.problems.paper_scene import HERTZ
from verification.problems.shifted_grid import UNLIKE

REQUIRED = {128: 2e-4, 256: 5e-5}  # by cells per side
COARSER = (32, 46, 64, 90)  # cells per side on which no figure is asked: for errors by fineness
STUDIED = 2.0  # E1/E2 of the row whose convergence is studied
COATINGS = {row["E1_over_E2"]: coated_ball(row) for row in ROWS}
EXACT = solved_here(COATINGS[STUDIED])
OF_STUDY = (
    Refined(
        APPROACH, 2.0, 5e-5,
        "order 2 as for the homogeneous body; the cap is the figure required at 256 x 256",
    ),
    Refined(CONTACT_RADIUS, 1.0, part_of_side(0.1), EDGE),
)  # fmt: skip
ORDERS = (
    Falls(PRESSURE_L2, 1.0, "as for the homogeneous body: the square-root edge"),
    Falls(
        CENTRAL_PRESSURE, 2.0, "as for the homogeneous body: the cells lie h/√2 from the axis"
    ),
)  # fmt: skip
MEAN = (Falls(APPROACH, 2.0, "as for the homogeneous body: the errors at the edge cancel"),)


def coated_paraboloid(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids at higher levels."""
    finest = {Level.QUICK: 256, Level.STANDARD: 512, Level.FULL: 1024}[level]
    return coated_paraboloid_on(
        refinement(32, finest), tuple(REQUIRED), COARSER, refinement(32, finest // 2)
    )


def coated_paraboloid_on(
    cells: tuple[int, ...],
    required: tuple[int, ...],
    coarser: tuple[int, ...] = (),
    shifted: tuple[int, ...] = (),
) -> Case:
    """The case on square grids: these for the study, those for all coatings, then unjudged ones.

    shifted  for the study, in two other places on the contact
    """
    bare = on_cells(BARE, cells, of="uncoated")
    grids = dict.fromkeys(COATINGS, (*coarser, *required)) | {STUDIED: cells}
    ladders = {
        ratio: on_cells(COATINGS[ratio], some, of=f"E1/E2 = {ratio:g}")
        for ratio, some in grids.items()
        if some
    }
    study = ladders[STUDIED]
    followed = replace(study, problem=EXACT)
    name = f"E1/E2 = {STUDIED:g}"
    others = [on_cells(EXACT, shifted, of=name, offsets=UNLIKE)] if shifted else []
    allowed = {n: figure for n, figure in REQUIRED.items() if n in required}
    rows = (
        Within(APPROACH, allowed, ASKED, name="required_approach"),
        Within(CENTRAL_PRESSURE, allowed, ASKED),
    )
    return case(
        "coated_paraboloid",
        "Rigid ball on coated half-spaces",
        "A rigid paraboloid of the paper's radius under 1 kN on a coated half-space (210 GPa, "
        "ν = 0.3), coatings from a quarter to ten times as stiff, without friction, on windows "
        "of three contact radii. The references come from an axisymmetric integral equation "
        "that shares nothing with the surface grid. Under the stiffest coating the largest "
        "pressure is not at the centre; the centre's is compared.",
        *(judged(one, rows) for one in ladders.values()),
        judged(study, OF_STUDY),
        judged(followed, ORDERS),
        *(judged(one, MEAN) for one in others),
        runs=bare.runs,
        comparisons=tuple(
            Comparison(
                f"constant_of_{row.what.name}",
                f"{row.what.label}: error over that of the uncoated body, less 1",
                (study.levels[-1], bare.levels[-1]), _error_ratio(row.what), 0.3,
                "the same scheme must have the same constant, up to what the shape of the "
                "pressure does to it", "errors on equal grids per contact radius",
            )
            for row in (*ORDERS, *MEAN)
        ),
        charts=(
            profile(
                followed,
                "coated_profile",
                "Pressure next to y = 0 under a coating of E1/E2 = 2",
                f"Computed pressure on {cells[-1]} x {cells[-1]} cells over the semi-closed one, "
                "and their difference, in units of the peak pressure without coating.",
                "p / p_H",
                HERTZ.peak_pressure,
                replace(PRESSURE, profile="coated"),
            ),
            convergence(
                followed,
                ORDERS,
                "coated_convergence",
                "Convergence of the coated contact beside the uncoated one",
                "Relative errors against cell side, for the coating of E1/E2 = 2 and for the "
                "homogeneous body: the same orders and nearly the same constants, because the "
                "coefficients of the coated body are as exact as the closed form.",
                also=(APPROACH,),
                beside={"uncoated": bare},
            ),
        ),
    )  # fmt: skip


def _error_ratio(what: Observable) -> Callable[[Any, Any], float]:
    coated, bare = what.error(EXACT), what.error(BARE)
    return lambda result, other: abs(abs(coated(result) / bare(other)) - 1)
