"""Rules by which studies judge their rows."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

from verification.exhibits.numbers import plain
from verification.judging.outcome import Status
from verification.running.row import Row
from verification.running.study import Statement

RESIDUAL = "largest_residual"  # of any increment of a case, by the name of its measure


def judged(good: bool, *, complete: bool = True) -> Status:
    """The outcome of a claim; open where cases are missing that it is about."""
    if not complete:
        return Status.INCONCLUSIVE
    return Status.PASS if good else Status.FAIL


def largest(rows: Iterable[Row], name: str) -> float:
    """The largest magnitude of a measure over the rows that have it; infinite where one is not
    finite, 0 without rows."""
    values = [row.measures[name] for row in rows if name in row.measures]
    return max((math.inf if v is None else abs(v) for v in values), default=0.0)


def total(rows: Iterable[Row], counter: str) -> int:
    """Sum of a counter over the rows."""
    return sum(row.counters.get(counter, 0) for row in rows)


def solved(claim: str, count: int, asked: int, what: str = "") -> Statement:
    """Whether all that was asked for has a record.

    what  is counted, in a word
    """
    return Statement(
        claim=claim,
        outcome=judged(count == asked),
        measured=f"{count} of {asked}{what and ' '}{what}",
        about=Row(counters={"found": count, "asked": asked}),
    )


def converged(
    rows: Sequence[Row],
    tolerance: float,
    where: str,
    *,
    claim: str = "every increment converged",
    asked: int = 0,
) -> Statement:
    """Whether every increment of all cases ended within the tolerance.

    where  in words
    asked  rows that there should be: open with fewer
    """
    worst = largest(rows, RESIDUAL)
    return Statement(
        claim=claim,
        outcome=judged(worst <= tolerance, complete=len(rows) >= asked),
        measured=f"largest residual {_text(worst)} {where}",
        because=f"allowed {tolerance:g}",
        about=_measures({RESIDUAL: worst}),
    )


def within(
    what: str, rows: Sequence[Row], allowed: Mapping[str, float], because: str, *, asked: int = 0
) -> Statement:
    """Whether measures are nowhere larger than allowed, by name; those that a row lacks are not
    asked of it.

    asked  rows that there should be: open with fewer
    """
    worst = {name: largest(rows, name) for name in allowed}
    limits = ", ".join(f"{name} ≤ {plain(most)}" for name, most in allowed.items())
    return Statement(
        claim=f"{what}: {limits}",
        outcome=judged(all(worst[n] <= allowed[n] for n in allowed), complete=len(rows) >= asked),
        measured=", ".join(f"{name} {_text(error)}" for name, error in worst.items()),
        because=because,
        about=_measures(worst),
    )


def _text(value: float) -> str:
    return plain(_finite(value), 2)


def _measures(values: Mapping[str, float]) -> Row:
    return Row(measures={name: _finite(value) for name, value in values.items()})


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
