"""Profiles of both solvers and of what they are judged by, with both differences below."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import inf

from verification.exhibits.chart import Chart, Curve, Look, Panel, curve
from verification.report.both_solvers import SERIES, WORDS
from verification.running.report_record import Report
from verification.solver import Solver


@dataclass(frozen=True)
class SameProfile:
    """One profile by both solvers; the references of both are the same function of r/a.

    name      that its curves have in the charts of cases
    edges     r/a where the profile has a kink or a vertical tangent
    why_same  what a reader must know of two cases that are not one problem; may be empty
    """

    name: str
    title: str
    why_same: str = ""
    edges: tuple[float, ...] = (1.0,)


@dataclass(frozen=True)
class Drawn:
    """Reference, profile and difference as a chart has them, right of the axis."""

    reference: Curve
    computed: Curve
    difference: Curve
    y_labels: tuple[str, str]


NEAR = 0.1  # to each side of an edge
MAGNIFIED, AS_TEXT = 1e3, "10³"
SAME = (
    SameProfile("hertz", "Hertz's pressure"),
    SameProfile("coated", "Pressure on a coating of E1/E2 = 2, as thick as a_H"),
    SameProfile(
        "cattaneo_mindlin", "Cattaneo and Mindlin's shear at 0.9 µW",
        " The cells have ν = 0 and the elements ν = 0.3: over µp₀ the closed form is the same.",
        ((1 - 0.9) ** (1 / 3), 1.0),
    ),
)  # fmt: skip


def profiles_together(report: Report) -> tuple[Chart, ...]:
    """A chart of every profile that both solvers have in this report."""
    return tuple(
        _chart(same, cells, elements)
        for same in SAME
        for cells in _found(report, same, Solver.CELLS)
        for elements in _found(report, same, Solver.ELEMENTS)
    )


def _found(report: Report, same: SameProfile, solver: Solver) -> Iterator[Drawn]:
    """At most one: a profile is drawn once by either solver."""
    for case in report.cases:
        for chart in case.charts:
            panels = [row[0] for row in chart.rows]
            found = [
                (one, panel)
                for panel in panels
                for one in panel.curves
                if one.profile == same.name and one.solver is solver
            ]
            if found:
                (reference, above), (computed, _), (difference, below) = found
                yield Drawn(
                    _right_of_axis(reference), _right_of_axis(computed),
                    _right_of_axis(difference), (above.y_label, below.y_label),
                )  # fmt: skip


def _right_of_axis(one: Curve) -> Curve:
    return _part(one, 0.0, inf, one.look)


def _part(
    one: Curve, start: float, end: float, look: Look = Look.COMPUTED, factor: float = 1.0
) -> Curve:
    """The points with start ≤ x ≤ end, y times a factor."""
    points = [(x, y) for x, y in zip(one.x, one.y, strict=True) if start <= x <= end]
    return curve("", (x for x, _ in points), (factor * y for _, y in points), look)


def _chart(same: SameProfile, cells: Drawn, elements: Drawn) -> Chart:
    by = {Solver.CELLS: cells, Solver.ELEMENTS: elements}
    above = Panel(
        x_label="", y_label=cells.y_labels[0], height=2.4,
        curves=(
            curve("reference", cells.reference.x, cells.reference.y, Look.REFERENCE),
            *(_named(drawn.computed, solver) for solver, drawn in by.items()),
        ),
    )  # fmt: skip
    below = Panel(
        x_label="", y_label=cells.y_labels[1],
        curves=tuple(_named(drawn.difference, solver, "") for solver, drawn in by.items()),
    )  # fmt: skip
    away = Panel(
        x_label="r / a", y_label=f"{AS_TEXT} {cells.y_labels[1]}",
        curves=tuple(
            _named(part, solver, "")
            for solver, drawn in by.items()
            for part in _away_from(same.edges, drawn.difference)
        ),
    )  # fmt: skip
    return Chart(
        name=f"together_{same.name}",
        title=f"{same.title} by both solvers",
        caption="Grey: the reference, which neither solver made. In the middle what either differs "
        f"from it; below {AS_TEXT} times that, {NEAR:g} a to each side of "
        f"{'the edge' if len(same.edges) == 1 else 'every edge'} left out. Cells (those next to "
        "y = 0) solid, elements dashed, each on the finest run of its case: they are not equally "
        "fine, so this does not say which is nearer. A reference in a table is compared at its "
        f"radii alone.{same.why_same}",
        rows=((above,), (below,), (away,)),
    )


def _away_from(edges: tuple[float, ...], one: Curve) -> Iterator[Curve]:
    """The parts of a difference between the edges, magnified."""
    for start, end in pairwise((-NEAR, *edges)):
        part = _part(one, start + NEAR, end - NEAR, factor=MAGNIFIED)
        if part.x:
            yield part


def _named(one: Curve, solver: Solver, label: str | None = None) -> Curve:
    text = WORDS[solver] if label is None else label
    return curve(text, one.x, one.y, series=SERIES[solver])
