"""What both solvers measured against the same reference, and which was nearer."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from verification.cases.chart import Chart, Look, Panel, curve
from verification.cases.outcome import CaseOutcome, Verdict
from verification.cases.table import Table
from verification.report.numbers import plain
from verification.report.record import Report

CELLS, ELEMENTS = "cells (SAM)", "finite elements"
SERIES = {CELLS: 0, ELEMENTS: 1}
SAME = 1e-9  # relative, of two values of one reference
LEAST = 1e-8  # an error is drawn no smaller: the axis is logarithmic
MOST_SHOWN = 8  # where they are furthest apart
PENALTY = "penalty"  # springs are judged in their own study


@dataclass(frozen=True)
class Measured:
    """A verdict by one solver, on its finest run."""

    case: str
    solver: str
    fineness: float
    verdict: Verdict

    @property
    def error(self) -> float:
        """|value - reference| / |reference|."""
        reference = self.verdict.reference
        return abs((self.verdict.value or 0.0) - reference) / abs(reference)


@dataclass(frozen=True)
class SharedReference:
    """One reference, measured by both solvers."""

    cells: Measured
    elements: Measured

    @property
    def name(self) -> str:
        """The quantity, and the case of the cells."""
        return f"{self.cells.verdict.name.replace('_', ' ')}, {self.cells.case.replace('_', ' ')}"

    @property
    def difference(self) -> float:
        """Of both values, relative to the reference."""
        one, other = self.cells.verdict, self.elements.verdict
        return abs((one.value or 0.0) - (other.value or 0.0)) / abs(one.reference)

    @property
    def nearer(self) -> str:
        """The solver with the smaller error."""
        return CELLS if self.cells.error <= self.elements.error else ELEMENTS


def shared_references(report: Report) -> tuple[SharedReference, ...]:
    """Every value that both solvers were judged by, in the order of the cases."""
    by_solver: dict[str, list[Measured]] = {CELLS: [], ELEMENTS: []}
    for case in report.cases:
        for measured in _measured(case):
            by_solver[measured.solver].append(measured)
    found: dict[str, SharedReference] = {}
    for one in by_solver[CELLS]:
        for other in by_solver[ELEMENTS]:
            if _alike(one.verdict, other.verdict):
                pair = SharedReference(one, other)
                known = found.get(_key(one))
                if known is None or _fineness(pair) > _fineness(known):
                    found[_key(one)] = pair
    return tuple(found.values())


def both_solvers_chart(shared: tuple[SharedReference, ...]) -> Chart:
    """Errors of both solvers, one row per shared reference."""
    rows = list(reversed(shared))
    curves = []
    for solver, series in SERIES.items():
        measured = [pair.cells if solver == CELLS else pair.elements for pair in rows]
        drawn = [max(one.error, LEAST) for one in measured]
        curves.append(curve(solver, drawn, range(len(rows)), Look.TILES, series))
    panel = Panel(
        x_label="relative error against the same reference", y_label="", curves=tuple(curves),
        logarithmic=True, y_places=tuple(pair.name for pair in rows),
        height=0.7 + 0.2 * len(rows),
    )  # fmt: skip
    return Chart(
        name="both_solvers",
        title="Errors of both solvers against the same references",
        caption="One row per quantity that both have measured against one reference, each on its "
        f"finest run of this report; further to the left is nearer. Errors below {plain(LEAST)} "
        "are drawn there. Disc: cells; square: finite elements. A number behind “at” is the load "
        "over its limit.",
        rows=((panel,),),
    )


def furthest_apart(shared: tuple[SharedReference, ...]) -> Table:
    """The references that the solvers' values differ most of, relative to the reference."""
    worst = sorted(shared, key=lambda pair: -pair.difference)[:MOST_SHOWN]
    return Table(
        title=f"Where both solvers are furthest apart, {len(worst)} of {len(shared)}",
        columns=("quantity and case", "difference", f"error, {CELLS}", f"error, {ELEMENTS}",
                 "nearer", "fineness"),
        rows=tuple(
            (
                pair.name,
                *(f"{plain(100 * part, 2)} %"
                  for part in (pair.difference, pair.cells.error, pair.elements.error)),
                pair.nearer,
                f"{pair.cells.fineness:g} cells, {pair.elements.fineness:g} elements per radius",
            )
            for pair in worst
        ),
        note="All relative to a reference that neither solver made. A number behind “at” is the "
        "load over its limit, µW or the largest torque.",
    )  # fmt: skip


def _measured(case: CaseOutcome) -> Iterator[Measured]:
    runs = {run.label: run for run in case.runs}
    for verdict in case.verdicts:
        run = runs.get(verdict.run)
        judged = verdict.tolerance_kind != "order" and verdict.error is not None
        if run is None or not judged or verdict.value is None or verdict.reference == 0:
            continue
        if PENALTY in case.name:
            continue
        if run.cells is not None:
            yield Measured(case.name, CELLS, float(run.cells[0]), verdict)
        elif run.elements_per_radius is not None:
            yield Measured(case.name, ELEMENTS, float(run.elements_per_radius), verdict)


def _alike(one: Verdict, other: Verdict) -> bool:
    same = abs(one.reference - other.reference) <= SAME * abs(one.reference)
    words = one.name.split("_of_")[0] == other.name.split("_of_")[0]
    return same and words and one.unit == other.unit and one.unit != ""


def _key(one: Measured) -> str:
    return f"{one.case} {one.verdict.name} {one.verdict.reference:.9g}"


def _fineness(pair: SharedReference) -> tuple[float, float]:
    return pair.cells.fineness, pair.elements.fineness
