"""Comparison of the numbers of a report with the recorded numbers of its baselines.

A number has changed if it moved by more than noise, and is worse if its error has grown by half.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from verification.judging.outcome import (
    FOUND_IN_A_RUN,
    Change,
    ChangeKind,
    CounterChange,
    Gone,
    GoneCase,
    Origin,
    Status,
    Verdict,
    commit_text,
)
from verification.problems.problem import ROUNDING
from verification.regression.baseline import (
    COUNTERS,
    Baseline,
    BaselineRefused,
    Judged,
    Key,
    RecordedBy,
    RecordedQuantity,
    Recording,
    key_of,
    recorded_by,
)

if TYPE_CHECKING:
    from verification.judging.outcome import CaseOutcome
    from verification.running.report_record import Report


SAME_DIGITS = 1e-8  # relative difference of equal references
# Processors and versions end solves at other iterates within their tolerance (1e-8), and what is
# measured on them may differ by somewhat more. Less than that is no change on any machine.
NOISE = 1e-6  # relative to the error scale
NOISE_OF_TOLERANCE = 0.01
SAME_COUNT = 0.05  # relative; solves may end an iteration earlier or later
TOLERANCE_KEPT = 0.01  # relative; derived tolerances follow the last digits of small differences

# Worse: an error that has become this many times larger, by more than the noise of machines: what
# is far inside a wide tolerance has no other guard.
WORSE_BY = 1.5
# The residual below the tolerance does not measure the accuracy of a result.
ENDS_OF_SOLVES = FOUND_IN_A_RUN

# Suspiciously better: an error that has become this many times smaller, by at least that part of
# the tolerance.
BETTER_BY = 2.0
BETTER_BY_PART = 0.05


def quantity_change(verdict: Judged, was: RecordedQuantity | None, origin: Origin) -> Change:
    """Classify the change of a judged quantity since its recorded value as worse, better, new or
    other.

    verdict  present value, reference and tolerance
    was      recorded quantity; None if none is recorded
    origin   commit and date of the recording
    """
    if was is None:
        failed = verdict.status is Status.FAIL
        kind = ChangeKind.OUTSIDE if failed else ChangeKind.NEW
        return Change(kind=kind, recorded=False, since=origin.name)
    allowed = min(verdict.most_allowed, was.allowed)
    difference = _difference(verdict.value, was.value)
    moved = difference / allowed if allowed > 0 else math.inf
    return Change(
        kind=_kind(verdict, was, difference, allowed),
        was=was.value,
        moved=moved if math.isfinite(moved) else None,
        since=origin.name,
        remark="; ".join(_remarks(verdict, was)),
    )


def _kind(verdict: Judged, was: RecordedQuantity, difference: float, allowed: float) -> ChangeKind:
    if verdict.status is Status.FAIL and was.status is not Status.FAIL:
        return ChangeKind.OUTSIDE
    if was.status is Status.FAIL and verdict.status is not Status.FAIL:
        return ChangeKind.BETTER
    if difference > allowed and _is_farther(verdict, was):
        return ChangeKind.OUTSIDE
    # This test comes before those of tolerances, because derived tolerances grow with the error.
    ends = verdict.name in ENDS_OF_SOLVES
    now = verdict.model_copy(update={"reference": was.reference})
    if (was.covered and not verdict.covered) or _is_judged_less(verdict, was):
        return ChangeKind.WORSE
    if not ends and grows(was, now, WORSE_BY, NOISE * verdict.scale):
        return ChangeKind.WORSE
    if any(_remarks(verdict, was)):
        return ChangeKind.DRIFT
    if ends:
        return ChangeKind.UNCHANGED
    if difference <= max(NOISE * verdict.scale, NOISE_OF_TOLERANCE * allowed):
        return ChangeKind.UNCHANGED
    better = grows(verdict, was, BETTER_BY, BETTER_BY_PART * allowed)
    return ChangeKind.BETTER if better else ChangeKind.DRIFT


def _is_judged_less(verdict: Judged, was: RecordedQuantity) -> bool:
    """Return True if a recorded number is no longer judged, or with a tolerance wider by half.

    Tolerances of orders and of the worst run depend on results. Derived ones follow the noise.
    """
    lost = was.status is Status.PASS and verdict.status is Status.INCONCLUSIVE
    fixed = verdict.tolerance_kind != "order" and verdict.name not in ENDS_OF_SOLVES
    noise = NOISE * verdict.scale if verdict.tolerance_kind == "derived" else 0.0
    return lost or (fixed and verdict.most_allowed > WORSE_BY * was.allowed + noise)


def _is_farther(verdict: Judged, was: RecordedQuantity) -> bool:
    """Return True if the present value is farther from its reference than the recorded value.

    A convergence order that was recorded as inconclusive, because its interval is too wide, is not
    compared. A present order with too wide an interval is compared with the recorded tolerance.

    verdict  present value with its reference
    was      recorded quantity
    """
    if was.status is Status.INCONCLUSIVE:
        return False
    if verdict.status is Status.INCONCLUSIVE and verdict.value is not None:
        return abs(verdict.value - verdict.reference) > was.allowed
    if verdict.value is None or was.value is None:
        return was.value is not None
    return abs(verdict.value - verdict.reference) > abs(was.value - was.reference)


def grows(
    small: Judged | RecordedQuantity, large: Judged | RecordedQuantity, by: float, least: float
) -> bool:
    """Return True if the error of one quantity is much smaller than that of another one.

    Used in both directions, to detect results that became worse or better. Convergence orders are
    not compared here, because they are judged by their intervals.

    small  quantity with the smaller error
    large  quantity with the larger error
    by     smallest ratio of the errors
    least  smallest difference of the errors, in the unit of the value
    """
    if small.tolerance_kind == "order" or small.value is None or large.value is None:
        return False
    error, larger = (
        abs(one.value - one.reference) for one in (small, large) if one.value is not None
    )
    return has_grown(error, larger, by, least)


def has_grown(error: float, larger: float, by: float, least: float) -> bool:
    """Return True if an error has become `by` times as large, and larger by at least `least`.

    This is the rule for all accuracy regressions: of verdicts and of stated errors.
    """
    return larger > error and larger >= by * error and larger - error >= least


def _remarks(verdict: Judged, was: RecordedQuantity) -> Iterator[str]:
    """Yield the differences between a verdict and its recorded quantity other than the value, as
    texts.

    These are a larger or missing stated error, status, tolerance, reference and unit.
    """
    stated, recorded = verdict.stated_error, was.stated_error
    if was.covered and not verdict.covered:
        yield f"stated error {'not converged' if stated is None else f'{stated:.2e}'}: not covered"
    if (
        stated is not None
        and recorded is not None
        and has_grown(recorded, stated, WORSE_BY, NOISE * verdict.scale)
    ):
        yield f"stated error {stated:.2e}, was {recorded:.2e}"
    if verdict.status is not was.status:
        lost = was.status is Status.PASS and verdict.status is Status.INCONCLUSIVE
        held = ", held to the recorded tolerance" if lost else ""
        yield f"{was.status} -> {verdict.status}{held}"
    allowed = verdict.most_allowed
    if not math.isclose(allowed, was.allowed, rel_tol=TOLERANCE_KEPT):
        yield f"tolerance {allowed:.2e}, was {was.allowed:.2e}"
    floor = ROUNDING * verdict.scale
    if not math.isclose(verdict.reference, was.reference, rel_tol=SAME_DIGITS, abs_tol=floor):
        yield f"reference was {was.reference:.9g}"
    if verdict.unit != was.unit:
        yield f"unit was {was.unit or 'none'}"


def _difference(value: float | None, was: float | None) -> float:
    """Return the absolute difference of a present and a recorded value.

    None represents a value that is not finite: two such values do not differ, one differs
    infinitely.
    """
    if value is None or was is None:
        return 0.0 if value is was else math.inf
    return abs(value - was)


def counter_changes(case: CaseOutcome | Recording, recorded: Recording) -> Iterator[CounterChange]:
    """Yield the total work counts of a case that changed by more than 5 % since the recording.

    The counts are increments, iterations, convolutions and factorizations. Only solves that exist
    in both are counted; new and removed solves are reported separately.

    case      present outcome of the case
    recorded  accepted results of the case
    """
    then = {run.label: run for run in recorded.runs}
    both = [(run, then[run.label]) for run in case.runs if run.label in then]
    for name in COUNTERS:
        now, was = (sum(getattr(pair[i], name) for pair in both) for i in (0, 1))
        yield from count_change(name, now, was)


def count_change(name: str, now: int, was: int) -> Iterator[CounterChange]:
    """Yield the change of a count of work, such as "iterations", if it changed by more than 5 %."""
    if abs(now - was) > SAME_COUNT * was:
        kind = ChangeKind.DEARER if now > was else ChangeKind.DRIFT
        remark = f"{now / was:.3g} times" if was else ""
        yield CounterChange(name=name, kind=kind, was=was, now=now, remark=remark)


def compared(report: Report, baselines: Mapping[str, Baseline]) -> Report:
    """Compare a report with baselines, and return the report with the change of every number.

    An earlier comparison in the report is replaced. A case without a baseline at the level of the
    report has `CaseOutcome.baseline` None. Recorded cases that the report lacks are listed as gone,
    unless the report is of chosen cases.

    baselines  accepted results by name of the case
    """
    made_by = recorded_by(report.provenance, reason="")
    cases = tuple(
        _compared(case, _recording(baselines.get(case.name), report.level), made_by)
        for case in report.cases
    )
    return report.model_copy(
        update={
            "cases": cases,
            "gone": tuple(_gone_cases(report, baselines)),
        }
    )


def refuse_if_not_whole(report: Report, baselines: Mapping[str, Baseline]) -> None:
    """Raise BaselineRefused if a report of chosen cases lacks a case with recorded results.

    Called where a comparison must include all recorded cases.
    """
    missing = [name for name, _ in _missing(report, baselines)] if report.chosen else []
    if missing:
        raise BaselineRefused(
            f"the report is of chosen cases; {len(missing)} that are recorded at level "
            f"{report.level} were not run: {', '.join(missing)}; --chosen compares those that were"
        )


def _gone_cases(report: Report, baselines: Mapping[str, Baseline]) -> Iterator[GoneCase]:
    for name, recorded in () if report.chosen else _missing(report, baselines):
        since = commit_text(recorded.by.commit, changed=recorded.by.changed)
        yield GoneCase(name=name, since=since)


def _missing(report: Report, baselines: Mapping[str, Baseline]) -> Iterator[tuple[str, Recording]]:
    """Yield the cases that are recorded at the level of a report but absent from the report.

    Each item has the name of the case and its recorded results.
    """
    present = {case.name for case in report.cases}
    for name, baseline in sorted(baselines.items()):
        recorded = _recording(baseline, report.level)
        if recorded is not None and name not in present:
            yield name, recorded


def _recording(baseline: Baseline | None, level: str) -> Recording | None:
    return None if baseline is None else baseline.levels.get(level)


def _compared(case: CaseOutcome, recorded: Recording | None, made_by: RecordedBy) -> CaseOutcome:
    """Compare a case with its recording, or remove an earlier comparison if there is none."""
    origin = None
    if recorded is not None:
        origin = Origin(
            commit=recorded.by.commit,
            changed=recorded.by.changed,
            date=recorded.by.date,
            reason=recorded.by.reason,
            differs=tuple(_differences(recorded.by, made_by)),
        )
    quantities = {one.key: one for one in recorded.quantities} if recorded else {}

    def change_of(verdict: Verdict) -> Change | None:
        was = quantities.get(key_of(verdict))
        return None if origin is None else quantity_change(verdict, was, origin)

    return case.model_copy(
        update={
            "baseline": origin,
            "verdicts": tuple(
                verdict.model_copy(update={"regression": change_of(verdict)})
                for verdict in case.verdicts
            ),
            "counts": tuple(counter_changes(case, recorded)) if recorded else (),
            "gone": tuple(_gone(case, recorded)) if recorded else (),
        }
    )


def _gone(case: CaseOutcome, recorded: Recording) -> Iterator[Gone]:
    present: set[Key] = {key_of(verdict) for verdict in case.verdicts}
    for number in recorded.quantities:
        if number.key not in present:
            yield Gone(name=number.name, run=number.run, unit=number.unit, was=number.value)
    labels = {run.label for run in case.runs}
    for run in recorded.runs:
        if run.label not in labels:
            yield Gone(name="run", run=run.label, unit="", was=None)


def _differences(then: RecordedBy, now: RecordedBy) -> Iterator[str]:
    """Yield texts on differences of processor, Python and libraries between a recording and a
    report.

    These differences may explain changes of the last digits.

    then  origin of the recorded results
    now   origin of the report
    """
    facts = [("processor", then.processor, now.processor), ("Python", then.python, now.python)]
    for name in sorted(then.libraries.keys() | now.libraries.keys()):
        facts.append((name, then.libraries.get(name), now.libraries.get(name)))
    for name, was, here in facts:
        if was != here:
            yield f"{name}: {here or 'none'}, was {was or 'none'}"
