"""What the study of sampling shows: distances from the exact coefficients, and from the solution
that they give."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from verification.exhibits.chart import Chart, Panel, stacked
from verification.exhibits.log_chart import point_curves
from verification.exhibits.numbers import percent
from verification.exhibits.table import Table, table_of
from verification.running.row import CaseRecord, Row, value_of
from verification.running.row_views import Text, points
from verification.studies.refinement import page
from verification.studies.refinement.fit import distance

REFINEMENT, EXTENSION = "refinement", "extension"
AXES = {REFINEMENT: "samples per cell side", EXTENSION: "period over twice the window"}
COEFFICIENTS = {
    "own": "loaded cell",
    "neighbour": "next cell",
    "far": "last cell",
    "far_shape": "last cell, shape",
    "coupling": "coupling",
}
LEAST = 1e-12  # drawn; smaller errors are round-off


def distances(factor: str, levels: Iterable[CaseRecord], exact: CaseRecord) -> tuple[Row, ...]:
    """What every level of a factor is off by: its coefficients with their sign, relative to the
    exact ones, and its solution, relative to the one that these give."""
    return tuple(
        Row(
            parameters={"factor": factor, "value": level.parameters[factor]},
            measures={**level.parts[0].measures, **distance(level, exact)},
        )
        for level in levels
    )


def quantities(row: Row) -> tuple[str, ...]:
    """Those of the solution, among its measures."""
    return tuple(name for name in row.measures if name not in COEFFICIENTS)


def error_chart(rows: Sequence[Row], held: str) -> Chart:
    """Errors against the factor."""
    factor = str(rows[0].parameters["factor"])
    names = {name: page.label(name) for name in quantities(rows[-1])}
    return stacked(
        f"sampling_{factor}",
        f"Sampled response against the {AXES[factor]}",
        f"Distance from the exact coefficients, relative to the coefficient, and of the "
        f"solution from the one by exact coefficients on the same grid; {held}. Where a curve "
        "levels out, the factor that is held decides.",
        _panel("influence coefficients", "", rows, COEFFICIENTS),
        _panel("solution of the scene", AXES[factor], rows, names),
    )


def _panel(title: str, x_label: str, rows: Sequence[Row], names: Mapping[str, str]) -> Panel:
    lines = {words: points(rows, "value", name) for name, words in names.items()}
    drawn = {
        words: line if len(line) == len(rows) and min(y for _, y in line) > LEAST else ()
        for words, line in lines.items()
    }
    return Panel(
        x_label=x_label,
        y_label="relative error",
        curves=tuple(point_curves(drawn.items())),
        title=title,
        logarithmic=True,
        height=2.0,
    )


def error_table(sweeps: Iterable[Sequence[Row]]) -> Table:
    """One line per setting."""
    rows = [row for of in sweeps for row in of]
    columns: dict[str, Text] = {
        "setting": lambda row: f"{AXES[str(row.parameters['factor'])]} {row.parameters['value']}",
        **{words: _percent(name) for name, words in COEFFICIENTS.items()},
        **{page.label(name): _percent(name) for name in quantities(rows[0])},
    }
    return table_of(
        "Distance from exact coefficients",
        columns,
        rows,
        "Coefficients with their sign, relative to the exact one: the first five columns. The "
        "shape at the last cell is what is left there after the error halfway is taken off. Then "
        "the solution of the scene, next to the one by exact coefficients on the same grid.",
    )


def _percent(name: str) -> Text:
    return lambda row: percent(value_of(row, name))
