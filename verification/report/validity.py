"""Table of validity of a verification report: tested ranges of parameters, with largest errors."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass

from verification.exhibits.chart import NONE, Table, plain
from verification.judging.outcome import CaseOutcome, Verdict, clearance_text, error_text
from verification.judging.tested_parameters import (
    FRICTION,
    LAYER_MODULUS,
    LAYER_THICKNESS,
    POISSON_RATIO,
    TANGENTIAL_FORCE,
)
from verification.report.summary_text import OUTSIDE
from verification.running.report_record import Report

# Largest values of the intervals into which a parameter is divided; the last interval has no end.
INTERVALS = {
    LAYER_THICKNESS: (0.1, 1.0),  # below 0.1 the substrate carries, above 1 the layer
    LAYER_MODULUS: (1.0, 10.0),  # softer than the substrate, stiffer, and far stiffer
    POISSON_RATIO: (0.25, 0.4),  # above 0.4 nearly incompressible
    FRICTION: (0.1, 0.5),
    TANGENTIAL_FORCE: (0.5, 0.9),  # above 0.9 near to gross slip
}
NO_ERROR = "–"
NO_REFERENCE = "no reference from outside"


@dataclass(frozen=True)
class Tested:
    """One number that a case judges, at one value of a parameter.

    value    value of the parameter in a run of the verdict
    case     case of the verdict
    verdict  judged number
    """

    value: float
    case: CaseOutcome
    verdict: Verdict

    @property
    def error_rank(self) -> float:
        """Error relative to its scale, in three digits, so that round-off does not choose between
        equal errors; -1 unless the reference is from outside of the program."""
        outside = self.verdict.reference_kind in OUTSIDE and self.verdict.error is not None
        return float(f"{self.verdict.error or 0.0:.3g}") if outside else -1.0

    @property
    def name(self) -> str:
        """Names of the case and of the quantity."""
        return f"{self.case.name}/{self.verdict.name}"


def validity_table(report: Report) -> Table:
    """Build the table of the tested ranges of dimensionless parameters and of the largest errors.

    Each parameter is divided into `INTERVALS`; an interval without a judged number has no row. The
    table has no rows if the record is older than the parameters, or if no run is judged.
    """
    rows = [
        _row(name, tested)
        for name, ends in INTERVALS.items()
        for tested in _by_interval(list(_tested_numbers(report, name)), ends)
    ]
    return Table(
        title="Tested ranges of parameters, with the largest errors",
        columns=("parameter", "tested", "cases", "largest error", "of", "share of tolerance", "by"),
        rows=tuple(rows),
        note="h/a: thickness of a layer over the largest contact radius. E1/E2: Young's modulus of "
        "a layer over that of its substrate. T/(µW): largest tangential force over the friction "
        "limit. A number counts at every parameter of its runs. Errors are relative to the scale "
        "of their number, and are those of references from outside the program. Runs without edge "
        "correction, which orders of convergence need, are left out.",
        units=NONE,
    )


def _row(parameter: str, tested: list[Tested]) -> tuple[str, ...]:
    worst = max(tested, key=lambda one: one.error_rank)
    nearest = max(tested, key=lambda one: one.verdict.clearance or 0.0)
    known = worst.error_rank >= 0
    return (
        parameter,
        _range_text([one.value for one in tested]),
        str(len({one.case.name for one in tested})),
        error_text(worst.verdict) if known else NO_ERROR,
        worst.name if known else NO_REFERENCE,
        clearance_text(nearest.verdict),
        nearest.name,
    )


def _tested_numbers(report: Report, name: str) -> Iterator[Tested]:
    """Yield the judged numbers of all runs that have a parameter, once for each of its values."""
    for case in report.cases:
        values = {run.label: run.parameters.get(name, ()) for run in case.runs}
        for verdict in case.verdicts:
            if verdict.tolerance_kind != "order" and verdict.clearance is not None:
                found = {value for label in verdict.runs for value in values[label]}
                yield from (Tested(value, case, verdict) for value in sorted(found))


def _by_interval(tested: list[Tested], ends: tuple[float, ...]) -> Iterator[list[Tested]]:
    for interval in range(len(ends) + 1):
        inside = [one for one in tested if bisect_left(ends, one.value) == interval]
        if inside:
            yield inside


def _range_text(values: list[float]) -> str:
    low, high = plain(min(values)), plain(max(values))
    return low if low == high else f"{low} to {high}"
