"""Command `slipstick against`: compare a run with a measured loop or profile."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated, Any

import typer
from pydantic import TypeAdapter, ValidationError

from contact_results.directory.json_record import first_mistake
from contact_results.directory.run_directory import refuse_files_above
from contact_results.files.stored_run import load
from contact_results.number_text import Uncertainty, number_text
from contact_scene import read_scene_file
from contact_scene.accuracy import accuracy_texts
from contact_scene.reading.engineering_units import engineering_unit
from contact_scene.reading.quantity import Share
from contact_scene.reading.text_table import read_columns
from slipstick.against import MEASURED, NothingToCompare, comparison, unmet
from slipstick.against_files import write_comparison
from slipstick.cli.errors import ExitCode
from slipstick.cli.options import OptionalSolver, SetOption, optional, refuse_with_run
from slipstick.cli.terminal import print_table
from slipstick.solvers.names import SolverName
from slipstick.solving import save, solve, stated_errors


def against(
    table: Annotated[
        Path,
        typer.Argument(
            metavar="TABLE",
            show_default=False,
            help="Text table with a line of heads: name [unit].",
        ),
    ],
    source: Annotated[
        Path,
        typer.Argument(
            metavar="RUN_DIR|SCENE",
            show_default=False,
            help="Output of 'slipstick run', or a scene file to solve first.",
        ),
    ],
    step: Annotated[
        int | None,
        optional(
            "--step",
            metavar="N",
            min=1,
            help="Load step at whose end profiles are compared. Default: the last.",
        ),
    ] = None,
    columns: Annotated[
        str | None,
        optional(
            "--columns",
            metavar="NAME=N,...",
            help="Columns of the table by their numbers, such as 'shift=2 um, T=3 N', instead of "
            "their heads. Without a unit, that of the head applies.",
        ),
    ] = None,
    require: Annotated[
        str | None,
        optional(
            "--require",
            metavar="SHARE,...",
            help="Exit with code 1 if a difference exceeds this share of the measured number, "
            "such as '5%' or 'energy_per_cycle 5%, slope 10%'.",
        ),
    ] = None,
    output: Annotated[
        Path | None,
        optional(
            "--output",
            "-o",
            metavar="DIR",
            help="Write the numbers (against.json) and a picture of both curves (against.png).",
        ),
    ] = None,
    overrides: SetOption = None,
    solver: OptionalSolver = None,
) -> None:
    """Compare a run with a measured loop or profile.

    A loop has the columns shift and T, such as 'shift [um],T [N]'. The last load cycle of the run
    is compared with it. A profile has x with p, q or both, along y = 0, and may have several load
    steps with their numbers in a column step. Other columns are ignored.
    The last column of the output is the largest part of the difference that the stated error
    explains.
    """
    if source.is_dir():
        refuse_with_run({"--set": overrides, "--solver": solver})
    if output is not None:
        refuse_files_above(output)
    chosen = solver or SolverName.SEMI_ANALYTICAL
    try:
        required = _required_shares(require)
        measured = read_columns(table, MEASURED, columns)
        with TemporaryDirectory() as solved:
            directory = source
            if not source.is_dir():
                result: Any = solve(read_scene_file(source, overrides or ()), chosen.value)
                directory = Path(solved) / "run"
                save(result, directory, figures="none", errors=stated_errors(result))
            run = load(directory)
            if step is not None and step > len(run.summary.steps):
                raise NothingToCompare(f"got step {step}, expected 1 to {len(run.summary.steps)}")
            compared = comparison(measured, run, step)
        failures = unmet(compared, required)
    except ValueError as error:
        raise typer.BadParameter(str(error)) from None
    rows = []
    for each in compared.numbers:
        unit = engineering_unit(max(abs(each.measured), abs(each.computed)), each.unit)
        of_table, of_run = (
            Uncertainty(error, True) if error else None for error in (each.of_table, each.error)
        )
        rows.append(
            (
                f"{each.name} ({unit.name})",
                number_text(each.measured, of_table, unit.size),
                number_text(each.computed, of_run, unit.size),
                "–" if each.ratio is None else f"{each.ratio:.4f}",
                number_text(each.gap, None, unit.size),
                "unknown" if each.ours is None else f"{100 * each.ours:.1f} %",
            )
        )
    heads = ("number", "measured", "computed", "ratio", "difference", "ours\nat most")
    print_table(heads, rows, numbers=True)
    if output is not None:
        write_comparison(compared, output, f"{table.name} and {source.resolve().name}")
        typer.echo(f"\nresults in {output}")
    for sentence in failures:
        typer.echo(f"✗ fail: {sentence}")
    if failures:
        raise typer.Exit(ExitCode.ACCURACY)


def _required_shares(text: str | None) -> dict[str, float]:
    """Return the required shares by name of the number; empty without a requirement.

    Raises `SceneError` for a text that is no requirement, and ValueError for a value that is no
    share.
    """
    if text is None:
        return {}
    try:
        return TypeAdapter(dict[str, Share]).validate_python(accuracy_texts(text))
    except ValidationError as error:
        raise ValueError(f"--require: {first_mistake(error)}") from None
