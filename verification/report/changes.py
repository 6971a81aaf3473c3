"""What is new since the baseline, as rows for every form of the report."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from verification.exhibits.chart import value_text
from verification.judging.outcome import (
    CaseOutcome,
    Change,
    ChangeKind,
    FindingRecord,
    Origin,
    Verdict,
    moved_text,
)
from verification.running.report_record import Report

DIGITS = 9  # enough to see what changed
CASE, ALL = "case", "all runs"  # in place of a quantity and its run
# The worst first.
RANK = {
    kind: rank
    for rank, kind in enumerate(
        (
            ChangeKind.OUTSIDE,
            ChangeKind.WORSE,
            ChangeKind.DEARER,
            ChangeKind.GONE,
            ChangeKind.DRIFT,
            ChangeKind.BETTER,
            ChangeKind.NEW,
        )
    )
}


@dataclass(frozen=True)
class ChangeRow:
    """Something that differs from what is recorded, in words.

    size  of the move, in tolerances or parts of a count
    """

    case: str
    name: str
    run: str
    kind: ChangeKind
    was: str
    now: str
    moved: str
    since: str
    remark: str
    size: float = 0.0

    @property
    def line(self) -> str:
        """The row as a sentence of a log."""
        moved = "" if self.moved == "–" else f" ({self.moved})"
        remark = f"; {self.remark}" if self.remark else ""
        return (
            f"{self.kind} {self.case}/{self.name} [{self.run}]: {self.now}, was {self.was} "
            f"at {self.since}{moved}{remark}"
        )


def change_rows(report: Report) -> list[ChangeRow]:
    """Every change that the baseline does not describe, the worst kind first and in it what moved
    farthest."""
    rows = [row for row in _all_rows(report) if row.kind.matters]
    return sorted(rows, key=lambda row: (RANK[row.kind], -row.size))


def moved_rows(report: Report) -> list[ChangeRow]:
    """Those that have something to compare with: what is new is counted, not listed."""
    return [row for row in change_rows(report) if row.kind is not ChangeKind.NEW]


def worse_rows(report: Report) -> list[ChangeRow]:
    """Those that are worse than recorded, or dearer."""
    return [row for row in change_rows(report) if row.kind.regresses]


def _all_rows(report: Report) -> Iterator[ChangeRow]:
    """With the cases that are new or gone; where nothing at all is recorded, that is said apart."""
    some = report.gone or len(without_baseline(report)) < len(report.cases)
    for case in report.cases:
        if case.baseline is None and some:
            verdicts = f"{len(case.verdicts)} verdicts"
            yield ChangeRow(case.name, CASE, ALL, ChangeKind.NEW, "–", verdicts, "–", "–", "")
        yield from case_rows(case)
    for gone in report.gone:
        yield ChangeRow(
            gone.name, CASE, ALL, ChangeKind.GONE, "recorded", "not in the report", "–", gone.since,
            "accept the removal with a reason",
        )  # fmt: skip


def case_rows(case: CaseOutcome) -> Iterator[ChangeRow]:
    """Every number of a case that has a recorded one, or none any more."""
    if case.baseline is None:
        return
    numbers: tuple[Verdict | FindingRecord, ...] = (*case.verdicts, *case.findings)
    for number in numbers:
        change = number.regression
        if change is not None:
            now = value_text(number.value, number.unit, DIGITS)
            yield _row(case.name, number.name, number.run, now, number.unit, change, case.baseline)
    for count in case.counts:
        yield ChangeRow(
            case.name, count.name, ALL, count.kind, str(count.was), str(count.now), "–",
            case.baseline.name, count.remark, abs(count.now / max(count.was, 1) - 1),
        )  # fmt: skip
    for gone in case.gone:
        yield ChangeRow(
            case.name, gone.name, gone.run, ChangeKind.GONE,
            "–" if gone.was is None else value_text(gone.was, gone.unit, DIGITS), "–", "–",
            case.baseline.name, "accept the removal with a reason",
        )  # fmt: skip


def change_counts(report: Report) -> dict[ChangeKind, int]:
    """How many recorded or measured numbers changed how; unchanged counts are not listed."""
    found = Counter(row.kind for row in _all_rows(report))
    return {kind: found[kind] for kind in ChangeKind if found[kind]}


def without_baseline(report: Report) -> list[str]:
    """Names of the cases that nothing is recorded of at this level."""
    return [case.name for case in report.cases if case.baseline is None]


def origins(report: Report) -> list[tuple[Origin, list[str]]]:
    """Where recorded numbers are from, with the names of their cases; the commonest first."""
    found: dict[Origin, list[str]] = {}
    for case in report.cases:
        if case.baseline is not None:
            found.setdefault(case.baseline, []).append(case.name)
    return sorted(found.items(), key=lambda item: -len(item[1]))


def changes_text(report: Report) -> str:
    """Return one line: how the report compares with what is recorded."""
    absent = without_baseline(report)
    parts = [", ".join(f"{number} {kind}" for kind, number in change_counts(report).items())]
    if report.cases and len(absent) == len(report.cases):
        parts.append(f"no baseline yet of level {report.level}")
    elif absent:
        parts.append(f"no baseline yet of {', '.join(absent)}")
    if report.chosen:
        parts.append("chosen cases alone, nothing is said about the others")
    return "; ".join(part for part in parts if part)


def _row(
    case: str, name: str, run: str, now: str, unit: str, change: Change, origin: Origin
) -> ChangeRow:
    was = value_text(change.was, unit, DIGITS) if change.recorded else "–"
    return ChangeRow(
        case, name, run, change.kind, was, now, moved_text(change), origin.name, change.remark,
        math.inf if change.moved is None else change.moved,
    )  # fmt: skip
