"""`slipstick run`: from a scene to a directory of results."""

from contextlib import ExitStack
from typing import TYPE_CHECKING, Annotated, Any

import typer

from slipstick.cli.asked_accuracy import (
    AccuracyOption,
    MostSecondsOption,
    asked_accuracy,
    climbed_to,
    forget_rounds,
    leave_unless_met,
    refuse_beside_accuracy,
)
from slipstick.cli.optional import FiguresOption, OutputOption
from slipstick.cli.scene_options import SceneArgument, SetOption, warn_of_odd_numbers
from slipstick.cli.solver_option import SolverOption
from slipstick.solvers.names import SolverName

if TYPE_CHECKING:
    from contact_results.surface import Result
    from contact_scene.accuracy_reached import AccuracyReached
    from contact_scene.path_error import PathError
    from contact_scene.standing import Keeper
    from contact_scene.stated_error import StatedErrors
    from slipstick.solvers.solver import Solver


def run(
    scene: SceneArgument,
    output: OutputOption,
    overrides: SetOption = None,
    solver: SolverOption = SolverName.SEMI_ANALYTICAL,
    figures: FiguresOption = True,
    normalised: Annotated[
        bool,
        typer.Option(
            "--normalised",
            help="Draw figures over the sizes of Hertz' contact, x/a, p/p0, q/µp0; files stay in "
            "SI.",
        ),
    ] = False,
    overwrite: Annotated[
        bool,
        typer.Option("--overwrite", help="Replace files in DIR that are not of an earlier run."),
    ] = False,
    all_effects: Annotated[
        bool,
        typer.Option(
            "--all-effects",
            help="Compute every effect, called for or not, and say what the plan would save.",
        ),
    ] = False,
    surface_stress: Annotated[
        bool,
        typer.Option(
            "--surface-stress",
            help="Compute the stress at the surface at the ends of load cycles, for Ruiz's F2.",
        ),
    ] = False,
    error: Annotated[
        bool,
        typer.Option(
            "--error/--no-error",
            help="State an error for every number, by coarser solves beside the run; or leave "
            "them out.",
        ),
    ] = True,
    every_increment: Annotated[
        bool,
        typer.Option(
            "--every-increment",
            help="Store the fields of every increment in result.h5, not only those at the ends of "
            "load steps.",
        ),
    ] = False,
    accuracy: AccuracyOption = None,
    most_seconds: MostSecondsOption = None,
    path_error: Annotated[
        bool,
        typer.Option(
            "--path-error",
            help="Solve with twice the increments too, and say what finite increments cost.",
        ),
    ] = False,
) -> None:
    """Solve a scene and write summary, fields, tables and figures into DIR.

    DIR appears whole or not at all. The results of an earlier run in it are replaced once the new
    ones are there; other files in it are left alone. A run that takes longer leaves checkpoints
    beside DIR while it lasts: the same command goes on from there if it was killed.

    With --accuracy, or a table [accuracy] in the scene, the scene is solved on ever finer cells and
    increments until the errors are as small as asked; cells and increments of the scene are where
    that begins, not where it ends.
    """
    from contact_results.directory.checkpoint import checkpointed
    from contact_results.directory.code_digest import solve_identity
    from contact_results.directory.run_directory import run_directory
    from contact_results.directory.stop_signals import NOTHING_KEPT, cleaned_up_when_stopped
    from contact_results.directory.timing import Stopwatch, write_timing
    from contact_scene import read_scene_file
    from slipstick.cli.terminal import tell

    if normalised and not figures:
        raise typer.BadParameter("--normalised is of figures; leave it or --no-figures out")
    stopwatch = Stopwatch()
    with stopwatch.phase("read"):
        contents = read_scene_file(scene, overrides or ())
        request = asked_accuracy(contents, accuracy, most_seconds)
        told = warn_of_odd_numbers(contents)
    if solver is not SolverName.SEMI_ANALYTICAL:
        _refuse_beside_others(
            {
                "--all-effects": all_effects,
                "--surface-stress": surface_stress,
                "--path-error": path_error,
            }
        )
    if request is not None:
        refuse_beside_accuracy({"--all-effects": all_effects, "--no-error": not error})
    with stopwatch.phase("import"):
        chosen = solver.solver
        from slipstick.cli.progress import solve_progress
    fineness = chosen.fineness(contents)
    asked = (contents.scene, fineness, solver, all_effects)
    with (
        cleaned_up_when_stopped(kept=lambda: NOTHING_KEPT),
        checkpointed(output, solve_identity(*asked), tell) as keeper,
        checkpointed(output, solve_identity(*asked, 2), tell, "doubled-checkpoint") as doubled,
        ExitStack() as until_written,
        run_directory(output, overwrite=overwrite) as staging,
    ):
        decided = chosen.plan(contents.scene, fineness)
        if all_effects:
            decided = _with_all_effects(decided)
        stated = reached = None
        with stopwatch.phase("solve"):
            if request is not None:
                climbed = until_written.enter_context(
                    climbed_to(
                        request,
                        chosen,
                        contents,
                        output,
                        most_seconds,
                        surface_stress=surface_stress,
                    )
                )
                result, stated = climbed.rung.result, climbed.rung.stated
                reached = climbed.accuracy
            else:
                with solve_progress(decided.increments) as observe:
                    result = chosen.solve(contents.scene, fineness, decided, observe, keeper)
        by_doubling = None
        if path_error:
            with stopwatch.phase("path error"):
                by_doubling = _path_errors(result, doubled)
        if error and stated is None:
            with stopwatch.phase("error"):
                stated = _stated_errors(chosen, result, surface_stress)
        with stopwatch.phase("write"):
            from contact_results.result_files import write_result

            write_result(
                result,
                staging,
                with_figures=figures,
                normalised=normalised,
                surface_stress=surface_stress,
                path_errors=by_doubling,
                errors=stated,
                accuracy=reached,
                every_increment=every_increment,
            )
        write_timing(stopwatch, staging)
    from contact_results.remarks import remarks

    if request is None:
        forget_rounds(output)
    _print_outcome(chosen, result, stated, reached, by_doubling, stopwatch.wall_seconds)
    for remark in remarks(result):
        if remark not in told:
            tell(f"warning: {remark}")
    if not error:
        typer.echo("  no errors: --no-error left them out")
    typer.echo(f"results in {output}")
    if all_effects:
        _print_saving(result)
    leave_unless_met(reached)


