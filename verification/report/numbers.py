"""Numbers as a reader sees them."""

from __future__ import annotations

from verification.cases.change import Change, commit_text
from verification.cases.outcome import Status, Verdict
from verification.convergence import ObservedOrder
from verification.report.provenance_record import Provenance
from verification.run_output.engineering_units import engineering_unit
from verification.studies.running.record import StudyRecord

NOT_FINITE = "not finite"
ROUNDING = 1e-12
PERCENT_SHOWN_TO = 9.995


def value_text(value: float | None, unit: str, digits: int = 6) -> str:
    """A value with its unit."""
    if value is None:
        return NOT_FINITE
    if value == 0:
        return "0"
    if unit in ("", "°"):
        return plain(value, digits) + unit
    scale = engineering_unit(abs(value), unit)
    return f"{value / scale.size:#.{digits}g}".rstrip(".") + f" {scale.name}"


def plain(value: float | None, digits: int = 3) -> str:
    """A number without unit: 0.0123, 1.2e-5."""
    if value is None:
        return NOT_FINITE
    mantissa, e, exponent = f"{value:.{digits}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def clearance_text(verdict: Verdict) -> str:
    """The error as a part of what is allowed: 45 %, or a multiple if much larger."""
    part = verdict.clearance
    if part is None:
        return "–"
    if 0 < part < 0.005:
        return "< 1 %"
    return f"{100 * part:.0f} %" if part < PERCENT_SHOWN_TO else f"{part:.3g} times"


def uncertainty_text(verdict: Verdict) -> str:
    """The reference's own uncertainty relative to what errors are; empty where it is rounding."""
    part = (verdict.reference_uncertainty or 0.0) / verdict.scale
    return f"± {plain(part, 2)}, " if part > ROUNDING else ""


def order_text(verdict: Verdict) -> str:
    """An observed order with its interval; words where that is too wide for a number."""
    if verdict.value is None or verdict.interval is None:
        return NOT_FINITE
    half = verdict.interval
    if not ObservedOrder(verdict.value, half).is_legible:
        return "no order can be read"
    return f"{verdict.value:.2f} ± {f'{half:.2f}' if half >= 0.005 else plain(half, 1)}"


def moved_text(change: Change) -> str:
    """How far a number is from the recorded one, in units of what is allowed."""
    return "–" if change.moved is None else f"{plain(change.moved, 2)} U"


def failure_line(case: str, verdict: Verdict, level: str) -> str:
    """What failed, where, by how much, since when, and how to see it again."""
    word = "FAIL" if verdict.status is Status.FAIL else "MOVED"
    return (
        f"{word} {case}/{verdict.name} [{verdict.run}]: {failure_text(verdict)}; "
        f"reproduce: slipstick verify {case} --level {level}"
    )


def failure_text(verdict: Verdict) -> str:
    """The value, what was expected and allowed, and the recorded value where there is one."""
    if verdict.name == "solved":
        return verdict.meaning + _was_text(verdict)
    measured, reference = (
        value_text(value, verdict.unit) for value in (verdict.value, verdict.reference)
    )
    excess = "" if verdict.clearance is None else f" ({verdict.clearance:.2g} U)"
    return (
        f"{measured}, expected {reference} ± {_allowed_text(verdict)}{excess}{_was_text(verdict)}"
    )


def _allowed_text(verdict: Verdict) -> str:
    """What is allowed, in the unit that the value or its reference is shown in."""
    allowed, unit = verdict.allowed * verdict.scale, verdict.unit
    if unit in ("", "°"):
        return plain(allowed, 2) + unit
    largest = max(abs(verdict.reference), 0.0 if verdict.reference else abs(verdict.value or 0.0))
    scale = engineering_unit(largest or allowed, unit)
    return f"{plain(allowed / scale.size, 2)} {scale.name}"


def study_failure_line(study: StudyRecord) -> str:
    """What a study of the same sources found wrong first, and how to see it again."""
    failed = [s for s in study.conclusion.statements if s.outcome is Status.FAIL]
    found = [f"{s.claim}: {s.measured}" for s in failed]
    found += [f"{case.name} was lost: {case.reason}" for case in study.lost]
    more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
    return f"FAIL study {study.name}: {found[0]}{more}; reproduce: {study.provenance.command}"


def measured_text(study: StudyRecord, now: Provenance) -> str:
    """Where a record of other sources than the report's is from; empty for one of the same."""
    made = study.provenance
    if made.has_sources_of(now):
        return ""
    return f", measured at {commit_text(made.commit, changed=made.changed)}"


def _was_text(verdict: Verdict) -> str:
    """The recorded value and the commit it is from, where there is one."""
    change = verdict.regression
    if change is None or not change.recorded:
        return ""
    why = f" ({change.remark})" if verdict.status is Status.INCONCLUSIVE and change.remark else ""
    return f"; was {value_text(change.was, verdict.unit)} at {change.since}{why}"
