"""What the study of sampling shows: distances from the exact coefficients, and from the solution
that they give."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.studies.refinement import page

COEFFICIENTS = {
    "own": "loaded cell",
    "neighbour": "next cell",
    "far": "last cell",
    "far_shape": "last cell, shape",
    "coupling": "coupling",
}
LEAST = 1e-12  # drawn; smaller errors are round-off


@dataclass(frozen=True)
class Swept:
    """One factor of the sampling, the other one held.

    axis          what the factor is, for people
    factors       its values
    coefficients  errors at each, by the names of `SamplingErrors`
    solution      distances from the exact solution at each, by quantity
    """

    name: str
    axis: str
    factors: tuple[int, ...]
    coefficients: tuple[Mapping[str, float], ...]
    solution: tuple[Mapping[str, float], ...]


def error_chart(swept: Swept, held: str) -> Chart:
    """Errors against the factor."""
    names = {name: page.label(name) for name in swept.solution[-1]}
    return Chart(
        name=f"sampling_{swept.name}",
        title=f"Sampled response against the {swept.axis}",
        caption=f"Distance from the exact coefficients, relative to the coefficient, and of the "
        f"solution from the one by exact coefficients on the same grid; {held}. Where a curve "
        "levels out, the factor that is held decides.",
        rows=(
            (_panel("influence coefficients", "", swept, swept.coefficients, COEFFICIENTS),),
            (_panel("solution of the scene", swept.axis, swept, swept.solution, names),),
        ),
    )


def _panel(
    title: str,
    x_label: str,
    swept: Swept,
    errors: Sequence[Mapping[str, float]],
    names: Mapping[str, str],
) -> Panel:
    curves = []
    for series, (name, words) in enumerate(names.items()):
        values = [abs(error[name]) for error in errors]
        if min(values) > LEAST:
            curves.append(curve(words, swept.factors, values, Look.POINTS, series))
    return Panel(
        x_label=x_label,
        y_label="relative error",
        curves=tuple(curves),
        title=title,
        logarithmic=True,
        height=2.0,
    )


def error_table(sweeps: Sequence[Swept]) -> Table:
    """One row per setting."""
    names = sweeps[0].solution[-1]
    rows = [
        (
            f"{swept.axis} {factor}",
            *(f"{plain(100 * coefficients[name], 2)} %" for name in COEFFICIENTS),
            *(f"{plain(100 * solution[name], 2)} %" for name in names),
        )
        for swept in sweeps
        for factor, coefficients, solution in zip(
            swept.factors, swept.coefficients, swept.solution, strict=True
        )
    ]
    return Table(
        title="Distance from exact coefficients",
        columns=("setting", *COEFFICIENTS.values(), *(page.label(name) for name in names)),
        rows=tuple(rows),
        note="Coefficients with their sign, relative to the exact one: the first five columns. The "
        "shape at the last cell is what is left there after the error halfway is taken off. Then "
        "the solution of the scene, next to the one by exact coefficients on the same grid.",
    )
