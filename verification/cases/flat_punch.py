"""A flat punch on a half-space: the pressure is infinite at the rim."""

from __future__ import annotations

from verification.judging.case import Case, Level
from verification.judging.declared_case import Falls, Within, case, judged
from verification.judging.drawings import convergence
from verification.judging.ladder import on_cells, part_of_side
from verification.judging.observables import APPROACH, CENTRAL_PRESSURE
from verification.judging.refinement import refinement
from verification.problems.classical import PUNCH, PUNCH_WINDOW

STAIRCASE = (
    "the rim is a staircase of cells and carries an infinite pressure, so the punch seems larger "
    "or smaller by a part of a cell"
)
ROWS = (
    Within(APPROACH, part_of_side(0.5), f"half a cell over the radius: {STAIRCASE}"),
    Within(
        CENTRAL_PRESSURE, part_of_side(1.0),
        f"one cell over the radius: pressure goes as 1/radius², and {STAIRCASE}",
    ),
)  # fmt: skip
DRAWN = (Falls(APPROACH, 1.0, STAIRCASE),)  # not judged: see the limits


def flat_punch(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    cells = refinement(32, 128 if level is Level.QUICK else 256)
    grids = on_cells(PUNCH, cells, PUNCH_WINDOW)
    return case(
        "flat_punch",
        "Flat punch on a half-space",
        "A flat-ended cylinder of 0.4 mm radius under 1 kN. Contact radius and approach are "
        "proportional; the pressure is singular at the rim, as 1/√(distance).",
        judged(grids, ROWS),
        charts=(
            convergence(
                grids,
                DRAWN,
                "flat_punch_convergence",
                "Convergence of the flat punch",
                "Relative errors against cell side, with a line of slope one.",
                also=(CENTRAL_PRESSURE,),
            ),
        ),
        limits=(
            "First order in the cell side with scatter: how the circle cuts the cells differs from "
            "grid to grid, so no order is judged.",
        ),
    )
