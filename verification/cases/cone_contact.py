"""A cone on a half-space: pressure with a logarithmic peak under the apex."""

from __future__ import annotations

from verification.cases.hertz_point import EDGE
from verification.judging.case import Case, Level
from verification.judging.declared_case import Falls, Refined, case, judged
from verification.judging.drawings import profile
from verification.judging.ladder import on_cells, part_of_side
from verification.judging.observables import APPROACH, CONTACT_RADIUS, PRESSURE_L1
from verification.judging.refinement import refinement
from verification.problems.classical import CONE, mean_pressure
from verification.problems.shifted_grid import UNLIKE

ROWS = (
    Refined(
        APPROACH, 2.0, 1e-4,
        "order 2: the apex falls between cells and moves the load of a few of them; the cap is "
        "twice what is required of the ball",
    ),
    Refined(CONTACT_RADIUS, 1.0, part_of_side(0.1), EDGE),
)  # fmt: skip
ORDER = (
    Falls(
        PRESSURE_L1, 1.5,
        "at the edge O(√h) on a ring one cell wide; the logarithm at the apex is O(1) in a few "
        "cells, O(h²)",
    ),
)  # fmt: skip


def cone_contact(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    cells = refinement(32, 128 if level is Level.QUICK else 256)
    grids = on_cells(CONE, cells)
    return case(
        "cone_contact",
        "Cone on a half-space",
        "A cone whose flanks rise by 1° under 1 kN. The pressure is infinite under the apex, as a "
        "logarithm, and falls to zero at the edge.",
        judged(grids, ROWS),
        judged(on_cells(CONE, cells, offsets=UNLIKE), ORDER),
        charts=(
            profile(
                grids,
                "cone_profile",
                "Pressure next to y = 0",
                "Computed pressure over the exact one, in units of the mean pressure, and their "
                "difference.",
                "p / mean p",
                mean_pressure(CONE),
            ),
        ),
        limits=("The pressure of the cells at the apex is an average of an infinite peak.",),
    )
