"""Command `slipstick verify`: measure the accuracy and write a report."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from contact_results.blas_threads import is_one_thread
from contact_results.directory.run_lock import in_sole_use
from slipstick.cli.errors import ExitCode
from slipstick.cli.options import (
    LevelName,
    SchedulerOption,
    directory,
    optional,
    refuse_unknown,
    workers_at,
)
from slipstick.cli.progress import outcome_text, run_with_progress
from slipstick.cli.terminal import print_table
from verification.cases.catalogue import CASES as KNOWN
from verification.cases.catalogue import CaseToJudge, JudgedCase, choose, lost
from verification.cases.requirements import unmet
from verification.judging.case import Case, Level
from verification.judging.outcome import SYMBOLS, WORDS, CaseOutcome, ChangeKind, Status
from verification.regression.baseline import read_baselines
from verification.regression.comparison import compared
from verification.regression.tolerances import held_to, read_tolerances
from verification.report.file_names import PAGE
from verification.report.files import refuse_if_unwritable, set_aside_report, write_report
from verification.report.summary_text import (
    OMISSIONS,
    PLACES,
    change_rows,
    changes_text,
    counts_text,
    failure_lines,
    stored_records,
    uncovered_lines,
)
from verification.running.case_pool import CaseEnd, CaseStore, ThisProcess, Workers, cores
from verification.running.provenance import provenance
from verification.running.report_record import Report, count

MAX_WARNINGS = 20
MODULES = ("verification.cases", "verification.judging.judgement")
CASES = "cases"  # of the report's directory: the records of finished cases


def verify(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="CASE", help="Cases to run. Default: all."),
    ] = None,
    level: Annotated[
        LevelName, typer.Option("--level", help="Level; quick takes about 2 minutes.")
    ] = LevelName.QUICK,
    output: Annotated[
        Path | None,
        directory(
            "Directory of the report. Default: reports/LEVEL, with -selection for chosen cases."
        ),
    ] = None,
    list_cases: Annotated[
        bool, typer.Option("--list", help="List the cases of the level and stop.")
    ] = False,
    workers: Annotated[
        int | None,
        optional(
            "--workers",
            metavar="N",
            min=1,
            help="Number of cases at a time, each in its own process. Default: one per core; a "
            "single case runs in the process of the command.",
        ),
    ] = None,
    fresh: Annotated[
        bool, typer.Option("--fresh", help="Ignore stored cases of earlier runs in DIR.")
    ] = False,
    scheduler: SchedulerOption = None,
    studies: Annotated[
        Path | None,
        optional(
            "--studies",
            metavar="DIR",
            help="Folder of the studies in the report. Default: reports/studies and out.",
        ),
    ] = None,
) -> None:
    """Measure the accuracy against closed forms and write the report.

    Exit code 1 if a verdict failed, if no passing case shows a requirement, if fewer than 95 % of
    the stated errors of a full report cover the true errors, or if a study of the same sources
    failed; otherwise 0. Changes since the
    baseline are printed and are no failure; see 'slipstick maintain compare'. DIR receives
    index.html (the report), sheets.html, report.json, junit.xml and summary.md.

    Every finished case is stored in DIR/cases. After the command was killed, the same command
    computes the missing cases, and those of other sources or libraries. An earlier report is in
    DIR/earlier until the new one is complete. A case whose worker dies has failed.
    """
    chosen = Level[level.name]
    listing = f"slipstick verify --list --level {level}"
    refuse_unknown("case", names or (), KNOWN, listing)
    cases = choose(chosen, names or ())
    if list_cases:
        rows = ((case.name, str(len(case.runs)), case.title) for case in cases)
        print_table(("case", "solves", "title"), rows)
        return
    directory = output or Path("reports") / (f"{level}-selection" if names else level)
    places = None if studies is None else (studies,)
    pool = workers_at(scheduler, workers or cores())
    if len(cases) == 1 and workers is None and scheduler is None and is_one_thread():
        pool = ThisProcess()  # records depend on the number of threads
    report = _run_and_report(cases, level, names or [], directory, pool, places, fresh=fresh)
    _print_outcome(report, directory)
    if report.status is Status.FAIL:
        raise typer.Exit(ExitCode.ACCURACY)


def _run_and_report(
    cases: tuple[Case, ...],
    level: LevelName,
    names: list[str],
    directory: Path,
    workers: int | Workers,
    places: tuple[Path, ...] | None,
    *,
    fresh: bool,
) -> Report:
    """Run the cases of a verification, compare them with the baseline, and write the report.

    level      name of the level
    names      names of chosen cases; empty for all
    directory  directory of the report
    places     folders of the studies in the report; None for the default folders
    fresh      true to ignore stored cases of earlier runs
    """
    refuse_if_unwritable(directory)
    with in_sole_use(directory):
        baselines = read_baselines()  # refuse a damaged baseline before the work
        optional_places = () if names else PLACES  # a report of chosen cases has no studies
        try:
            studies = stored_records(
                *((optional_places, _warn_of_omission) if places is None else (places,))
            )
        except ValueError as error:
            typer.echo(f"error: {error}", err=True)
            raise typer.Exit(ExitCode.INVALID) from None
        set_aside_report(directory)
        outcomes, seconds = judge_cases(cases, level.name, directory, workers, fresh=fresh)
        command = " ".join(["slipstick verify", *names, f"--level {level}"])
        measured = Report(
            level=level,
            counts=count(outcomes),
            cases=outcomes,
            omissions=OMISSIONS,
            provenance=provenance(command, seconds, modules=MODULES),
            studies=studies,
            chosen=bool(names),
            unmet=() if names else unmet(cases, outcomes),
        )
        report = compared(measured, baselines)
        write_report(report, directory)
    return report


def judge_cases(
    cases: tuple[Case, ...], level: str, directory: Path, workers: int | Workers, *, fresh: bool
) -> tuple[tuple[CaseOutcome, ...], dict[str, float]]:
    """Run the cases of a verification on a pool of processes, and return their outcomes.

    Returns the outcomes in the order of the cases, and the elapsed seconds by case name. Raises
    OutputRefused, before any solve, if the directory cannot be written.

    level      name of the level in capitals
    directory  directory of the report
    workers    number of processes, or workers of a cluster
    fresh      true to ignore stored cases of earlier runs
    """
    tolerances = read_tolerances(level.lower())
    requested = [CaseToJudge(case.name, level) for case in cases]
    refuse_if_unwritable(directory / CASES)
    store = CaseStore(directory / CASES, JudgedCase)
    solves = {case.name: max(1, len(case.runs)) for case in cases}
    ends = run_with_progress(requested, store, workers, _case_line, solves, fresh=fresh)
    outcomes: list[CaseOutcome] = []
    seconds: dict[str, float] = {}
    for case, end in zip(cases, ends, strict=True):
        if isinstance(end.record, JudgedCase):
            outcomes.append(end.record.outcome)
            seconds[case.name] = end.record.seconds
        else:
            outcomes.append(lost(case, end.lost.reason if end.lost else "it has no record"))
    return held_to(outcomes, tolerances), seconds


def _case_line(end: CaseEnd) -> str:
    if not isinstance(end.record, JudgedCase):
        return outcome_text(end)
    outcome, seconds = end.record.outcome, f"{end.record.seconds:6.1f} s"
    took = "already there" if end.stored else seconds
    return (
        f"{SYMBOLS[outcome.status]} {WORDS[outcome.status]:12} {outcome.name:24} "
        f"{len(outcome.verdicts):3} verdicts, {len(outcome.runs):3} solves, {took}"
    )


def _warn_of_omission(problem: str) -> None:
    typer.echo(f"WARN {problem}: left out; use --studies for another folder", err=True)


def _print_outcome(report: Report, directory: Path) -> None:
    """Print failures, changes since the baseline, and the status of a verification report."""
    for line in failure_lines(report):
        typer.echo(line)
    for line in uncovered_lines(report)[:MAX_WARNINGS]:
        typer.echo(f"WARN {line}")
    failed = {(case.name, verdict.name, verdict.run) for case, verdict in report.failures}
    rows = [
        row
        for row in change_rows(report)
        if row.kind is not ChangeKind.OUTSIDE or (row.case, row.name, row.run) not in failed
    ]
    for row in rows[:MAX_WARNINGS]:
        typer.echo(f"WARN {row.line}")
    if len(rows) > MAX_WARNINGS:
        some = " --chosen" if report.chosen else ""
        more = f"slipstick maintain compare {directory}{some}"
        typer.echo(f"WARN and {len(rows) - MAX_WARNINGS} more: {more}")
    typer.echo(f"since the baseline: {changes_text(report)}")
    typer.echo(f"{SYMBOLS[report.status]} {WORDS[report.status]}: {counts_text(report)}")
    typer.echo(f"report: {directory / PAGE}")
