"""Command `slipstick run`: solve a scene and write its results."""

from contextlib import ExitStack
from dataclasses import replace
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from contact_results.solvers import SolverName
from slipstick.cli.accuracy_option import (
    AccuracyOption,
    MostSecondsOption,
    exit_unless_met,
    read_requested_accuracy,
    remove_level_checkpoints,
    solve_to_accuracy,
)
from slipstick.cli.errors import exit_code, print_traceback
from slipstick.cli.expect_option import ExpectOption, SaveExpectedOption, read_expectation
from slipstick.cli.options import (
    OutputOption,
    SceneArgument,
    SetOption,
    SolverOption,
    optional,
    print_input_warnings,
)

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from contact_results.result_files import WrittenResult
    from contact_results.result_report import ResultReport
    from contact_scene import SceneFile
    from contact_scene.discretised import DiscretisedSolver
    from contact_scene.quantities.summary import StepSummary
    from slipstick.expected import Source
    from slipstick.uncertain_inputs import UncertainInput


class Figures(StrEnum):
    """Figures that `slipstick run` draws: none, one overview, or all."""

    NONE = "none"
    OVERVIEW = "overview"
    ALL = "all"


def run(
    scene: SceneArgument,
    output: OutputOption,
    overrides: SetOption = None,
    solver: SolverOption = SolverName.SEMI_ANALYTICAL,
    figures: Annotated[
        Figures,
        typer.Option(
            "--figures",
            metavar="NAME",
            help="overview: one figure and the page index.html; all: maps and profiles as well; "
            "none: no figure and no page.",
        ),
    ] = Figures.OVERVIEW,
    overwrite: Annotated[
        bool,
        typer.Option("--overwrite", help="Replace result files in DIR that no run has written."),
    ] = False,
    error: Annotated[
        bool,
        typer.Option(
            "--error/--no-error",
            help="State an error for every number, by coarse solves, or omit the errors.",
        ),
    ] = True,
    all_fields: Annotated[
        bool,
        typer.Option(
            "--all-fields",
            help="Store the fields of every increment in result.h5, not only those at the ends of "
            "load steps.",
        ),
    ] = False,
    accuracy: AccuracyOption = None,
    most_seconds: MostSecondsOption = None,
    save_expected: SaveExpectedOption = None,
    expect: ExpectOption = None,
    inputs: Annotated[
        str | None,
        optional(
            "--inputs",
            metavar="INPUTS",
            help="State the uncertainty by inputs with standard deviations, such as "
            "friction.coefficient=.1±.01 (or +-), separated by commas. Each takes two more solves.",
        ),
    ] = None,
) -> None:
    """Solve a scene and write summary, fields, tables, a figure and a page into DIR.

    DIR is written atomically. Results of an earlier run in DIR are replaced; other files remain. A
    run of more than some seconds stores checkpoints next to DIR: after it was killed, the same
    command resumes it. A part of the results that cannot be computed is named in a warning; the
    solved fields and the other parts are written.

    With --expect, a result whose numbers are worse than the expected ones is written, too, and the
    command exits with code 7.

    With --accuracy, or a table [accuracy] in the scene, the scene is first solved on a coarse grid
    or mesh. Cells and increments are then refined until the stated errors meet the request.
    """
    from contact_results.directory.checkpoint import provide_checkpoints
    from contact_results.directory.code_digest import solve_identity
    from contact_results.directory.run_directory import run_directory
    from contact_results.directory.stop_signals import NOTHING_KEPT, cleaned_up_when_stopped
    from contact_results.directory.timing import Stopwatch, write_timing
    from contact_results.omitted_parts import OmittedParts
    from slipstick.cli.terminal import print_message

    stopwatch = Stopwatch()
    with stopwatch.phase("read"):
        contents, uncertain, changed = _read_scenes(scene, overrides or (), inputs)
        request = read_requested_accuracy(contents, accuracy, most_seconds, error=error)
        expectation = read_expectation(
            expect, save_expected, lambda: _source(contents, solver), error=error
        )
        printed = print_input_warnings(contents)
    with stopwatch.phase("import"):
        chosen = solver.solver.of_file(contents)
        from slipstick.cli.progress import show_coarse_solves, solve_progress
    identity = solve_identity(contents.scene, chosen.discretisation, solver)
    with (
        cleaned_up_when_stopped(kept=lambda: NOTHING_KEPT),
        provide_checkpoints(output, identity, print_message) as store,
        ExitStack() as until_written,
        run_directory(output, overwrite=overwrite) as staging,
    ):
        decided = chosen.run_plan
        stated = reached = None
        with stopwatch.phase("solve"):
            if request is not None:
                refined = until_written.enter_context(
                    solve_to_accuracy(request, chosen, output, most_seconds)
                )
                result, stated = refined.level.result, refined.level.stated
                reached = refined.accuracy
            else:
                with solve_progress(decided.increments) as observe:
                    result = chosen.run(observe, store)
        omitted = OmittedParts()
        with stopwatch.phase("write"):
            from contact_results.files.field_file import write_fields
            from contact_results.result_files import write_computed
            from contact_results.result_report import ResultReport

            report = ResultReport.of(result)
            write_fields(report, staging, all_fields=all_fields, given=contents.scene)
        if error and stated is None:
            with stopwatch.phase("error"), show_coarse_solves():
                from contact_errors.coarse_solves import stated_errors

                stated = omitted.compute("the errors", lambda: stated_errors(result), None)
        by_inputs: Mapping[str, list[str]] | None = None
        if uncertain:
            with stopwatch.phase("inputs"):
                by_inputs = omitted.compute(
                    "the uncertainty by inputs",
                    lambda: _uncertainty_by_inputs(
                        type(chosen), uncertain, changed, replace(report, errors=stated), staging
                    ),
                    None,
                )
        with stopwatch.phase("write"):
            report = replace(report, errors=stated, accuracy=reached, by_inputs=by_inputs)
            written = write_computed(report, staging, omitted, figures=figures.value)
        write_timing(stopwatch, staging, result.increments)

    if request is None:
        remove_level_checkpoints(output)
    _print_outcome(chosen, written, stopwatch.wall_seconds)
    _print_uncertainty(by_inputs)
    for warning in written.warnings:
        if warning not in printed:
            print_message(f"warning: {warning}")
    if not error:
        typer.echo("  no errors, because of --no-error")
    typer.echo(f"results in {output}")
    worse = 0
    if expectation is not None:
        from slipstick.expected import step_numbers

        line = contents.scene.indenter.is_line
        worse = expectation.settle(step_numbers(written.summary.steps, line=line))
    exit_unless_met(reached)
    causes = list(omitted.causes.values())
    for cause in causes:
        print_traceback(cause)
    if causes:
        raise typer.Exit(exit_code(causes[0]))
    if worse:
        raise typer.Exit(worse)


