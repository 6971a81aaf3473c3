"""Command `slipstick maintain study`: compute a study and write its page."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from contact_results.directory.run_lock import in_sole_use
from slipstick.cli.errors import ExitCode
from slipstick.cli.options import (
    LevelName,
    SchedulerOption,
    SetOption,
    directory,
    optional,
    refuse_unknown,
    workers_at,
)
from slipstick.cli.progress import outcome_text, run_with_progress
from slipstick.cli.terminal import print_table
from slipstick.solvers.names import SolverName
from verification.judging.case import Level
from verification.judging.outcome import SYMBOLS, WORDS
from verification.report.files import CASES, PAGE, refuse_if_unwritable, set_aside, write_study
from verification.running.case_pool import CaseStore, Workers
from verification.running.provenance import provenance
from verification.running.study import CaseRecord, Settings, Study, StudyRecord, row_files
from verification.studies.catalogue import SCENE_STUDIES, STUDIES
from verification.studies.refinement import CELLS, METHODS, CannotRefine

LEAST_CELLS = 16
LEAST_LEVELS, MAX_LEVELS = 4, 10


def study(
    name: Annotated[
        str | None,
        typer.Argument(metavar="NAME", help="Name of the study; --list prints all names."),
    ] = None,
    scene: Annotated[
        Path | None,
        typer.Argument(
            metavar="SCENE",
            show_default=False,
            help="Scene file (TOML), for refinement studies.",
        ),
    ] = None,
    overrides: SetOption = None,
    step: Annotated[
        int | None,
        optional(
            metavar="N",
            min=1,
            help="Load step of SCENE at whose end quantities are read. Default: the last.",
        ),
    ] = None,
    solver: Annotated[
        SolverName | None,
        optional(
            "--solver",
            metavar="NAME",
            help="Solver of SCENE: 'semi-analytical', or finite elements, 'fem' with a penalty and "
            "'fem-complementarity' without one. Default: 'semi-analytical'.",
        ),
    ] = None,
    levels: Annotated[
        int | None,
        optional(
            metavar="N",
            min=LEAST_LEVELS,
            max=MAX_LEVELS,
            help="Levels of refinement of SCENE. Default: 5 to 7 by --level.",
        ),
    ] = None,
    output: Annotated[
        Path | None, directory("Directory of the results. Default: out/study-NAME-LEVEL.")
    ] = None,
    cells: Annotated[
        int | None,
        optional(
            metavar="N",
            min=LEAST_CELLS,
            help="Even number of cells along each side of the finest grid, or elements of the "
            "finest mesh per contact radius. Default: from scene and level.",
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
        rows = [(known.name, known.title) for known in STUDIES.values()]
        rows += [(f"{known} SCENE", title) for known, (title, _) in SCENE_STUDIES.items()]
        print_table(("study", "title"), rows)
        return
    known = [*STUDIES, *SCENE_STUDIES]
    if name is None:
        raise typer.BadParameter(f"name a study; there are {', '.join(known)}")
    refuse_unknown("study", [name], known, "slipstick maintain study --list")
    if (scene is None) == (name in SCENE_STUDIES):
        problem = "needs a scene file" if scene is None else "takes no scene file"
        raise typer.BadParameter(f"study {name} {problem}")
    settings = Settings(Level[level.name], cells, levels)
    of_scene = {"--step": step, "--levels": levels, "--solver": solver, "--set": overrides}
    if scene is None:
        for option, value in of_scene.items():
            if value is not None:
                raise typer.BadParameter(
                    f"{option} needs a scene, and study {name} takes none; omit the option"
                )
        _refuse_odd(cells)
        chosen, where = STUDIES[name], f"study-{name}-{level}"
    else:
        chosen = _scene_study(name, scene, overrides or [], step, solver, settings)
        by = "" if solver is None else f"-{solver}"
        where = f"study-{name}-{scene.stem}{by}-{level}"
    words = ["slipstick", "maintain", "study", name, *([] if scene is None else [str(scene)])]
    options: dict[str, Sequence[object]] = {"--level": [level], "--set": overrides or ()}
    options |= {"--solver": [solver], "--cells": [cells], "--step": [step], "--levels": [levels]}
    for option, values in options.items():
        words += [word for v in values if v is not None for word in (option, str(v))]
    directory = output or Path("out") / where
    pool = workers_at(scheduler, workers)
    record = _compute_study(chosen, settings, shlex.join(words), directory, pool)
    for lost in record.lost:
        typer.echo(f"LOST {lost.name}: {lost.reason}")
    for statement in record.conclusion.statements:
        outcome = statement.outcome
        judged = "· finding" if outcome is None else f"{SYMBOLS[outcome]} {WORDS[outcome]}"
        typer.echo(f"{judged}: {statement.claim}: {statement.measured}")
    typer.echo(f"study: {directory / PAGE}")
    if record.status == "fail":
        raise typer.Exit(ExitCode.ACCURACY)


def _compute_study(
    study: Study, settings: Settings, command: str, directory: Path, workers: int | Workers
) -> StudyRecord:
    """Compute the cases of a verification study, draw its conclusions, and write its page.

    Returns the record of the study.

    command    command line of the study, for the record
    directory  output directory
    workers    number of processes, or workers of a cluster
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
            own_cells=settings.cells is not None,
            provenance=provenance(command, seconds, modules=(study.cases.__module__,)),
        )
        write_study(record, row_files(records, record.conclusion.rows), directory)
    return record


def _refuse_odd(cells: int | None) -> None:
    """Raise BadParameter for an odd number of cells, because half the number is used as well."""
    if cells is not None and cells % 2:
        raise typer.BadParameter(
            f"got --cells {cells}, expected an even number; half of the cells are used as well"
        )


def _scene_study(
    name: str,
    scene: Path,
    overrides: list[str],
    step: int | None,
    solver: SolverName | None,
    settings: Settings,
) -> Study:
    """Return the refinement study of a scene file.

    Raises BadParameter if the options do not fit the study, or if the scene cannot be refined.
    """
    chosen = CELLS if solver is None else solver.value
    if chosen not in (CELLS, *METHODS):
        able = " or ".join((CELLS, *METHODS))
        raise typer.BadParameter(f"got --solver {solver}, expected {able} for study {name}")
    if chosen == CELLS:
        _refuse_odd(settings.cells)
    try:
        _, study_of = SCENE_STUDIES[name]
        study = study_of(scene, overrides, step, chosen)
        study.cases(settings)
    except CannotRefine as error:
        raise typer.BadParameter(str(error)) from None
    return study
