"""Verdicts in numbers and words."""

from __future__ import annotations

from contact_scene.reading.engineering_units import engineering_unit
from verification.convergence.observed_order import ILLEGIBLE
from verification.exhibits.numbers import NOT_FINITE, plain, value_text
from verification.judging.change import Change
from verification.judging.outcome import SOLVED, Status, Verdict

ROUNDING = 1e-12


PERCENT_SHOWN_TO = 9.995


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
    if half >= ILLEGIBLE:
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
    if verdict.name == SOLVED:
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


def _was_text(verdict: Verdict) -> str:
    """The recorded value and the commit it is from, where there is one."""
    change = verdict.regression
    if change is None or not change.recorded:
        return ""
    why = f" ({change.remark})" if verdict.status is Status.INCONCLUSIVE and change.remark else ""
    return f"; was {value_text(change.was, verdict.unit)} at {change.since}{why}"
