"""What solves cost against what they cost when they were recorded."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from verification.judging.change import ChangeKind, CounterChange
from verification.regression.baseline import COUNTERS
from verification.regression.number_change import SAME_COUNT

if TYPE_CHECKING:
    from verification.judging.outcome import CaseOutcome
    from verification.regression.baseline import Recording


def counter_changes(case: CaseOutcome | Recording, recorded: Recording) -> Iterator[CounterChange]:
    """The counts of all solves together that differ from the recorded ones; solves that are new or
    gone are left out, they are told apart."""
    then = {run.label: run for run in recorded.runs}
    both = [(run, then[run.label]) for run in case.runs if run.label in then]
    for name in COUNTERS:
        now, was = (sum(getattr(pair[i], name) for pair in both) for i in (0, 1))
        if abs(now - was) > SAME_COUNT * was:
            kind = ChangeKind.DEARER if now > was else ChangeKind.DRIFT
            remark = f"{now / was:.3g} times" if was else ""
            yield CounterChange(name=name, kind=kind, was=was, now=now, remark=remark)
