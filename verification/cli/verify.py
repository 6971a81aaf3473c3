"""`slipstick verify`: measure the accuracy and write the report."""

from __future__ import annotations

import time
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from verification.cli.errors import ExitCode

if TYPE_CHECKING:
    from verification.cases.case import Case
    from verification.cases.outcome import CaseOutcome
    from verification.report.record import Report


class LevelName(StrEnum):
    """How much is computed."""

    QUICK = "quick"
    STANDARD = "standard"
    FULL = "full"


def verify(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[CASE]...", help="Cases to run; none means all."),
    ] = None,
    level: Annotated[
        LevelName, typer.Option("--level", help="How fine: quick takes less than a minute.")
    ] = LevelName.QUICK,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="DIR",
            show_default=False,
            help="Where the report goes; reports/LEVEL if absent, with -selection for some cases.",
        ),
    ] = None,
    list_cases: Annotated[
        bool, typer.Option("--list", help="List the cases of the level and stop.")
    ] = False,
) -> None:
    """Measure the accuracy against closed forms and write the report.

    Exit code 0 if nothing failed, 1 if a verdict failed. DIR receives index.html (the report, to
    be opened in a browser), report.json, junit.xml and summary.md.
    """  # fmt: skip
    from verification.cases.case import Level
    from verification.cases.catalogue import catalogue, choose

    chosen = Level[level.name]
    try:
        cases = choose(chosen, names or ())
    except KeyError as unknown:
        known = ", ".join(catalogue(chosen))
        raise typer.BadParameter(f"no case is called {unknown}; there are {known}") from None
    if list_cases:
        _print_list(cases)
        return
    directory = output or Path("reports") / (f"{level}-selection" if names else level)
    report = _verified(cases, level, names or [], directory)
    _print_outcome(report, directory)
    if report.failures:
        raise typer.Exit(ExitCode.ACCURACY)


def _verified(
    cases: tuple[Case, ...], level: LevelName, names: list[str], directory: Path
) -> Report:
    from verification.benchmarks import benchmarks
    from verification.report.files import refuse_if_unwritable, write_report
    from verification.report.omissions import OMISSIONS
    from verification.report.provenance import provenance
    from verification.report.record import Report, count
    from verification.run_output.stop_signals import cleaned_up_when_stopped

    with cleaned_up_when_stopped():
        refuse_if_unwritable(directory)
        outcomes, seconds = _judged(cases)
        command = " ".join(["slipstick verify", *names, f"--level {level}"])
        report = Report(
            level=level,
            counts=count(outcomes),
            cases=outcomes,
            omissions=OMISSIONS,
            provenance=provenance(command, seconds, () if names else benchmarks()),
        )
        write_report(report, directory)
    return report


def _judged(cases: tuple[Case, ...]) -> tuple[tuple[CaseOutcome, ...], dict[str, float]]:
    from verification.cases.judgement import judge, solve_run
    from verification.cli.verify_progress import verify_progress

    outcomes: list[CaseOutcome] = []
    seconds: dict[str, float] = {}
    with verify_progress(sum(len(case.runs) for case in cases)) as progress:
        for case in cases:
            started = time.perf_counter()
            outcomes.append(judge(case, progress.watching(case, solve_run)))
            seconds[case.name] = time.perf_counter() - started
            progress.finished(outcomes[-1], seconds[case.name])
    return tuple(outcomes), seconds


def _print_list(cases: tuple[Case, ...]) -> None:
    from verification.cli.terminal import print_table

    rows = ((case.name, str(len(case.runs)), case.title) for case in cases)
    print_table(("case", "solves", "title"), rows)


def _print_outcome(report: Report, directory: Path) -> None:
    from verification.report.files import PAGE
    from verification.report.page import SYMBOLS, WORDS
    from verification.report.summary_text import counts_text, failure_lines

    for line in failure_lines(report):
        typer.echo(line)
    typer.echo(f"{SYMBOLS[report.status]} {WORDS[report.status]}: {counts_text(report)}")
    typer.echo(f"report: {directory / PAGE}")
