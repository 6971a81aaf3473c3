"""`slipstick run`: from a scene to a directory of results."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from verification.cli.scene_options import SceneArgument, SetOption

if TYPE_CHECKING:
    from contact_scene import SceneFile
    from semi_analytical import Result
    from verification.run_output.timing import Stopwatch


def run(
    scene: SceneArgument,
    output: Annotated[
        Path,
        typer.Option("--output", "-o", metavar="DIR", help="Where the results go; made if absent."),
    ],
    overrides: SetOption = None,
    figures: Annotated[
        bool, typer.Option("--figures/--no-figures", help="Draw figures, or leave them out.")
    ] = True,
    overwrite: Annotated[
        bool,
        typer.Option("--overwrite", help="Replace files in DIR that are not of an earlier run."),
    ] = False,
) -> None:
    """Solve a scene and write summary, fields, tables and figures into DIR.

    DIR appears whole or not at all. The results of an earlier run in it are replaced once the new
    ones are there; other files in it are left alone.
    """
    from contact_scene import read_scene_file
    from verification.run_output.run_directory import run_directory
    from verification.run_output.timing import Stopwatch

    stopwatch = Stopwatch()
    with stopwatch.phase("read"):
        contents = read_scene_file(scene, overrides or ())
    with run_directory(output, overwrite=overwrite) as staging:
        result = _solve(contents, stopwatch)
        _write(result, stopwatch, staging, figures)
    _print_outcome(result, stopwatch, output)


def _solve(contents: "SceneFile", stopwatch: "Stopwatch") -> "Result":
    with stopwatch.phase("import"):
        from semi_analytical import plan, solve_discretised
        from verification.cli.progress import solve_progress
    increments = plan(contents.scene).increments
    with stopwatch.phase("solve"), solve_progress(increments) as observe:
        return solve_discretised(contents.scene, contents.semi_analytical, progress=observe)


def _write(result: "Result", stopwatch: "Stopwatch", staging: Path, figures: bool) -> None:
    from verification.run_output.result_files import write_result
    from verification.run_output.timing import write_timing

    with stopwatch.phase("write"):
        write_result(result, staging, with_figures=figures)
    write_timing(stopwatch, staging)


def _print_outcome(result: "Result", stopwatch: "Stopwatch", output: Path) -> None:
    from verification.cli.outcome_text import outcome_columns, solved_with
    from verification.cli.terminal import print_pairs, print_table

    print_pairs(solved_with(result, stopwatch.wall_seconds["solve"]))
    columns = outcome_columns(result)
    print_table(columns, zip(*columns.values(), strict=True), numbers=True)
    typer.echo(f"results in {output}")
