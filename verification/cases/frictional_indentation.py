"""A rigid ball pressed on bodies that slip away below it: friction before anything pushes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

from verification.cases.indentation_charts import indentation_chart, indentation_table
from verification.judging.case import Case, Comparison, Level
from verification.judging.declared_case import Drawing, Reported, Within, case, judged
from verification.judging.ladder import Ladder, cells_label, named, on_cells
from verification.judging.observables import APPROACH, CONTACT_RADIUS
from verification.judging.pressing_errors import PRESSURE, SHEAR, SHEAR_AT_EDGE
from verification.observed.end_state import stick_radius
from verification.problems.indentation import (
    COATED,
    FEW,
    MANY,
    NU_ZERO,
    STRONG,
    WEAK,
    Indentation,
)
from verification.problems.reference import ReferenceKind

ASKED = "asked of the coupled solver on 256 x 256 cells"
ROWS = (
    Within(APPROACH, 2e-4, ASKED),
    Within(CONTACT_RADIUS, 3e-3, ASKED),
    Within(PRESSURE, 5e-3, ASKED),
    Within(SHEAR, 1e-2, ASKED),
    Within(SHEAR_AT_EDGE, 3e-2, ASKED),
)


def frictional_indentation(level: Level = Level.QUICK) -> Case:
    """The case: a coarse grid at the quick level, the one that figures are asked on above."""
    if level is Level.QUICK:
        return frictional_indentation_on(96, (WEAK, STRONG, COATED), extrapolated=())
    return frictional_indentation_on(256, (WEAK, STRONG, NU_ZERO, COATED), (WEAK, STRONG))


def frictional_indentation_on(
    cells: int, contacts: Sequence[Indentation], extrapolated: Sequence[Indentation]
) -> Case:
    """The case on a square grid: these are judged, the stick radius of those is extrapolated."""
    grids = {
        one: {
            n: on_grid(one, cells, n)
            for n in (FEW, MANY)
            if n == one.increments or one in extrapolated
        }
        for one in contacts
    }
    return case(
        "frictional_indentation",
        "Pressing with friction",
        "The paper's ball, rigid, pressed by 1 kN on bodies of the paper's E* and on its "
        "coated one. Their surfaces move towards the axis below the ball; friction resists, "
        "and all but a central disc slips. Pressure and shear act on each other, and the shear "
        "of the disc remembers the whole way. The references come from integral equations over "
        "the radius.",
        *(
            judged(grid, ROWS if n == one.increments else _unjudged(one, n))
            for one, each in grids.items()
            for n, grid in each.items()
        ),
        comparisons=tuple(
            Comparison(
                f"stick_radius_{one.file_name}", f"{one.name}: relative error of the stick radius, "
                f"extrapolated from {FEW} and {MANY} increments",
                (grids[one][FEW].levels[0], grids[one][MANY].levels[0]),
                partial(stick_error, one), 2e-2, ASKED,
                one.source, ReferenceKind.SEMI_CLOSED,
            )
            for one in extrapolated
        ),
        charts=tuple(_chart(one, each[one.increments]) for one, each in grids.items()),
        tables=lambda results: (
            indentation_table(
                [
                    (one, results[grid.levels[0]])
                    for one, each in grids.items() for grid in each.values()
                ]
            ),
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


def _unjudged(one: Indentation, increments: int) -> tuple[Reported, ...]:
    if increments > one.increments:
        return ()
    return (Reported(SHEAR, f"not judged: {one.increments} increments are"),)


def stick_error(one: Indentation, few: Any, many: Any) -> float:
    """Relative error of the stick radius, extrapolated in the increments."""
    radius = 2 * stick_radius(many) - stick_radius(few)
    return abs(radius / (one.stick_part * one.contact_radius) - 1)


def _chart(one: Indentation, grid: Ladder) -> Drawing:
    def draw(results: Mapping[str, Any]) -> Any:
        return indentation_chart(one, results[grid.levels[0]])

    return draw
