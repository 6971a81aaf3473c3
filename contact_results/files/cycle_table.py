"""`cycles.csv`: one row per closed load cycle with what it does to the surface, in SI."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from contact_results.directory.file_names import CYCLES
from contact_results.surface import Surface

if TYPE_CHECKING:
    from contact_results.cycles import FrettingCycle

COLUMNS = (
    "start_step",
    "end_step",
    "input_work",
    "dissipated_energy",
    "largest_dissipation",
    "slip_amplitude",
    "ruiz_f1",
    "ruiz_f1_x",
    "ruiz_f1_y",
    "surface_tension",
    "ruiz_f2",
    "ruiz_f2_x",
    "ruiz_f2_y",
)

Field = NDArray[np.float64]


def write_cycles(cycles: Sequence[FrettingCycle], surface: Surface, directory: Path) -> None:
    """Write one row per cycle, fields by their largest value and Ruiz's parameters with its place;
    no file if there is no cycle."""
    if not cycles:
        return
    with open(directory / CYCLES, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows(_row(cycle, surface) for cycle in cycles)


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
