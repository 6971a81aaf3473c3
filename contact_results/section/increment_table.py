"""`increments.csv` of a result on a section: what every increment carried and what it cost, SI."""

from __future__ import annotations

import csv
from pathlib import Path

from contact_results.directory.file_names import INCREMENTS
from fem_reference import Increment, Result
from fem_reference.energy import elastic_energy, input_work

COLUMNS = (
    *("step", "increment", "normal_force", "approach"),
    *("tangential_force_x", "tangential_force_y", "tangential_shift_x", "tangential_shift_y"),
    *("torque", "twist", "contact_area", "contact_radius", "stick_area", "stick_radius"),
    *("peak_pressure", "elastic_energy", "input_work", "dissipated_energy", "overlap"),
    *("worst_residual", "iterations", "factorizations", "sweeps", "halvings"),
)

Value = int | float | None


def write_section_increments(result: Result, directory: Path) -> None:
    """Write one row per increment; what an increment does not have is empty."""
    with open(directory / INCREMENTS, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        for increment, work in zip(result.increments, input_work(result.increments), strict=True):
            stored = elastic_energy(result.scene, result.plan, increment)
            table.writerow(_row(increment, stored, work))


def _row(i: Increment, stored: float | None, work: float | None) -> tuple[Value, ...]:
    undefined = (None, None)
    return (
        *(i.step, i.index, i.normal_force, i.approach),
        *(i.tangential_force or undefined),
        *(i.tangential_shift or undefined),
        *(i.torque, i.twist, i.contact_area, i.contact_radius, i.stick_area, i.stick_radius),
        *(i.peak_pressure, stored, work, i.dissipated_energy, i.overlap),
        *(i.residuals.worst, i.iterations, i.factorizations, i.sweeps, i.halvings),
    )
