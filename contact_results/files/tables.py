"""The CSV tables of a run: `profiles.csv`, `increments.csv`, `cycles.csv`, and column meanings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_results.cycles import FrettingCycle
from contact_results.directory.file_names import COLUMNS, CYCLES, INCREMENTS, PROFILES
from contact_results.files.csv_file import STEP, Column, marked, write_meanings, write_table
from contact_results.surface import Rings, surface_of
from contact_scene.array_types import Field
from contact_scene.quantities.field_metadata import Kind, reported
from contact_scene.quantities.increment import (
    SCALARS,
    components,
    numbers,
)
from contact_scene.quantities.stated_error import StatedError
from contact_scene.quantities.summary import OF_CYCLES, Closed

if TYPE_CHECKING:
    from contact_results.surface import Increment, Result, Surface


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


def write_profiles(result: Result, directory: Path) -> None:
    """Write `profiles.csv`: tractions, slip and gap along a line at the ends of the load steps.

    The table has one row per point and load step, and the same columns for every solver. The line
    is y = 0 on cells, and the diameter along the tangential load on rings. Missing and infinite
    values are empty cells.
    """
    surface = surface_of(result)
    if isinstance(surface, Rings):
        surface = surface.on_both_sides()
    rows = (row for step in result.steps for row in _profile_rows(surface, step))
    write_table(directory / PROFILES, PROFILE_COLUMNS, rows)


def _profile_rows(surface: Surface, step: Increment) -> Iterator[tuple[object, ...]]:
    """Yield the rows of `profiles.csv` for one load step, one row per point of the line.

    step  increment at the end of the load step
    """
    places = surface.line.places
    parts: list[Any] = [places * along for along in surface.direction]
    for name in PROFILE_VECTORS:
        vector = surface.vector(step, name)
        parts.extend((None, None) if vector is None else surface.along(vector))
    for name in PROFILE_SCALARS:
        field = surface.scalar(step, name)
        parts.append(None if field is None else surface.along(field.astype(np.float64)))
    columns = [_shown(part, len(places)) for part in parts]
    # Both rays of a line of rings contain the axis.
    twice = places.size // 2 - 1 if np.count_nonzero(places == 0) == 2 else None
    for number, row in enumerate(zip(*columns, strict=True)):
        if number != twice:
            yield (step.step, *row)


def _shown(values: Any, size: int) -> list[float | None]:
    """Convert the values of a table column to floats, without negative zeros.

    values  array (size,); None gives `size` empty cells
    size    number of rows

    Values that are not finite become None, which is an empty cell.
    """
    if values is None:
        return [None] * size
    return [v + 0.0 if np.isfinite(v) else None for v in values.tolist()]


INCREMENT_COLUMNS = (
    STEP,
    Column("increment", None, "Increment within the step, from 1."),
    *(marked(part, mark) for name, mark in SCALARS.items() for part in components(name)),
)


def write_increments(result: Result, directory: Path) -> None:
    """Write `increments.csv`: all scalars of the result, one row per increment.

    Missing values are empty cells.
    """
    rows = ((i.step, i.index, *numbers(i).values()) for i in result.increments)
    write_table(directory / INCREMENTS, INCREMENT_COLUMNS, rows)


# Numbers of a fretting loop that no other column contains.
OF_LOOPS = [
    name
    for name in OF_CYCLES
    if name not in ("energy_per_cycle", "slip_amplitude", "ruiz_f1", "ruiz_f2")
]
LARGEST = "Largest value on the surface: "


def _cycle_columns() -> tuple[Column, ...]:
    """Return the columns of `cycles.csv`.

    The columns contain energies, largest values of the fields, the places of Ruiz's parameters,
    numbers of the loop, and stated errors.
    """
    marks = reported(FrettingCycle)
    columns = [
        Column("start_step", None, "Step at whose end the cycle begins."),
        Column("end_step", None, "Step at whose end the cycle closes."),
        marked("input_work", marks["input_work"]),
        marked("dissipated_energy", marks["dissipated_energy"]),
        marked("largest_dissipation", marks["dissipation"], LARGEST),
        marked("slip_amplitude", marks["slip_amplitude"], LARGEST),
    ]
    for name, before in (("ruiz_f1", ()), ("ruiz_f2", ("surface_tension",))):
        columns += (marked(field, marks[field], LARGEST) for field in (*before, name))
        columns += (Column(f"{name}_{axis}", "m", f"Where {name} is largest.") for axis in "xy")
    loop = reported(Closed)
    columns += (Column("regime", None, loop["regime"].meaning),)
    columns += (marked("from_virgin", loop["from_virgin"]),)
    columns += (marked(part, OF_CYCLES[name]) for name in OF_LOOPS for part in _parts(name))
    for name, mark in OF_CYCLES.items():
        means = f"Stated error of {name}; empty where nothing can be said."
        columns += (Column(f"{part}_error", mark.unit, means) for part in _parts(name))
    return tuple(columns)


def _parts(name: str) -> tuple[str, ...]:
    """Return the column names of a scalar of a load cycle: two for a vector, else one."""
    vector = OF_CYCLES[name].kind is Kind.VECTOR
    return (f"{name}_x", f"{name}_y") if vector else (name,)


def _values(name: str, value: Any) -> tuple[float | None, ...]:
    """Return the table cells of a scalar of a load cycle: two for a vector, else one.

    name   name of the scalar
    value  number, or pair of numbers; None gives empty cells
    """
    return value if isinstance(value, tuple) else (value,) * len(_parts(name))


CYCLE_COLUMNS = _cycle_columns()


def write_cycles(
    cycles: Sequence[FrettingCycle],
    surface: Surface,
    directory: Path,
    errors: Sequence[Mapping[str, StatedError]] | None = None,
) -> None:
    """Write `cycles.csv` with one row per closed load cycle; no file if there is no cycle.

    A field is represented by its largest value, and Ruiz's parameters also by the place of this
    value.

    surface    surface grid of the fields
    directory  directory of the run
    errors     stated errors of the scalars of every load step, by name; None if they were not
               computed
    """
    if not cycles:
        return
    rows = (
        [
            *_cycle_row(cycle, surface),
            *_loop_row(cycle, errors[cycle.cycle.end - 1] if errors else {}),
        ]
        for cycle in cycles
    )
    write_table(directory / CYCLES, CYCLE_COLUMNS, rows)


def _loop_row(
    cycle: FrettingCycle, errors: Mapping[str, StatedError]
) -> Iterator[str | int | float | None]:
    """Yield the cells of a row of `cycles.csv` from the slip regime to the stated errors.

    errors  stated errors at the load step that closes the cycle, by name; empty if not computed
    """
    numbers = cycle.numbers
    yield numbers["regime"].value
    yield int(numbers["from_virgin"])
    for name in OF_LOOPS:
        yield from _values(name, numbers.get(name))
    for name in OF_CYCLES:
        stated = errors.get(name)
        yield from _values(name, None if stated is None else stated.error)


def _cycle_row(cycle: FrettingCycle, surface: Surface) -> list[int | float | None]:
    """Return the first cells of a row of `cycles.csv`: load steps, energies, largest values."""
    tension = cycle.surface_tension
    return [
        cycle.cycle.start,
        cycle.cycle.end,
        cycle.input_work,
        cycle.dissipated_energy,
        None if cycle.dissipation is None else float(np.max(cycle.dissipation)),
        float(np.max(cycle.slip_amplitude)),
        *_largest(cycle.ruiz_f1, surface),
        None if tension is None else float(np.max(tension)),
        *_largest(cycle.ruiz_f2, surface),
    ]


def _largest(field: Field | None, surface: Surface) -> tuple[float | None, ...]:
    """Return the largest value of a field on the surface, and x and y of its point [length].

    The coordinates are None if the field is zero. All three are None without a field.
    """
    if field is None:
        return None, None, None
    largest = np.unravel_index(int(np.argmax(field)), field.shape)
    if field[largest] == 0:
        return 0.0, None, None
    x, y = surface.positions
    return float(field[largest]), float(x[largest]), float(y[largest])


def write_tables(
    result: Result,
    cycles: Sequence[FrettingCycle],
    directory: Path,
    errors: Sequence[Mapping[str, StatedError]] | None = None,
) -> None:
    """Write the CSV tables of a run, and the table with the meanings of their columns.

    cycles     closed load cycles of the result
    directory  directory of the run
    errors     stated errors of the scalars of every load step, by name; None if they were not
               computed
    """
    write_profiles(result, directory)
    write_increments(result, directory)
    write_cycles(cycles, surface_of(result), directory, errors)
    tables = {PROFILES: PROFILE_COLUMNS, INCREMENTS: INCREMENT_COLUMNS}
    write_meanings(directory / COLUMNS, tables | ({CYCLES: CYCLE_COLUMNS} if cycles else {}))
