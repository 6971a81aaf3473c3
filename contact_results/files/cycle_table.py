"""`cycles.csv`: one row per closed load cycle with what it does to the surface."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contact_results.cycles import FrettingCycle
from contact_results.directory.file_names import CYCLES
from contact_results.files.csv_file import Column, marked, write_table
from contact_results.surface import Surface
from contact_scene.reported import reported

LARGEST = "Of the surface, where it is largest: "


def _columns() -> tuple[Column, ...]:
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
    return tuple(columns)


COLUMNS = _columns()

Field = NDArray[np.float64]


def write_cycles(cycles: Sequence[FrettingCycle], surface: Surface, directory: Path) -> None:
    """Write one row per cycle, fields by their largest value and Ruiz's parameters with its place;
    no file if there is no cycle."""
    if not cycles:
        return
    write_table(directory / CYCLES, COLUMNS, (_row(cycle, surface) for cycle in cycles))


def _row(cycle: FrettingCycle, surface: Surface) -> list[int | float | None]:
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
    """The largest value and its place; no place where the field is zero."""
    if field is None:
        return None, None, None
    largest = np.unravel_index(int(np.argmax(field)), field.shape)
    if field[largest] == 0:
        return 0.0, None, None
    x, y = surface.positions
    return float(field[largest]), float(x[largest]), float(y[largest])
