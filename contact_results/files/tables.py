"""The CSV tables of a run: `profiles.csv`, `increments.csv`, `cycles.csv`, and column meanings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_results.cycles import FrettingCycle
from contact_results.directory.file_names import COLUMNS, CYCLES, INCREMENTS, PROFILES
from contact_results.files.csv_file import (
    STEP,
    Column,
    reported_column,
    write_meanings,
    write_table,
)
from contact_results.largest import index_of_largest
from contact_results.result_report import ResultReport
from contact_results.surface import Rings
from contact_scene.array_types import Field
from contact_scene.quantities.field_metadata import Kind, reported
from contact_scene.quantities.increment import (
    SCALARS,
    components,
    numbers,
)
from contact_scene.quantities.per_length import shown_mark, shown_name
from contact_scene.quantities.stated_error import StatedError
from contact_scene.quantities.summary import OF_CYCLES, ClosedCycle

if TYPE_CHECKING:
    from contact_results.surface import Increment, Surface


LINE = "on the line y = 0 of cells; of rings on the line through the axis along the tangential load"
PROFILE_VECTORS = {
    "shear": ("Pa", "tangential traction on the lower body"),
    "slip": ("m", "slip of the lower body against the indenter since the start"),
}
PROFILE_SCALARS = {
    "pressure": ("Pa", "Normal traction, positive in compression."),
    "gap": ("m", "Distance of the deformed surfaces; empty where they never touch."),
    "in_stick": (
        "",
        "1 in contact and sticking, 0 slipping or out of contact; 0.5 if so on one side only of a "
        "line that runs between two rows of cells.",
    ),
    "dissipation": ("J/m^2", "Energy per area lost to friction since the start."),
}
PROFILE_COLUMNS = (
    STEP,
    Column("x", "m", f"Place {LINE}."),
    Column("y", "m", f"Place {LINE}."),
    *(
        Column(f"{name}_{axis}", unit, f"Component along {axis} of the {meaning}.")
        for name, (unit, meaning) in PROFILE_VECTORS.items()
        for axis in ("x", "y")
    ),
    *(Column(name, unit, meaning) for name, (unit, meaning) in PROFILE_SCALARS.items()),
)


def write_profiles(report: ResultReport, directory: Path) -> None:
    """Write `profiles.csv`: tractions, slip and gap along a line at the ends of the load steps.

    The table has one row per point and load step, and the same columns for every solver. The line
    is y = 0 on cells, and the diameter along the tangential load on rings. Missing and infinite
    values are empty cells.
    """
    surface = report.surface
    if isinstance(surface, Rings):
        surface = surface.on_both_sides()
    rows = (row for step in report.steps for row in _profile_rows(surface, step))
    write_table(directory / PROFILES, PROFILE_COLUMNS, rows)


def _profile_rows(surface: Surface, step: Increment) -> Iterator[tuple[object, ...]]:
    """Yield the rows of `profiles.csv` for one load step, one row per point of the line.

    step  increment at the end of the load step
    """
    places = surface.profile_line.places
    parts: list[Any] = [places * along for along in surface.direction]
    for name in PROFILE_VECTORS:
        vector = surface.vector(step, name)
        parts.extend((None, None) if vector is None else surface.along(vector))
    for name in PROFILE_SCALARS:
        field = surface.scalar(step, name)
        parts.append(None if field is None else surface.along(field.astype(np.float64)))
    columns = [_column_cells(part, len(places)) for part in parts]
    # Both rays of a line of rings contain the axis.
    twice = places.size // 2 - 1 if np.count_nonzero(places == 0) == 2 else None
    for number, row in enumerate(zip(*columns, strict=True)):
        if number != twice:
            yield (step.step, *row)


def _column_cells(values: Any, size: int) -> list[float | None]:
    """Convert the values of a column to floats. Values that are not finite become empty cells."""
    if values is None:
        return [None] * size
    return [v + 0.0 if np.isfinite(v) else None for v in values.tolist()]


def increment_columns(*, line: bool) -> tuple[Column, ...]:
    """Return the columns of `increments.csv`: all scalars of an increment.

    line  True for a line contact, with other names and units
    """
    return (
        STEP,
        Column("increment", None, "Increment within the step, from 1."),
        *(
            reported_column(shown_name(part, line=line), shown_mark(name, mark, line=line))
            for name, mark in SCALARS.items()
            for part in components(name)
        ),
    )


def _cycle_cells(
    cycle: FrettingCycle, surface: Surface, errors: Mapping[str, StatedError], *, line: bool
) -> Iterator[tuple[Column, str | int | float | None]]:
    """Yield column and value of each cell of one row of `cycles.csv`.

    A field is represented by its largest value, and Ruiz's parameters also by the place of this
    value.

    surface  surface grid of the fields
    errors   stated errors at the load step that closes the cycle, by name; empty if not computed
    line     True for a line contact, whose energies and forces are per length
    """
    fields, words, values = reported(FrettingCycle), reported(ClosedCycle), cycle.numbers
    yield Column("start_step", None, "Step at whose end the cycle begins."), cycle.cycle.start
    yield Column("end_step", None, "Step at whose end the cycle closes."), cycle.cycle.end
    yield Column("regime", None, words["regime"].meaning), values["regime"].value
    yield reported_column("from_virgin", words["from_virgin"]), int(values["from_virgin"])
    work = shown_mark("input_work", fields["input_work"], line=line)
    yield reported_column("input_work", work), cycle.input_work
    for name, field in (
        ("largest_dissipation", "dissipation"),
        ("surface_tension", "surface_tension"),
    ):
        largest, *_ = _largest_with_place(getattr(cycle, field), surface)
        yield reported_column(name, fields[field], "Largest value on the surface: "), largest
    for name, any_mark in OF_CYCLES.items():
        mark = shown_mark(name, any_mark, line=line)
        vector = mark.kind is Kind.VECTOR
        stated = errors.get(name)
        means = f"Stated error of {name}; empty where nothing can be said."
        for number, part in enumerate((f"{name}_x", f"{name}_y") if vector else (name,)):
            both = (values.get(name), None if stated is None else stated.error)
            value, error = (v[number] if isinstance(v, tuple) else v for v in both)
            yield reported_column(part, mark), value
            yield Column(f"{part}_error", mark.unit, means), error
    for name in ("ruiz_f1", "ruiz_f2"):
        _, *place = _largest_with_place(getattr(cycle, name), surface)
        for axis, at in zip("xy", place, strict=True):
            yield Column(f"{name}_{axis}", "m", f"Where {name} is largest."), at


def _largest_with_place(field: Field | None, surface: Surface) -> tuple[float | None, ...]:
    """Return the largest value of a field on the surface, and x and y of its point [length].

    The coordinates are None if the field is zero. All three are None without a field.
    """
    if field is None:
        return None, None, None
    largest = np.unravel_index(index_of_largest(field), field.shape)
    if field[largest] == 0:
        return 0.0, None, None
    x, y = surface.positions
    return float(field[largest]), float(x[largest]), float(y[largest])


def write_tables(report: ResultReport, directory: Path) -> None:
    """Write the CSV tables of a run, and the table with the meanings of their columns.

    Missing values are empty cells.

    directory  directory of the run
    """
    line = report.scene.indenter.is_line
    tables = {PROFILES: PROFILE_COLUMNS, INCREMENTS: increment_columns(line=line)}
    write_profiles(report, directory)
    scalars = ((i.step, i.index, *numbers(i).values()) for i in report.increments)
    write_table(directory / INCREMENTS, tables[INCREMENTS], scalars)
    if report.cycles:
        rows = [
            list(_cycle_cells(cycle, report.surface, report.errors_of(cycle), line=line))
            for cycle in report.cycles
        ]
        tables[CYCLES] = tuple(column for column, _ in rows[0])
        write_table(directory / CYCLES, tables[CYCLES], ([cell for _, cell in r] for r in rows))
    write_meanings(directory / COLUMNS, tables)
