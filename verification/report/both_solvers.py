"""What both solvers measured against the same reference."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.judging.outcome import CaseOutcome, Verdict
from verification.running.report_record import Report

CELLS, ELEMENTS = "cells (SAM)", "finite elements"
SERIES = {CELLS: 0, ELEMENTS: 1}
SAME = 1e-9  # relative, of two values of one reference
LEAST = 1e-8  # an error is drawn no smaller: the axis is logarithmic
COVERAGE = 2.0  # standard uncertainties of a reference
MOST_SHOWN = 8  # where they are furthest apart
REQUIRED = "required_"  # begins the name of a value that is judged twice on one run
GROUPS = ("approach", "pressure", "radius")  # by a word of the quantity's name
OTHERS = "forces, shifts, twists and energies"
FINENESS = re.compile(r",? ?\d+(x\d+| cells| increments)")  # in the label of a run
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
        """The quantity, the case of the cells, and which of its problems."""
        return ", ".join((self._quantity, *self._place))

    @property
    def row(self) -> str:
        """The same in a chart of its kind."""
        rest = " ".join(self._quantity.replace(self.group, "").split())
        return ", ".join((*([rest] if rest else []), *self._place))

    @property
    def _quantity(self) -> str:
        return _word(self.cells.verdict).replace("_", " ")

    @property
    def _place(self) -> list[str]:
        problem = FINENESS.sub("", self.cells.verdict.run).strip(", ")
        return [self.cells.case.replace("_", " "), *([problem] if problem else [])]

    @property
    def group(self) -> str:
        """What kind of quantity it is."""
        found = (kind for kind in GROUPS if kind in self.cells.verdict.name)
        return next(found, OTHERS)

    @property
    def difference(self) -> float:
        """Of both values, relative to the reference."""
        one, other = self.cells.verdict, self.elements.verdict
        return abs((one.value or 0.0) - (other.value or 0.0)) / abs(one.reference)

    @property
    def reference(self) -> tuple[str, str]:
        """Tells references apart: some are of several cases."""
        return f"{self.cells.verdict.reference:.9g}", self._quantity

    @property
    def uncertainty(self) -> float:
        """Standard uncertainty of the reference, relative to it; the larger one where it is exact
        for the problem of one solver and approximate for that of the other."""
        verdicts = self.cells.verdict, self.elements.verdict
        return max((one.reference_uncertainty or 0.0) / abs(one.reference) for one in verdicts)

    @property
    def tells(self) -> bool:
        """Whether the reference is known well enough to say which value is nearer to it."""
        return abs(self.cells.error - self.elements.error) > COVERAGE * self.uncertainty


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


def both_solvers_charts(shared: tuple[SharedReference, ...]) -> tuple[Chart, ...]:
    """Errors of both solvers, a chart per kind of quantity, a row per shared reference."""
    once: dict[tuple[str, str], SharedReference] = {}
    for pair in shared:
        once.setdefault(pair.reference, pair)
    return tuple(
        _chart(group, of)
        for group in (*GROUPS, OTHERS)
        if (of := [pair for pair in once.values() if pair.group == group])
    )


def _chart(group: str, shared: list[SharedReference]) -> Chart:
    rows = shared[::-1]
    curves = []
    for solver, series in SERIES.items():
        measured = [pair.cells if solver == CELLS else pair.elements for pair in rows]
        drawn = [max(one.error, LEAST) for one in measured]
        curves.append(curve(solver, drawn, range(len(rows)), Look.TILES, series))
    panel = Panel(
        x_label="relative error against the same reference", y_label="", curves=tuple(curves),
        logarithmic=True, y_places=tuple(pair.row for pair in rows),
        height=0.7 + 0.2 * len(rows),
    )  # fmt: skip
    return Chart(
        name=f"both_solvers_{group.partition(' ')[0].strip(',')}",
        title=f"Errors of both solvers against the same references: {group}",
        caption="One row per reference that both have measured against, each on its finest run of "
        f"this report; further to the left is nearer. Errors below {plain(LEAST)} are drawn there. "
        "Disc: cells; square: finite elements. A number behind “at” is the load over its limit.",
        rows=((panel,),),
    )


def furthest_apart(shared: tuple[SharedReference, ...]) -> Table:
    """Where the solvers' values differ most, relative to the reference."""
    worst = sorted(shared, key=lambda pair: -pair.difference)[:MOST_SHOWN]
    return Table(
        title=f"Where both solvers are furthest apart, {len(worst)} of {len(shared)}",
        columns=("quantity and case", "difference", f"error, {CELLS}", f"error, {ELEMENTS}",
                 "reference known to", "fineness"),
        rows=tuple(
            (
                pair.name,
                *(f"{plain(100 * part, 2)} %"
                  for part in (pair.difference, pair.cells.error, pair.elements.error)),
                f"{plain(100 * COVERAGE * pair.uncertainty, 2)} %",
                f"{pair.cells.fineness:g} cells a side, {pair.elements.fineness:g} elements per "
                "radius",
            )
            for pair in worst
        ),
        note="On the finest run of each, which are not equally fine: this says where they are "
        "apart, not which is nearer. All relative to a reference that neither solver made; where "
        "the errors differ by less than that is known to, it cannot tell. A number behind “at” is "
        "the load over its limit, µW or the largest torque.",
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
    words = _word(one) == _word(other)
    return same and words and one.unit == other.unit and one.unit != ""


def _word(verdict: Verdict) -> str:
    """The quantity, whatever decides its tolerance and whatever body it is of."""
    return verdict.name.removeprefix(REQUIRED).split("_of_")[0]


def _key(one: Measured) -> str:
    return f"{one.case} {_word(one.verdict)} {one.verdict.reference:.9g}"


def _fineness(pair: SharedReference) -> tuple[float, float, int]:
    """Of both, and by how many of them the value was followed on coarser runs."""
    both = pair.cells, pair.elements
    followed = sum(one.verdict.refined is not None for one in both)
    return pair.cells.fineness, pair.elements.fineness, followed