def _read_scenes(
    path: "Path", overrides: "Sequence[str]", inputs: str | None
) -> "tuple[SceneFile, tuple[UncertainInput, ...], Sequence[Sequence[SceneFile]]]":
    """Read the scene, the uncertain inputs, and the scenes with one changed input.

    path       scene file
    overrides  texts of the option `--set`
    inputs     text of the option `--inputs`, or None
    returns    scene; uncertain inputs; scene with one deviation less and more of each input
    """
    from contact_scene import read_scene_file

    if inputs is None:
        return read_scene_file(path, overrides), (), ()
    from slipstick.uncertain_inputs import changed_overrides, read_inputs

    def changed(changes: "Sequence[str]") -> "SceneFile":
        return read_scene_file(path, overrides, {"--inputs": changes})

    uncertain = read_inputs(inputs)
    contents = changed([one.override() for one in uncertain])
    return contents, uncertain, [list(map(changed, pair)) for pair in changed_overrides(uncertain)]


def _uncertainty_by_inputs(
    solver: "type[DiscretisedSolver]",
    inputs: "Sequence[UncertainInput]",
    changed: "Sequence[Sequence[SceneFile]]",
    report: "ResultReport",
    directory: "Path",
) -> "Mapping[str, list[str]]":
    """Solve the scenes of changed inputs, write the uncertainty of the results, return its table.

    inputs     uncertain inputs
    changed    scene with one deviation less and more of each input
    directory  directory of the results
    """
    from contact_results.directory.file_names import INPUTS
    from contact_results.files.summary_file import summary_of
    from contact_results.result_report import ResultReport
    from slipstick.uncertain_inputs import (
        uncertain_numbers,
        uncertainty_columns,
        write_uncertainties,
    )

    def last_step(report: ResultReport) -> "StepSummary":
        return summary_of(report.with_cycles()).steps[-1]

    def solved(contents: "SceneFile") -> "StepSummary":
        return last_step(ResultReport.of(solver.of_file(contents).run()))

    ends = [(solved(less), solved(more)) for less, more in changed]
    line = report.scene.indenter.is_line
    numbers = uncertain_numbers(last_step(report), ends, line=line)
    write_uncertainties(inputs, numbers, directory / INPUTS)
    return uncertainty_columns(inputs, numbers)


def _print_uncertainty(by_inputs: "Mapping[str, list[str]] | None") -> None:
    """Print the table of the uncertainty by inputs; None if it was not requested."""
    from slipstick.cli.terminal import print_table

    if by_inputs:
        print_table(by_inputs, zip(*by_inputs.values(), strict=True), numbers=True)
    elif by_inputs is not None:
        typer.echo("  the inputs change no number at the end of the last step")


def _source(contents: "SceneFile", solver: SolverName) -> "Source":
    from slipstick.expected import Source, scene_keys

    return Source("run", scene_keys(contents.scene), solver.value)


def _print_outcome(
    solver: "DiscretisedSolver", written: "WrittenResult", seconds: dict[str, float]
) -> None:
    """Print discretisation, errors and scalars of a finished run.

    seconds  elapsed time of each phase of the run [s]
    """
    from contact_results.key_numbers import LOOPS, doubts_of, outcome_columns
    from slipstick.cli.progress import accuracy_lines, error_lines, solve_lines
    from slipstick.cli.terminal import print_pairs, print_table

    report = written.report
    result, stated, reached = report.result, report.errors, report.accuracy
    stated_in = () if stated is None else error_lines(stated, seconds.get("error"))
    accurate = () if reached is None else accuracy_lines(reached)
    solved = solve_lines(result, seconds["solve"])
    print_pairs([*solver.describe_result(result), *solved, *stated_in, *accurate])
    columns = outcome_columns(report.steps, report.step_errors)
    for table in (columns, *([written.cycles] if written.cycles else ())):
        print_table(table, zip(*table.values(), strict=True), numbers=True)
    if written.cycles:
        typer.echo(f"  {LOOPS}")
    for text in doubts_of(report):
        typer.echo(f"  {text}")
