"""Deterministic counts of a solve against the recorded ones."""

from __future__ import annotations

from typing import TYPE_CHECKING

from verification.judging.change import ChangeKind, CounterChange, Origin
from verification.regression.baseline import COUNTERS

if TYPE_CHECKING:
    from verification.judging.outcome import RunRecord
    from verification.regression.baseline import RecordedRun

RATIO_ELSEWHERE = 1.25  # of two counts of the same solve on different processors


def counter_changes(
    run: RunRecord, was: RecordedRun | None, origin: Origin
) -> tuple[CounterChange, ...]:
    """The counts that differ from the recorded ones; a run that is new has none to compare with."""
    if was is None:
        return ()
    pairs = [(name, getattr(run, name), getattr(was, name)) for name in COUNTERS]
    return tuple(_change(*pair, origin) for pair in pairs if pair[1] != pair[2])


def _change(name: str, now: int, was: int, origin: Origin) -> CounterChange:
    ratio = now / was if was else float("inf")
    near = 1 / RATIO_ELSEWHERE <= ratio <= RATIO_ELSEWHERE
    kind = ChangeKind.NOT_JUDGED if origin.differs and near else ChangeKind.DRIFT
    remark = f"{ratio:.3g} times" if was else ""
    return CounterChange(name=name, kind=kind, was=was, remark=remark)
