"""Charts of a verification case: tractions over the radius or along a row of cells, errors over h.

Charts of tractions show the computed and the exact profile, and their difference in a second panel.
Charts of errors have logarithmic axes, fitted lines with their confidence bands, and lines of the
expected orders.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from contact_scene.array_types import Field
from semi_analytical.grid import SurfaceGrid
from verification.convergence.observed_order import (
    ErrorLine,
    by_size,
    error_line,
    order_text,
)
from verification.exhibits.chart import Chart, Curve, Look, Panel, curve, stacked
from verification.judging.case import Run
from verification.judging.declared_case import Drawing, Falls, Observable, RefinementLevels, Row
from verification.observed.ring_errors import SHOWN, at_radii
from verification.problems.problem import Problem

BELOW = 0.4  # lines of expected slopes run under the data, by this factor
LEAST = 4  # levels that a line is fitted to
ALONG = 9  # points along a band, which is curved


def _error_curves(
    label: str,
    sizes: list[float],
    errors: list[float],
    expected: float | None,
    series: int,
) -> list[Curve]:
    """Return the chart curves of one error: points, fitted line with 95 % band, and expected slope.

    label     name of the quantity, for the legend
    sizes     cell sides over the contact radius
    errors    magnitudes of the relative error at these sizes
    expected  expected convergence order; None for no slope line
    series    number that determines the colour
    """
    ends = np.array([max(sizes), min(sizes)])
    if len(sizes) < LEAST or min(errors) <= 0:
        curves = [curve(label, sizes, errors, Look.POINTS, series)]
        start = errors[int(np.argmax(sizes))]
    else:
        line = error_line(sizes, errors)
        told = order_text(*line.observed.interval)
        curves = [
            _confidence_band(line, ends, series),
            curve("", ends, line.at(ends), Look.FITTED, series),
            curve(f"{label}: {told}", sizes, errors, Look.LEVELS, series),
        ]
        start = float(line.at(ends[:1])[0])
    if expected is not None:
        shown = BELOW * start * (ends / ends[0]) ** expected
        curves.append(curve(f"slope {expected:g}", ends, shown, Look.SLOPE, series))
    return curves


def _confidence_band(line: ErrorLine, ends: Field, series: int) -> Curve:
    """Return the outline of the 95 % confidence band of a line that is fitted to errors, as a chart
    curve.

    line    line fitted to the logarithms of errors and cell sizes
    ends    largest and smallest cell size
    series  number that determines the colour
    """
    along = np.geomspace(ends[0], ends[1], ALONG)
    low, high = line.band(along)
    return curve("", [*along, *along[::-1]], [*low, *high[::-1]], Look.BAND, series)


ALONG_X = 1.15  # contact radii to each side of the axis


class Section:
    """Row of cells of a surface grid nearest to y = 0, along which a profile chart shows fields.

    The row extends to 1.15 contact radii on both sides of the axis.

    x  coordinates x of the cell centres along the row [length]
    y  coordinate y of the row: half a cell for an even number of cells, else 0 [length]
    """

    def __init__(self, grid: SurfaceGrid, radius: float) -> None:
        self._cells = np.abs(grid.x) <= ALONG_X * radius, grid.cells[1] // 2
        columns, row = self._cells
        self.x, self.y = grid.x[columns], float(grid.y[row])

    def of(self, field: Field) -> Field:
        """Return the values of a surface field (nx, ny) at the cells of the row."""
        return np.asarray(field[self._cells])


# Number of points of an exact profile in a chart.
POINTS = 120


@dataclass(frozen=True)
class Drawn:
    """Description of one pair of curves in a profile chart: a computed and an exact field of a load
    step.

    found  function from the increment at the end of the step to the computed field
    exact  function from the exact answer to the exact field, a function of the radius r
    label  name of the curve
    step   index of the load step
    """

    found: Callable[[Any], Field]
    exact: Callable[[Any], Callable[[Field], Field]]
    label: str = "computed"
    step: int = -1


PRESSURE = Drawn(lambda end: end.pressure, lambda exact: exact.pressure)


# Coordinates and computed field, coordinates and exact field, and their difference at the latter.
Profile = tuple[tuple[Field, Field], tuple[Field, Field], Field]


def _along_section(result: Any, problem: Problem, one: Drawn) -> Profile:
    section = Section(result.grid, problem.radius)
    found = section.of(one.found(result.steps[one.step]))
    exact = one.exact(problem.ends[one.step])
    known = problem.on_surface(exact, section.x, section.y)
    return (section.x, found), (section.x, known), found - known


def _over_rings(result: Any, problem: Problem, one: Drawn) -> Profile:
    end, answer = result.steps[one.step], problem.ends[one.step]
    shown, found = end.radii <= SHOWN * problem.radius, one.found(end)
    r = getattr(answer, "radii", np.linspace(0.0, problem.radius, POINTS))
    known = one.exact(answer)(r)
    return (end.radii[shown], found[shown]), (r, known), at_radii(end, found, r) - known


def profile(
    ladder: RefinementLevels,
    name: str,
    title: str,
    caption: str,
    y_label: str,
    unit: float,
    *drawn: Drawn,
) -> Drawing:
    """Return a function that draws computed fields of the judged run together with the exact
    fields.

    The function receives the results of a case by run label. On cells the chart shows the row of
    cells next to y = 0, on finite elements the values over the radius.

    ladder   refinement levels, of which the judged run is drawn
    name     file name of the chart
    y_label  label of the ordinate
    unit     unit of the ordinate, in SI
    drawn    fields to draw; default: the pressure at the end of the last step
    """
    problem, run = ladder.problem, ladder.judged
    fields = drawn or (PRESSURE,)

    on_cells = isinstance(run, Run)
    read = _along_section if on_cells else _over_rings

    def draw(results: Mapping[str, Any]) -> Chart:
        references, profiles, differences = [], [], []
        for n, one in enumerate(fields):
            (x, found), (places, known), off = read(results[run.label], problem, one)
            x, places = x / problem.radius, places / problem.radius
            label = ("closed form" if on_cells else "reference") if n == 0 else ""
            references.append(curve(label, places, known / unit, Look.REFERENCE))
            label = one.label if on_cells else "finite elements"
            profiles.append(curve(label, x, found / unit, Look.COMPUTED, n))
            differences.append(curve("", places, off / unit, Look.COMPUTED, n))
        above = Panel(x_label="", y_label=y_label, curves=(*references, *profiles), height=2.6)
        across = "x / a" if on_cells else "r / a"
        below = Panel(x_label=across, y_label=f"Δ{y_label}", curves=tuple(differences))
        return stacked(name, title, caption, above, below)

    return draw


def convergence(
    ladder: RefinementLevels,
    rows: Sequence[Row],
    name: str,
    title: str,
    caption: str,
    also: Sequence[Observable] = (),
) -> Drawing:
    """Return a function that draws relative errors of observables over the cell or element side h.

    Lines of the expected slope show the order of convergence. The function receives the results of
    a case by run label.

    ladder  refinement levels from which orders of convergence are computed
    rows    rows of the case; those of type Falls have an expected slope
    name    file name of the chart
    also    observables whose errors are drawn without an expected slope
    """
    cells = isinstance(ladder.judged, Run)
    unit = ladder.problem.radius if cells else 1.0
    spacings = [run.spacing / unit for run in ladder.followed]
    expected = {row.what: row.expected for row in rows if isinstance(row, Falls)}

    def draw(results: Mapping[str, Any]) -> Chart:
        curves: list[Curve] = []
        for series, one in enumerate((*expected, *also)):
            error = one.error(ladder.problem)
            # Errors of equal sizes are replaced by their root mean square.
            sizes, means = by_size(spacings, [error(results[run]) for run in ladder.levels])
            curves += _error_curves(one.label, sizes, means, expected.get(one), series)
        panel = Panel(
            x_label=f"{'cell' if cells else 'element'} side / contact radius",
            y_label="relative error",
            curves=tuple(curves),
            logarithmic=True,
        )
        legend = (
            "Numbers are the slopes of the fitted lines with their 95 % intervals, bands those of "
            "the lines. Dashed below: the expected slopes."
        )
        return stacked(name, title, f"{caption} {legend}", panel)

    return draw
