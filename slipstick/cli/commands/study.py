"""Command `slipstick maintain study`: compute a study and write its page."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Annotated

import typer

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
from verification.judging.case import Level
from verification.judging.outcome import SYMBOLS, WORDS
from verification.report.drawing import write_picture
from verification.report.file_names import CASES, PAGE
from verification.report.files import refuse_if_unwritable, set_aside, write_study
from verification.running.case_pool import CaseStore, Workers
from verification.running.provenance import provenance
from verification.running.study import (
    CaseRecord,
    Settings,
    Statement,
    Study,
    StudyRecord,
    row_files,
)
from verification.studies.catalogue import STUDIES

LEAST_CELLS = 16


def study(
    name: Annotated[
        str | None,
        typer.Argument(metavar="NAME", help="Name of the study; --list prints all names."),
    ] = None,
    output: Annotated[
        Path | None, directory("Directory of the results. Default: out/study-NAME-LEVEL.")
    ] = None,
    cells: Annotated[
        int | None,
        optional(
            metavar="N",
            min=LEAST_CELLS,
            help="Even number of cells along each side of the finest grid. Default: of the level.",
        ),
    ] = None,
    level: Annotated[
        LevelName, typer.Option("--level", help="Number and fineness of the cases.")
    ] = LevelName.QUICK,
    workers: Annotated[
        int, typer.Option("--workers", metavar="N", min=1, help="Processes at a time.")
    ] = 2,
    scheduler: SchedulerOption = None,
    list_studies: Annotated[
        bool, typer.Option("--list", help="List the studies and stop.")
    ] = False,
) -> None:
    """Compute the cases of a study on a pool of processes and write its page.

    Every finished case is stored in DIR/cases: after the command was killed, the same command
    computes the missing cases. DIR receives index.html, study.json, figures and tables. During the
    study, earlier versions of index.html and study.json are in DIR/earlier. Exit code 1 if a
    statement failed or a case was lost.
    """
    if list_studies:
        print_table(("study", "title"), [(known.name, known.title) for known in STUDIES.values()])
        return
    if name is None:
        raise typer.BadParameter(f"name a study; there are {', '.join(STUDIES)}")
    refuse_unknown("study", [name], STUDIES, "slipstick maintain study --list")
    if cells is not None and cells % 2:
        raise typer.BadParameter(
            f"got --cells {cells}, expected an even number; half of the cells are used as well"
        )
    options = option_words({"--level": [level], "--cells": [cells]})
    command = shlex.join(["slipstick", "maintain", "study", name, *options])
    directory = output or Path("out") / f"study-{name}-{level}"
    settings, pool = Settings(Level[level.name], cells), workers_at(scheduler, workers)
    record = compute_study(STUDIES[name], settings, command, directory, pool)
    print_statements(record.conclusion.statements)
    typer.echo(f"study: {directory / PAGE}")
    if record.status == "fail":
        raise typer.Exit(ExitCode.ACCURACY)


def option_words(options: Mapping[str, Sequence[object]]) -> list[str]:
    """Return the words of the options on a command line that have a value.

    options  values by name of the option; None for an absent option
    """
    return [
        word
        for option, of in options.items()
        for value in of
        if value is not None
        for word in (option, str(value))
    ]


def print_statements(statements: Iterable[Statement]) -> None:
    """Print the statements of a study with their outcomes, one per line."""
    for statement in statements:
        outcome = statement.outcome
        judged = "· finding" if outcome is None else f"{SYMBOLS[outcome]} {WORDS[outcome]}"
        typer.echo(f"{judged}: {statement.claim}: {statement.measured}")


def compute_study(
    study: Study,
    settings: Settings,
    command: str,
    directory: Path,
    workers: int | Workers,
    *,
    picture: str = "",
) -> StudyRecord:
    """Compute the cases of a study, draw its conclusions, write its page, and print lost cases.

    Returns the record of the study.

    command    command line of the study, for the record
    directory  output directory
    workers    number of processes, or workers of a cluster
    picture    name of an image file for the first chart; empty for none
    """
    refuse_if_unwritable(directory)
    with in_sole_use(directory):
        cases = study.cases(settings)
        set_aside(directory)
        store = CaseStore(directory / CASES)
        ends = run_with_progress(cases, store, workers, outcome_text)
        records = {end.case.name: end.record for end in ends if isinstance(end.record, CaseRecord)}
        seconds = {name: record.seconds for name, record in records.items()}
        record = StudyRecord(
            name=study.name,
            title=study.title,
            question=study.question,
            level=settings.level.name.lower(),
            conclusion=study.conclude(settings, records),
            lost=tuple(end.lost for end in ends if end.lost is not None),
            own_cells=settings.cells is not None or study.name not in STUDIES,
            provenance=provenance(command, seconds, modules=(study.cases.__module__,)),
        )
        write_study(record, row_files(records, record.conclusion.rows), directory)
        if picture:
            (directory / picture).unlink(missing_ok=True)
            for chart in record.conclusion.charts[:1]:
                write_picture(chart, directory / picture)
    for lost in record.lost:
        typer.echo(f"LOST {lost.name}: {lost.reason}")
    return record
