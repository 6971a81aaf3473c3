"""`increments.csv`: one row per increment with what it carried and what it cost, in SI."""

import csv
from pathlib import Path

import numpy as np

from contact_results.directory.file_names import INCREMENTS
from semi_analytical import Increment, Result

COLUMNS = (
    "step",
    "increment",
    "normal_force",
    "approach",
    "tangential_force_x",
    "tangential_force_y",
    "tangential_shift_x",
    "tangential_shift_y",
    "torque",
    "twist",
    "moment_x",
    "moment_y",
    "tilt_x",
    "tilt_y",
    "contact_area",
    "contact_radius",
    "stick_area",
    "stick_radius",
    "peak_pressure",
    "elastic_energy",
    "input_work",
    "dissipated_energy",
    "unresolved_work",
    "energy_imbalance",
    "largest_dissipation_increment",
    "largest_slip_increment",
    "worst_residual",
    "iterations",
    "convolutions",
)


def write_increments(result: Result, directory: Path) -> None:
    """Write one row per increment; the columns of an effect that is off are empty."""
    with open(directory / INCREMENTS, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows(_row(increment) for increment in result.increments)


def _row(increment: Increment) -> list[int | float | None]:
    undefined: tuple[None, None] = (None, None)
    force = undefined if increment.tangential_force is None else increment.tangential_force
    shift = undefined if increment.tangential_shift is None else increment.tangential_shift
    moment = undefined if increment.moment is None else increment.moment
    tilt = undefined if increment.tilt is None else increment.tilt
    reals = (
        increment.normal_force,
        increment.approach,
        *force,
        *shift,
        increment.torque,
        increment.twist,
        *moment,
        *tilt,
        increment.contact_area,
        increment.contact_radius,
        increment.stick_area,
        increment.stick_radius,
        increment.peak_pressure,
        increment.elastic_energy,
        increment.input_work,
        increment.dissipated_energy,
        increment.unresolved_work,
        increment.energy_imbalance,
        *_largest_changes(increment),
        increment.residuals.worst,
    )
    return [
        increment.step,
        increment.index,
        *(None if value is None else float(value) for value in reals),
        increment.iterations,
        increment.convolutions,
    ]


def _largest_changes(increment: Increment) -> tuple[float | None, float | None]:
    """Of dissipation and slip within the increment; None where there is none."""
    lost, slipped = increment.dissipation_increment, increment.slip_increment
    return (
        None if lost is None else float(np.max(lost)),
        None if slipped is None else float(np.max(np.hypot(*slipped))),
    )
