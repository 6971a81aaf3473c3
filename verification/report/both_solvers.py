"""What both solvers measured against the same reference."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.numbers import percent, plain
from verification.exhibits.table import NONE, Table
from verification.judging.outcome import CaseOutcome, RunRecord, Verdict
from verification.running.report_record import Report
from verification.solver import Method, Solver

WORDS = {
    Solver.CELLS: "cells (SAM)",
    Solver.ELEMENTS: "finite elements",
    Solver.RADII: "radial",
}
SERIES = {Solver.CELLS: 0, Solver.ELEMENTS: 1}
SAME = 1e-9  # relative, of two values of one reference
LEAST = 1e-8  # an error is drawn no smaller: the axis is logarithmic
COVERAGE = 2.0  # standard uncertainties of a reference
MOST_SHOWN = 8  # where they are furthest apart
# Quantities that share a chart, and its title; all others share the last.
GROUPS = {
    "approach": ("approach",),
    "pressure": ("peak_pressure", "central_pressure"),
    "radius": ("contact_radius", "stick_radius"),
}
OTHERS = "forces"
TITLES = {group: group for group in GROUPS} | {OTHERS: "forces, shifts, twists and energies"}


@dataclass(frozen=True)
class Measured:
    """A verdict by one solver, on its finest run."""

    case: str
    run: RunRecord
    verdict: Verdict

    @property
    def error(self) -> float:
        """|value - reference| / |reference|."""
        reference = self.verdict.reference
        return abs((self.verdict.value or 0.0) - reference) / abs(reference)

    @property
    def of(self) -> tuple[str, float | None]:
        """The quantity and the load that it is measured at."""
        return self.verdict.quantity, self.verdict.at


@dataclass(frozen=True)
class SharedReference:
    """One reference, measured by both solvers."""

    cells: Measured
    elements: Measured

    def by(self, solver: Solver) -> Measured:
        """What one of them measured."""
        return self.cells if solver is Solver.CELLS else self.elements

    @property
    def quantity(self) -> str:
        """In words, with the load that it is measured at."""
        name, at = self.cells.of
        return name.replace("_", " ") + ("" if at is None else f" at {at:g}")

    @property
    def case(self) -> str:
        """That of the cells, in words."""
        return self.cells.case.replace("_", " ")

    @property
    def name(self) -> str:
        """The quantity, the case of the cells, and which of its problems."""
        return ", ".join((self.quantity, *self._place))

    @property
    def row(self) -> str:
        """The same in a chart of its kind."""
        rest = " ".join(self.quantity.replace(self.group, "").split())
        return ", ".join((*([rest] if rest else []), *self._place))

    @property
    def _place(self) -> tuple[str, ...]:
        problem = self.cells.run.problem
        return (self.case, problem) if problem else (self.case,)

    @property
    def group(self) -> str:
        """The chart that it is shown in."""
        name, _ = self.cells.of
        return next((group for group, names in GROUPS.items() if name in names), OTHERS)

    @property
    def difference(self) -> float:
        """Of both values, relative to the reference."""
        one, other = self.cells.verdict, self.elements.verdict
        return abs((one.value or 0.0) - (other.value or 0.0)) / abs(one.reference)

    @property
    def reference(self) -> tuple[str, float | None, str]:
        """Tells references apart: some are of several cases."""
        return *self.cells.of, f"{self.cells.verdict.reference:.9g}"

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
    measured = [one for case in report.cases for one in _measured(case)]
    by_elements = [one for one in measured if one.run.solver is Solver.ELEMENTS]
    found: dict[tuple[object, ...], SharedReference] = {}
    for one in measured:
        if one.run.solver is not Solver.CELLS:
            continue
        for other in by_elements:
            if _alike(one, other):
                pair = SharedReference(one, other)
                key = (one.case, *pair.reference)
                if key not in found or _fineness(pair) > _fineness(found[key]):
                    found[key] = pair
    return tuple(found.values())


def both_solvers_charts(shared: tuple[SharedReference, ...]) -> tuple[Chart, ...]:
    """Errors of both solvers, a chart per kind of quantity, a row per shared reference."""
    once: dict[object, SharedReference] = {}
    for pair in shared:
        once.setdefault(pair.reference, pair)
    return tuple(
        _chart(group, of)
        for group in TITLES
        if (of := [pair for pair in once.values() if pair.group == group])
    )


def _chart(group: str, shared: list[SharedReference]) -> Chart:
    rows = shared[::-1]
    curves = []
    for solver, series in SERIES.items():
        drawn = [max(pair.by(solver).error, LEAST) for pair in rows]
        curves.append(curve(WORDS[solver], drawn, range(len(rows)), Look.TILES, series))
    panel = Panel(
        x_label="relative error against the same reference", y_label="", curves=tuple(curves),
        logarithmic=True, y_places=tuple(pair.row for pair in rows),
        height=0.7 + 0.2 * len(rows),
    )  # fmt: skip
    return Chart(
        name=f"both_solvers_{group}",
        title=f"Errors of both solvers against the same references: {TITLES[group]}",
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
        columns=("quantity and case", "difference", *(f"error, {word}" for word in WORDS.values()),
                 "reference known to", "fineness"),
        rows=tuple(
            (
                pair.name,
                *(percent(part)
                  for part in (pair.difference, pair.cells.error, pair.elements.error)),
                percent(COVERAGE * pair.uncertainty),
                f"{pair.cells.run.fineness} cells a side, {pair.elements.run.fineness} elements "
                "per radius",
            )
            for pair in worst
        ),
        note="On the finest run of each, which are not equally fine: this says where they are "
        "apart, not which is nearer. All relative to a reference that neither solver made; where "
        "the errors differ by less than that is known to, it cannot tell. A number behind “at” is "
        "the load over its limit, µW or the largest torque.", units=NONE
    )  # fmt: skip


def _measured(case: CaseOutcome) -> Iterator[Measured]:
    """Quantities with a unit that were compared with a number; of springs there is a study."""
    runs = {run.label: run for run in case.runs}
    for verdict in case.verdicts:
        judged = verdict.error is not None and verdict.value is not None and verdict.reference != 0
        if verdict.quantity and verdict.unit and judged and verdict.tolerance_kind != "order":
            (label,) = verdict.runs
            if runs[label].method is not Method.PENALTY:
                yield Measured(case.name, runs[label], verdict)


def _alike(one: Measured, other: Measured) -> bool:
    known, again = one.verdict.reference, other.verdict.reference
    same = abs(known - again) <= SAME * abs(known)
    return same and one.of == other.of and one.verdict.unit == other.verdict.unit


def _fineness(pair: SharedReference) -> tuple[int, int, int]:
    """Of both, and by how many of them the value was followed on coarser runs."""
    both = pair.cells, pair.elements
    followed = sum(one.verdict.refined is not None for one in both)
    return pair.cells.run.fineness, pair.elements.run.fineness, followed
