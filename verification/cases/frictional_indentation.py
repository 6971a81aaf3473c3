"""A rigid ball pressed on bodies that slip away below it: friction before anything pushes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from verification.cases.fem_indentation import STICK_PART
from verification.cases.indentation_charts import indentation_chart, indentation_table
from verification.judging.case import Case, Level
from verification.judging.declared_case import Drawing, Within, case, judged
from verification.judging.ladder import Ladder, cells_label, named, on_cells
from verification.judging.observables import APPROACH, CONTACT_RADIUS
from verification.judging.pressing_errors import PRESSURE, SHEAR, SHEAR_AT_EDGE
from verification.problems.indentation import (
    COATED,
    FEW,
    MANY,
    NU_ZERO,
    STRONG,
    WEAK,
    Indentation,
)

ASKED = "asked of the coupled solver on 256 x 256 cells"
ROWS = (
    Within(APPROACH, 2e-4, ASKED),
    Within(CONTACT_RADIUS, 3e-3, ASKED),
    Within(PRESSURE, 5e-3, ASKED),
    Within(SHEAR, 1e-2, ASKED),
    Within(SHEAR_AT_EDGE, 3e-2, ASKED),
)
STUCK = Within(STICK_PART, 1e-2, ASKED)


def frictional_indentation(level: Level = Level.QUICK) -> Case:
    """The case: a coarse grid at the quick level, the one that figures are asked on above."""
    if level is Level.QUICK:
        return frictional_indentation_on(96, (WEAK, STRONG, COATED), stuck=())
    return frictional_indentation_on(256, (WEAK, STRONG, NU_ZERO, COATED), (WEAK, STRONG))


def frictional_indentation_on(
    cells: int, contacts: Sequence[Indentation], stuck: Sequence[Indentation]
) -> Case:
    """The case on a square grid: these are judged, of those the stick radius, too."""
    grids = {one: on_grid(one, cells, one.increments) for one in contacts}
    return case(
        "frictional_indentation",
        "Pressing with friction",
        "The paper's ball, rigid, pressed by 1 kN on bodies of the paper's E* and on its "
        "coated one. Their surfaces move towards the axis below the ball; friction resists, "
        "and all but a central disc slips. Pressure and shear act on each other, and the shear "
        "of the disc remembers the whole way. The references come from integral equations over "
        "the radius.",
        *(
            judged(grid, (*ROWS, STUCK) if one in stuck else ROWS)
            for one, grid in grids.items()
        ),
        charts=tuple(_chart(one, grid) for one, grid in grids.items()),
        tables=lambda results: (
            indentation_table([(one, results[grid.levels[0]]) for one, grid in grids.items()]),
        ),
        limits=(
            f"{STRONG.name} takes {MANY} increments to come within 1e-2 of the shear; with {FEW} "
            "the steps of the stick edge leave ripples of up to 2e-2 in the stick zone.",
            "The stick disc of the coated body is a few cells wide; its radius is not judged.",
        ),
    )  # fmt: skip


def on_grid(one: Indentation, cells: int, increments: int) -> Ladder:
    """Pressed in so many increments, on a window of three contact radii."""
    label = f"{one.name}, {cells_label(cells)}, {increments} increments"
    return named(label, on_cells(one.problem(increments), (cells,), of=one.name))


def _chart(one: Indentation, grid: Ladder) -> Drawing:
    def draw(results: Mapping[str, Any]) -> Any:
        return indentation_chart(one, results[grid.levels[0]])

    return draw