def _refuse_beside_others(options: dict[str, bool]) -> None:
    for option, asked in options.items():
        if asked:
            raise typer.BadParameter(
                f"{option} is of the semi-analytical solver; leave it or --solver out"
            )


def _path_errors(result: Any, keeper: "Keeper") -> "tuple[PathError, ...]":
    from slipstick.cli.progress import solve_progress
    from slipstick.path_errors import path_errors

    with solve_progress(result.plan.doubled().increments) as observe:
        return path_errors(result, observe, keeper)


def _stated_errors(solver: "Solver", result: "Result", surface_stress: bool) -> "StatedErrors":
    from slipstick.cli.progress import companion_progress

    with companion_progress() as observe:
        return solver.errors(result, surface_stress=surface_stress, progress=observe)


def _print_outcome(
    solver: "Solver",
    result: "Result",
    stated: "StatedErrors | None",
    reached: "AccuracyReached | None",
    by_doubling: "tuple[PathError, ...] | None",
    seconds: dict[str, float],
) -> None:
    from slipstick.cli.outcome_text import (
        how_accurate,
        how_stated,
        outcome_columns,
        path_error_columns,
        solved_in,
    )
    from slipstick.cli.terminal import print_pairs, print_table

    stated_in = () if stated is None else how_stated(stated, seconds.get("error"))
    accurate = () if reached is None else how_accurate(reached)
    solved = solved_in(result, seconds["solve"])
    print_pairs([*solver.layout(result), *solved, *stated_in, *accurate])
    columns = outcome_columns(result.steps, stated.steps if stated else None)
    print_table(columns, zip(*columns.values(), strict=True), numbers=True)
    if by_doubling is not None:
        typer.echo("  errors by finite increments, estimated by doubling them:")
        columns = path_error_columns(by_doubling)
        print_table(columns, zip(*columns.values(), strict=True), numbers=True)


def _with_all_effects(plan: Any) -> Any:
    from semi_analytical import all_effects

    return all_effects(plan)


def _print_saving(forced: Any) -> None:
    """Solve again as planned, on the same grid, and compare."""
    from semi_analytical import plan, solve
    from slipstick.cli.outcome_text import saving
    from slipstick.cli.terminal import print_pairs

    planned = plan(forced.scene, edge=forced.plan.edge).cut_into(forced.plan.increments)
    print_pairs(saving(solve(forced.scene, forced.grid, forced.tolerance, plan=planned), forced))
