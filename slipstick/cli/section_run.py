"""`slipstick run --solver fem`: from a scene to a directory of results, by finite elements."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from slipstick.cli.solver_option import SolverName, method_of

if TYPE_CHECKING:
    from contact_results.directory.timing import Stopwatch
    from contact_scene import SceneFile
    from contact_scene.standing import Keeper
    from fem_reference import Result


def run_on_section(
    contents: SceneFile,
    solver: SolverName,
    stopwatch: Stopwatch,
    output: Path,
    *,
    overwrite: bool,
    figures: bool,
) -> None:
    """Solve a scene and write summary, fields, tables and figures into a directory.

    Raises what `run_directory` and `fem_reference.solve` raise.
    """
    from contact_results.directory.checkpoint import checkpointed
    from contact_results.directory.code_digest import solve_identity
    from contact_results.directory.run_directory import run_directory
    from contact_results.directory.stop_signals import NOTHING_KEPT, cleaned_up_when_stopped
    from contact_results.directory.timing import write_timing
    from contact_results.files.result_files import write_result
    from slipstick.cli.terminal import tell

    identity = solve_identity(contents.scene, contents.fem_reference, solver)
    with (
        cleaned_up_when_stopped(kept=lambda: NOTHING_KEPT),
        checkpointed(output, identity, tell) as keeper,
        run_directory(output, overwrite=overwrite) as staging,
    ):
        result = solve_on_section(contents, solver, stopwatch, keeper)
        with stopwatch.phase("write"):
            write_result(result, staging, with_figures=figures)
        write_timing(stopwatch, staging)
    _print_outcome(result, solver, stopwatch, output)


def solve_on_section(
    contents: SceneFile, solver: SolverName, stopwatch: Stopwatch, keeper: Keeper | None = None
) -> Result:
    """The solution, its progress on the terminal."""
    with stopwatch.phase("import"):
        import fem_reference
        from slipstick.cli.progress import solve_progress
    decided = fem_reference.plan(contents.scene)
    with stopwatch.phase("solve"), solve_progress(decided.increments) as observe:
        progress: Any = observe
        return fem_reference.solve(
            contents.scene, contents.fem_reference, method_of(solver), progress, keeper
        )


def _print_outcome(result: Result, solver: SolverName, stopwatch: Stopwatch, output: Path) -> None:
    from contact_scene.linear_theory import beyond_linear_theory
    from slipstick.cli.outcome_text import outcome_columns
    from slipstick.cli.section_text import solved_on_section
    from slipstick.cli.terminal import print_pairs, print_table, tell

    seconds = stopwatch.wall_seconds["solve"]
    print_pairs(solved_on_section(result, method_of(solver), seconds))
    columns = outcome_columns(result)
    print_table(columns, zip(*columns.values(), strict=True), numbers=True)
    for remark in beyond_linear_theory(result.scene, result.steps):
        tell(f"warning: {remark}")
    typer.echo(f"results in {output}")
