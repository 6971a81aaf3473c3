"""The verdict on one number against the recorded one."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from verification.judging.change import Change, ChangeKind, Origin
from verification.judging.outcome import Status
from verification.problems.reference import ROUNDING

if TYPE_CHECKING:
    from verification.judging.outcome import FindingRecord, Verdict
    from verification.regression.baseline import RecordedFinding, RecordedQuantity

SAME_DIGITS = 1e-8  # relative; equal bits are the rule on one processor with the same versions
# Elsewhere solves end at other iterates within their tolerance (1e-8), and what is measured on
# them may differ by somewhat more.
SAME_ELSEWHERE = 1e-6  # of what errors are divided by
PART_OF_TOLERANCE = 0.01  # no change of less than this part of the tolerance matters elsewhere
TOLERANCE_KEPT = 0.01  # relative; derived tolerances follow the last digits of small differences

# Suspiciously better: an error that has become this many times smaller, by at least that part of
# the tolerance.
BETTER_BY = 2.0
BETTER_BY_PART = 0.05


def quantity_change(verdict: Verdict, was: RecordedQuantity | None, origin: Origin) -> Change:
    """How a judged quantity compares with the recorded one."""
    if was is None:
        failed = verdict.status is Status.FAIL
        kind = ChangeKind.OUTSIDE if failed else ChangeKind.NEW
        return Change(kind=kind, recorded=False, since=origin.name)
    allowed = min(verdict.allowed * verdict.scale, was.allowed)
    difference = _difference(verdict.value, was.value)
    moved = difference / allowed if allowed > 0 else math.inf
    return Change(
        kind=_kind(verdict, was, origin, difference, allowed),
        was=was.value,
        moved=moved if math.isfinite(moved) else None,
        since=origin.name,
        remark="; ".join(_remarks(verdict, was)),
    )


def finding_change(finding: FindingRecord, was: RecordedFinding | None, origin: Origin) -> Change:
    """How a finding compares with the recorded one; elsewhere nothing says what may differ."""
    if was is None:
        return Change(kind=ChangeKind.NEW, recorded=False, since=origin.name)
    if _difference(finding.value, was.value) <= _digits(finding.value, was.value):
        kind = ChangeKind.UNCHANGED
    else:
        kind = ChangeKind.NOT_JUDGED if origin.differs else ChangeKind.DRIFT
    return Change(kind=kind, was=was.value, since=origin.name)


def _kind(
    verdict: Verdict, was: RecordedQuantity, origin: Origin, difference: float, allowed: float
) -> ChangeKind:
    if verdict.status is Status.FAIL and was.status is not Status.FAIL:
        return ChangeKind.OUTSIDE
    if was.status is Status.FAIL and verdict.status is not Status.FAIL:
        return ChangeKind.BETTER
    if difference > allowed and _is_farther(verdict, was):
        return ChangeKind.OUTSIDE
    if any(_remarks(verdict, was)):
        return ChangeKind.DRIFT
    part = PART_OF_TOLERANCE * allowed
    if difference <= max(_digits(verdict.value, was.value), min(ROUNDING * verdict.scale, part)):
        return ChangeKind.UNCHANGED
    if origin.differs and difference <= max(SAME_ELSEWHERE * verdict.scale, part):
        return ChangeKind.NOT_JUDGED
    return ChangeKind.BETTER if _is_better(verdict, was, allowed) else ChangeKind.DRIFT


def _is_farther(verdict: Verdict, was: RecordedQuantity) -> bool:
    """Whether the value has moved away from the reference; of an order that was recorded with too
    wide an interval nobody can tell. One that has become so is held to what was allowed when it
    passed: its own interval is of the levels that lost it."""
    if was.status is Status.INCONCLUSIVE:
        return False
    if verdict.status is Status.INCONCLUSIVE and verdict.value is not None:
        return abs(verdict.value - verdict.reference) > was.allowed
    if verdict.value is None or was.value is None:
        return was.value is not None
    return abs(verdict.value - verdict.reference) > abs(was.value - was.reference)


def _is_better(verdict: Verdict, was: RecordedQuantity, allowed: float) -> bool:
    """Whether the error has fallen so far that somebody should know why."""
    if verdict.tolerance_kind == "order" or verdict.value is None or was.value is None:
        return False
    error, earlier = abs(verdict.value - verdict.reference), abs(was.value - was.reference)
    return BETTER_BY * error <= earlier and earlier - error >= BETTER_BY_PART * allowed


def _remarks(verdict: Verdict, was: RecordedQuantity) -> Iterator[str]:
    """What else than the value is not as recorded."""
    if verdict.status is not was.status:
        lost = was.status is Status.PASS and verdict.status is Status.INCONCLUSIVE
        held = ", held to the recorded tolerance" if lost else ""
        yield f"{was.status} -> {verdict.status}{held}"
    allowed = verdict.allowed * verdict.scale
    if not math.isclose(allowed, was.allowed, rel_tol=TOLERANCE_KEPT):
        yield f"tolerance {allowed:.2e}, was {was.allowed:.2e}"
    floor = ROUNDING * verdict.scale
    if not math.isclose(verdict.reference, was.reference, rel_tol=SAME_DIGITS, abs_tol=floor):
        yield f"reference was {was.reference:.9g}"
    if verdict.unit != was.unit:
        yield f"unit was {was.unit or 'none'}"


def _difference(value: float | None, was: float | None) -> float:
    """Distance of two numbers, of which None is one that is not finite."""
    if value is None or was is None:
        return 0.0 if value is was else math.inf
    return abs(value - was)


def _digits(value: float | None, was: float | None) -> float:
    """The distance at which two numbers agree to the digits that are kept."""
    return SAME_DIGITS * max(abs(value or 0.0), abs(was or 0.0))
