"""Command `slipstick against`: compare a run with a measured loop or profile."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from math import floor, log10
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated, Any

import typer
from pydantic import TypeAdapter, ValidationError

from contact_results.directory.json_record import first_mistake
from contact_results.directory.run_directory import refuse_files_above
from contact_results.files.stored_run import StoredRun, load
from contact_results.number_text import Uncertainty, number_text
from contact_results.solvers import SolverName
from contact_scene import SceneFile, read_scene_file
from contact_scene.accuracy import accuracy_texts
from contact_scene.reading.engineering_units import engineering_unit
from contact_scene.reading.quantity import Share
from contact_scene.reading.text_table import read_columns
from slipstick.against import (
    MEASURED,
    PLACE,
    STEPS,
    ComparedNumber,
    Comparison,
    NothingToCompare,
    Numbers,
    comparison,
    unmet,
)
from slipstick.against_files import write_comparison
from slipstick.cli.errors import ExitCode
from slipstick.cli.options import OptionalSolver, SetOption, optional, refuse_if, refuse_with_run
from slipstick.cli.terminal import print_table
from slipstick.identification import FittedInput, fit, read_first_values
from slipstick.solving import save, solve, stated_errors
from slipstick.uncertain_inputs import changed_overrides, read_inputs
from slipstick.validation import with_uncertainties

FITTED_DIGITS = 8
HEADS = ("number", "measured", "computed", "ratio", "difference", "ours\nat most")
FITTED_HEADS = ("fitted", "first", "value ± scatter", "by errors")


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
    inputs: Annotated[
        str | None,
        optional(
            "--inputs",
            metavar="KEY=VALUE±DEVIATION,...",
            help="State the validation uncertainty of each difference by these values and standard "
            "deviations of a scene, such as 'friction.coefficient=.1±.01' (or +-). Each takes two "
            "more solves.",
        ),
    ] = None,
    deviation: Annotated[
        str | None,
        optional(
            "--deviation",
            metavar="SHARE",
            help="Standard deviation of the measured numbers, such as '1%', for the validation "
            "uncertainty.",
        ),
    ] = None,
    fitted: Annotated[
        str | None,
        optional(
            "--fit",
            metavar="KEY=VALUE,...",
            help="Fit these keys of a scene to the table by least squares, from first values such "
            "as 'friction.coefficient=.1, rig.tangential_stiffness=50 N/um', and compare the "
            "fitted scene.",
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

    A loop has the columns shift and T, such as 'shift [um],T [N]', or T [N/mm] of a line contact.
    The last load cycle of the run is compared with it. A profile has x with p, q or both, along
    y = 0, and may have several load steps with their numbers in a column step. Other columns are
    ignored.
    The last column of the output is the largest part of the difference that the stated error
    explains. With --inputs or --deviation, a difference has its validation uncertainty: two
    standard deviations by numerical error, inputs and table.
    """
    if source.is_dir():
        refuse_with_run(
            {"--set": overrides, "--solver": solver, "--inputs": inputs, "--fit": fitted}
        )
    both = inputs is not None and fitted is not None
    refuse_if(((both, "got --inputs and --fit, expected one of them"),))
    if output is not None:
        refuse_files_above(output)
    identified: tuple[FittedInput, ...] = ()
    try:
        required = _required_shares(require)
        scatter = _share("--deviation", deviation)
        measured = _read_table(table, columns)

        def compare(changes: Sequence[str], *, errors: bool = True) -> Comparison:
            option = "--inputs" if fitted is None else "--fit"
            contents = read_scene_file(source, overrides or (), {option: changes})
            return _compare_scene(measured, contents, solver, step, errors=errors)

        if source.is_dir():
            compared = _compare(measured, load(source), step)
        elif fitted is not None:
            identified, compared = fit(
                read_first_values(fitted),
                lambda inputs, errors: compare([one.override for one in inputs], errors=errors),
            )
        else:
            uncertain = () if inputs is None else read_inputs(inputs)
            compared = compare([one.override() for one in uncertain])
        if inputs is not None or deviation is not None:
            changed = [
                (compare(less, errors=False), compare(more, errors=False))
                for less, more in changed_overrides(() if inputs is None else read_inputs(inputs))
            ]
            compared = with_uncertainties(compared, changed, scatter)
        failures = unmet(compared, required)
    except ValueError as error:
        raise typer.BadParameter(str(error)) from None
    print_table(HEADS, map(_compared_row, compared.numbers), numbers=True)
    if identified:
        typer.echo()
        print_table(FITTED_HEADS, map(_fitted_row, identified), numbers=True)
    if output is not None:
        write_comparison(compared, output, f"{table.name} and {source.resolve().name}", identified)
        typer.echo(f"\nresults in {output}")
    for sentence in failures:
        typer.echo(f"✗ fail: {sentence}")
    if failures:
        raise typer.Exit(ExitCode.ACCURACY)


