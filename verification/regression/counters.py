"""What solves cost against what they cost when they were recorded."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from statistics import median
from typing import TYPE_CHECKING

from verification.judging.change import ChangeKind, CounterChange, Slowdown
from verification.regression.baseline import COUNTERS
from verification.regression.number_change import SAME_COUNT

if TYPE_CHECKING:
    from verification.judging.outcome import CaseOutcome
    from verification.regression.baseline import Recording
    from verification.running.report_record import Report
    from verification.solver import Solver

# Seconds of single cases scatter by a third on a busy machine; their median less.
SLOWER = 1.5
FEWEST = 3  # cases
LEAST_LOOPS = 20.0  # of a case whose time means something


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


def slowdowns(report: Report, baselines: Mapping[str, Recording]) -> Iterator[Slowdown]:
    """By solver, the median over the cases that it solves alone of their CPU time over what was
    recorded, both in calibration loops, where it has grown beyond what a busy machine explains.
    Cases of other solves than were recorded are left out.

    baselines  of the report's level, by case
    """
    ratios: dict[Solver, list[float]] = {}
    for case in report.cases:
        now, recorded = report.provenance.loops.get(case.name), baselines.get(case.name)
        solvers = {run.solver for run in case.runs}
        if now is None or recorded is None or not recorded.loops or len(solvers) != 1:
            continue
        if {run.label for run in case.runs} != {run.label for run in recorded.runs}:
            continue
        if max(now, recorded.loops) >= LEAST_LOOPS:
            ratios.setdefault(solvers.pop(), []).append(now / recorded.loops)
    for solver, found in ratios.items():
        if len(found) >= FEWEST and median(found) > SLOWER:
            yield Slowdown(solver=solver, ratio=median(found), cases=len(found))
