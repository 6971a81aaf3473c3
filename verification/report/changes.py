"""Changes of verification results since the recorded baseline, for pages, summary and log of a
report.

The baseline contains the accepted results of an earlier version of the program.
"""

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
    """Difference between a result of a verification report and its recorded baseline, as texts of a
    table.

    case      name of the verification case
    name      name of the quantity
    run       name of the run of the case
    kind      kind of the change, such as worse, better or new
    was, now  recorded and present value
    moved     size of the change in words
    since     name of the origin (commit) of the recorded value
    remark    explanation of the change
    size      size of the change, in tolerances or as fraction of a count, for sorting
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
        """Text of the change of a result since the recorded baseline, as one line of a log."""
        moved = "" if self.moved == "–" else f" ({self.moved})"
        remark = f"; {self.remark}" if self.remark else ""
        return (
            f"{self.kind} {self.case}/{self.name} [{self.run}]: {self.now}, was {self.was} "
            f"at {self.since}{moved}{remark}"
        )


def change_rows(report: Report) -> list[ChangeRow]:
    """Return the changes of results since the recorded baseline that matter to a reader of the
    report.

    The changes are sorted by severity of their kind, then by size.
    """
    rows = [row for row in _all_rows(report) if row.kind.matters]
    return sorted(rows, key=lambda row: (RANK[row.kind], -row.size))


def moved_rows(report: Report) -> list[ChangeRow]:
    """Return the changes since the baseline that matter to a reader, without results that are new.

    New results have no recorded value to compare with.
    """
    return [row for row in change_rows(report) if row.kind is not ChangeKind.NEW]


def worse_rows(report: Report) -> list[ChangeRow]:
    """Return the results that are worse than in the recorded baseline, for instance in error or
    cost."""
    return [row for row in change_rows(report) if row.kind.regresses]


def _all_rows(report: Report) -> Iterator[ChangeRow]:
    """Yield all changes of a report since the recorded baseline, including new and removed cases.

    New cases are left out if no case has recorded results, because the report states that
    separately.
    """
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
    """Yield the changes of the numbers and counts of one verification case since its recorded
    baseline.

    Recorded numbers that the case now lacks are included.
    """
    if case.baseline is None:
        return
    numbers: tuple[Verdict | FindingRecord, ...] = (*case.verdicts, *case.findings)
    for number in numbers:
        change = number.regression
        if change is not None:
            now = value_text(number.value, number.unit, DIGITS)
            yield _change_row(
                case.name, number.name, number.run, now, number.unit, change, case.baseline
            )
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
    """Count the changes of a report since the recorded baseline by kind (worse, better, new, …)."""
    found = Counter(row.kind for row in _all_rows(report))
    return {kind: found[kind] for kind in ChangeKind if found[kind]}


def without_baseline(report: Report) -> list[str]:
    """Return the names of the cases of a report that have no recorded results at the level of the
    report."""
    return [case.name for case in report.cases if case.baseline is None]


def origins(report: Report) -> list[tuple[Origin, list[str]]]:
    """Return the origins (commit and date) of the recorded baselines, with the names of their
    cases.

    The origin with the most cases comes first.
    """
    found: dict[Origin, list[str]] = {}
    for case in report.cases:
        if case.baseline is not None:
            found.setdefault(case.baseline, []).append(case.name)
    return sorted(found.items(), key=lambda item: -len(item[1]))


def changes_text(report: Report) -> str:
    """Summarise the changes of a report since the recorded baseline in one line of text."""
    absent = without_baseline(report)
    parts = [", ".join(f"{number} {kind}" for kind, number in change_counts(report).items())]
    if report.cases and len(absent) == len(report.cases):
        parts.append(f"no baseline yet of level {report.level}")
    elif absent:
        parts.append(f"no baseline yet of {', '.join(absent)}")
    if report.chosen:
        parts.append("chosen cases alone, nothing is said about the others")
    return "; ".join(part for part in parts if part)


def _change_row(
    case: str, name: str, run: str, now: str, unit: str, change: Change, origin: Origin
) -> ChangeRow:
    was = value_text(change.was, unit, DIGITS) if change.recorded else "–"
    return ChangeRow(
        case, name, run, change.kind, was, now, moved_text(change), origin.name, change.remark,
        math.inf if change.moved is None else change.moved,
    )  # fmt: skip
