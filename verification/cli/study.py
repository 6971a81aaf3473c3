"""`slipstick study`: compute a study's cases and write what follows from them."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from verification.cli.errors import ExitCode

if TYPE_CHECKING:
    from verification.studies.running.record import StudyRecord
    from verification.studies.running.study import Settings, Study

LEAST_CELLS = 16


class LevelName(StrEnum):
    """How much is computed."""

    QUICK = "quick"
    STANDARD = "standard"
    FULL = "full"


def study(
    name: Annotated[
        str | None, typer.Argument(metavar="[NAME]", help="The study; --list names them.")
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="DIR",
            show_default=False,
            help="Where everything goes; out/study-NAME-LEVEL if absent.",
        ),
    ] = None,
    cells: Annotated[
        int | None,
        typer.Option(
            metavar="N",
            min=LEAST_CELLS,
            show_default=False,
            help="Cells of the finest grid along each side, even; the level decides if absent.",
        ),
    ] = None,
    level: Annotated[
        LevelName, typer.Option("--level", help="How much is computed, and how finely.")
    ] = LevelName.QUICK,
    workers: Annotated[
        int, typer.Option("--workers", metavar="N", min=1, help="Processes at a time.")
    ] = 2,
    list_studies: Annotated[
        bool, typer.Option("--list", help="List the studies and stop.")
    ] = False,
) -> None:
    """Compute the cases of a study on a pool of processes and write its page.

    Every finished case leaves a record in DIR/cases: the same command goes on where a killed one
    stopped. DIR receives index.html, study.json, figures and tables. Exit code 1 if a statement
    failed or a case was lost.
    """  # fmt: skip
    from verification.cases.case import Level
    from verification.studies.catalogue import STUDIES
    from verification.studies.running.study import Settings

    if list_studies:
        from verification.cli.terminal import print_table

        rows = ((known.name, known.title) for known in STUDIES.values())
        print_table(("study", "title"), rows)
        return
    if name not in STUDIES:
        known = ", ".join(STUDIES)
        problem = "name a study" if name is None else f"no study is called '{name}'"
        raise typer.BadParameter(f"{problem}; there are {known}")
    if cells is not None and cells % 2:
        raise typer.BadParameter(f"--cells {cells} is odd, and half of them are needed too")
    directory = output or Path("out") / f"study-{name}-{level}"
    settings = Settings(Level[level.name], cells)
    record = _studied(STUDIES[name], settings, _command(name, level, cells), directory, workers)
    _print_outcome(record, directory)
    if record.status == "fail":
        raise typer.Exit(ExitCode.ACCURACY)


def _studied(
    study: Study, settings: Settings, command: str, directory: Path, workers: int
) -> StudyRecord:
    from verification.cli.study_progress import study_progress
    from verification.report.files import refuse_if_unwritable
    from verification.report.provenance import provenance
    from verification.run_output.stop_signals import cleaned_up_when_stopped
    from verification.studies.running.case_pool import run_cases
    from verification.studies.running.case_store import CaseStore
    from verification.studies.running.files import CASES, write_study
    from verification.studies.running.record import StudyRecord

    with cleaned_up_when_stopped():
        refuse_if_unwritable(directory)
        cases = study.cases(settings)
        store = CaseStore(directory / CASES)
        with study_progress(len(cases)) as observe:
            ends = run_cases(cases, store, workers, observe)
        records = {end.case.name: end.record for end in ends if end.record is not None}
        seconds = {name: getattr(record, "seconds", 0.0) for name, record in records.items()}
        record = StudyRecord(
            name=study.name,
            title=study.title,
            question=study.question,
            level=settings.level.name.lower(),
            conclusion=study.conclude(settings, records),
            lost=tuple(end.lost for end in ends if end.lost is not None),
            provenance=provenance(command, seconds),
        )
        write_study(record, study.exports(settings, records), directory)
    return record


def _command(name: str, level: LevelName, cells: int | None) -> str:
    finest = "" if cells is None else f" --cells {cells}"
    return f"slipstick study {name} --level {level}{finest}"


def _print_outcome(record: StudyRecord, directory: Path) -> None:
    from verification.report.page import SYMBOLS, WORDS
    from verification.studies.running.files import PAGE

    for lost in record.lost:
        typer.echo(f"LOST {lost.name}: {lost.reason}")
    for statement in record.conclusion.statements:
        outcome = statement.outcome
        judged = "· finding" if outcome is None else f"{SYMBOLS[outcome]} {WORDS[outcome]}"
        typer.echo(f"{judged}: {statement.claim}: {statement.measured}")
    typer.echo(f"study: {directory / PAGE}")
