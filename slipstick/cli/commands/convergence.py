"""Command `slipstick convergence`: refine a scene, and state the errors of its setting."""

import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from contact_results.solvers import SolverName
from contact_scene import read_scene_file
from slipstick.cli.commands.study import compute_study, option_words, print_statements
from slipstick.cli.errors import ExitCode
from slipstick.cli.options import (
    SceneArgument,
    SetOption,
    SolverOption,
    directory,
    optional,
    print_input_warnings,
)
from slipstick.cli.terminal import print_table
from slipstick.convergence.levels import FEWEST_LEVELS, StudiedScene
from slipstick.convergence.study import scene_study
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.report.file_names import PAGE
from verification.running.study import Settings

MAX_LEVELS = 10
MOST_SECONDS = 60.0
PICTURE = "work.png"
SETTINGS = Settings(Level.QUICK)  # the scene determines the levels


def convergence(
    scene: SceneArgument,
    output: Annotated[
        Path | None, directory("Directory of the results. Default: out/convergence-SCENE-SOLVER.")
    ] = None,
    overrides: SetOption = None,
    solver: SolverOption = SolverName.SEMI_ANALYTICAL,
    require: Annotated[
        str | None,
        optional(
            "--require",
            metavar="SHARES",
            help='Largest errors of the setting of the scene: "0.1%", or by name: '
            '"approach 0.01%, peak_pressure 1%". Default: the table [accuracy] of the scene.',
        ),
    ] = None,
    levels: Annotated[
        int | None,
        optional(
            "--levels",
            metavar="N",
            min=FEWEST_LEVELS,
            max=MAX_LEVELS,
            help="Levels of each parameter. Default: 4 to 6.",
        ),
    ] = None,
    step: Annotated[
        int | None,
        optional(
            "--step",
            metavar="N",
            min=1,
            help="Load step at whose end numbers are compared. Default: the last.",
        ),
    ] = None,
    most_seconds: Annotated[
        float,
        typer.Option(
            "--most-seconds",
            metavar="S",
            min=0,
            help="Time to find the setting that --accuracy would choose.",
        ),
    ] = MOST_SECONDS,
    workers: Annotated[
        int, typer.Option("--workers", metavar="N", min=1, help="Processes at a time.")
    ] = 2,
) -> None:
    """Refine a scene, and print limit, convergence order and error of every number.

    Mesh, increments and, of finite elements, overlap, section and harmonics are refined in turn,
    from coarser than the scene to finer. DIR receives index.html, work.png (error over CPU time),
    study.json and tables. Finished levels are stored in DIR/cases: after the command was killed,
    the same command computes the missing ones.

    Exit code 1 if the setting of the scene does not meet --require, and 6 if the levels cannot
    decide it or the solver refuses a level.
    """
    contents = read_scene_file(scene, overrides or ())
    print_input_warnings(contents)
    steps = len(contents.loading)
    if step is not None and step > steps:
        raise typer.BadParameter(f"step {step} was asked for, and the scene has {steps}")
    studied = StudiedScene(contents, step or steps, solver.value)
    study = scene_study(studied, levels, require, most_seconds)
    words = ["slipstick", "convergence", str(scene), "--solver", solver.value]
    options: dict[str, Sequence[object]] = {"--set": overrides or (), "--require": [require]}
    options |= {"--levels": [levels], "--step": [step]}
    target = output or Path("out") / f"convergence-{scene.stem}-{solver.value}"
    command = shlex.join([*words, *option_words(options)])
    record = compute_study(study, SETTINGS, command, target, workers, picture=PICTURE)
    limits, orders, _ = record.conclusion.tables
    print_table(limits.columns, limits.rows, numbers=True)
    print_table(orders.columns[:-1], [row[:-1] for row in orders.rows], numbers=True)
    print_statements(record.conclusion.statements)
    typer.echo(f"picture: {target / PICTURE}")
    typer.echo(f"page: {target / PAGE}")
    if record.status is Status.FAIL:
        raise typer.Exit(ExitCode.ACCURACY)
    if record.status is Status.INCONCLUSIVE:
        raise typer.Exit(ExitCode.INCONCLUSIVE)
