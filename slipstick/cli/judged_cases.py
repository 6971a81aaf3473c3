"""All cases of a verification, judged by worker processes or taken from what they left before."""

from __future__ import annotations

from pathlib import Path

from slipstick.cli.kept_cases import told_when_stopped
from slipstick.cli.verify_progress import verify_progress
from verification.cases.judged_case import CaseToJudge, JudgedCase, lost
from verification.judging.case import Case
from verification.judging.outcome import CaseOutcome
from verification.report.files import refuse_if_unwritable
from verification.running.case_pool import Workers, run_cases
from verification.running.case_store import CaseStore

CASES = "cases"  # of the report's directory: the records of finished cases


def judged(
    cases: tuple[Case, ...], level: str, directory: Path, workers: int | Workers, *, fresh: bool
) -> tuple[tuple[CaseOutcome, ...], dict[str, float], dict[str, float]]:
    """The outcomes in the order of the cases, and of those that have a record the wall seconds and
    the calibration loops.

    level      by name, in capitals
    directory  of the report
    workers    processes of this machine at a time, or others
    fresh      take nothing from earlier runs

    Raises OutputRefused, before any work, where nothing can be written.
    """
    asked = [CaseToJudge(case.name, level) for case in cases]
    refuse_if_unwritable(directory / CASES)
    store = CaseStore(directory / CASES, JudgedCase)
    with (
        verify_progress({case.name: len(case.runs) for case in cases}) as observe,
        told_when_stopped(asked, store, fresh=fresh),
    ):
        ends = run_cases(asked, store, workers, observe, fresh=fresh)
    outcomes: list[CaseOutcome] = []
    seconds: dict[str, float] = {}
    loops: dict[str, float] = {}
    for case, end in zip(cases, ends, strict=True):
        if isinstance(end.record, JudgedCase):
            outcomes.append(end.record.outcome)
            seconds[case.name], loops[case.name] = end.record.seconds, end.record.loops
        else:
            outcomes.append(lost(case, end.lost.reason if end.lost else "it has no record"))
    return tuple(outcomes), seconds, loops
