"""What the verdicts would miss: how many pass an error some times as large as it is."""

from __future__ import annotations

from collections.abc import Iterator

from verification.judging.outcome import Status, Verdict
from verification.problems.reference import ReferenceKind
from verification.regression.number_change import NOISE
from verification.running.report_record import Report

TIMES = (3.0, 10.0)
OUTSIDE = {
    ReferenceKind.CLOSED_FORM, ReferenceKind.SEMI_CLOSED, ReferenceKind.THEORY,
    ReferenceKind.EXTERNAL_CODE,
}  # fmt: skip


def power_text(report: Report) -> str:
    """In one sentence; empty where no number has a reference from outside."""
    judged = list(_judged(report))
    if not judged:
        return ""
    passing = [_share(judged, times, least=0.0) for times in TIMES]
    hidden = [_share(judged, times, least=NOISE) for times in TIMES]
    return (
        f"Of {len(judged)} numbers with a reference from outside, {passing[0]:.0%} would pass "
        f"with an error three times as large and {passing[1]:.0%} with ten times; "
        f"{hidden[0]:.0%} and "
        f"{hidden[1]:.0%} without that the comparison with baselines tells it as worse"
    )


def _judged(report: Report) -> Iterator[tuple[float, float]]:
    """Error and what is allowed, over the scale."""
    for case in report.cases:
        for verdict in case.verdicts:
            if _counts(verdict) and verdict.error is not None:
                yield abs(verdict.error), verdict.allowed


def _counts(verdict: Verdict) -> bool:
    passed = verdict.status is Status.PASS and verdict.tolerance_kind != "order"
    return passed and verdict.reference_kind in OUTSIDE


def _share(judged: list[tuple[float, float]], times: float, least: float) -> float:
    """That passes with such errors, of those that grow by less than `least` if it is not zero."""
    missed = [
        times * error <= allowed and (not least or (times - 1) * error < least)
        for error, allowed in judged
    ]
    return sum(missed) / len(judged)