def _compare(measured: Mapping[str, Numbers], run: StoredRun, step: int | None) -> Comparison:
    if step is not None and step > len(run.summary.steps):
        raise NothingToCompare(f"got step {step}, expected 1 to {len(run.summary.steps)}")
    return comparison(measured, run, step)


def _compare_scene(
    measured: Mapping[str, Numbers],
    contents: SceneFile,
    solver: SolverName | None,
    step: int | None,
    *,
    errors: bool,
) -> Comparison:
    result: Any = solve(contents, (solver or SolverName.SEMI_ANALYTICAL).value)
    stated = stated_errors(result) if errors else None
    with TemporaryDirectory() as directory:
        save(result, Path(directory) / "run", figures="none", errors=stated)
        return _compare(measured, load(Path(directory) / "run"), step)


def _read_table(path: Path, columns: str | None) -> Mapping[str, Numbers]:
    """Read the measured columns of a table,
    and the load steps of a profile if they are plain numbers."""
    measured = read_columns(path, MEASURED, columns)
    if PLACE in measured and columns is None:
        with suppress(ValueError):
            return read_columns(path, {**MEASURED, **STEPS})
    return measured


def _compared_row(one: ComparedNumber) -> tuple[str, ...]:
    """Return the row of a compared number, with its values in one engineering unit."""
    unit = engineering_unit(max(abs(one.measured), abs(one.computed)), one.unit)
    of_table, of_run, apart = (
        Uncertainty(error, True) if error else None
        for error in (one.of_table, one.error, one.uncertainty)
    )
    return (
        f"{one.name} ({unit.name})",
        number_text(one.measured, of_table, unit.size),
        number_text(one.computed, of_run, unit.size),
        "–" if one.ratio is None else f"{one.ratio:.4f}",
        number_text(one.gap, apart, unit.size),
        "unknown" if one.ours is None else f"{100 * one.ours:.1f} %",
    )


def _fitted_row(one: FittedInput) -> tuple[str, ...]:
    """Return the row of a fitted input: key, first value, value, and both uncertainties."""
    name = f"{one.key} ({one.unit})" if one.unit else one.key
    by_errors = "unknown" if one.by_errors is None else f"{one.by_errors:.2g}"
    if not one.by_scatter:
        return name, f"{one.first:g}", f"{one.value:.{FITTED_DIGITS}g}", by_errors
    # Two digits of the scatter, and the value to the same decimals (JCGM 100:2008, 7.2.6).
    digits = 2 + floor(log10(one.value)) - floor(log10(one.by_scatter))
    digits = min(FITTED_DIGITS, max(2, digits))
    text = f"{one.value:.{digits}g} ± {one.by_scatter:.2g}"
    return name, f"{one.first:g}", text, by_errors


def _share(option: str, text: str | None) -> float:
    """Return the share in the text of an option, such as "1%"; 0 without a text.

    Raises ValueError for a value that is no share.
    """
    if text is None:
        return 0.0
    share: str | float = text
    with suppress(ValueError):
        share = float(text)
    try:
        return TypeAdapter(Share).validate_python(share)
    except ValidationError as error:
        raise ValueError(f"{option}: {first_mistake(error)}") from None


def _required_shares(text: str | None) -> dict[str, float]:
    """Return the required shares by name. Raise `SceneError` for a text that is no requirement,
    and ValueError for a value that is no share."""
    if text is None:
        return {}
    try:
        return TypeAdapter(dict[str, Share]).validate_python(accuracy_texts(text))
    except ValidationError as error:
        raise ValueError(f"--require: {first_mistake(error)}") from None
