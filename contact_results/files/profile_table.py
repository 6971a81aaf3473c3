"""`profiles.csv`: tractions, slip and dissipation along y = 0 at the end of steps, in SI."""

import csv
from collections.abc import Iterator
from pathlib import Path

from contact_results.centre_line import along_centre_line
from contact_results.directory.file_names import PROFILES
from semi_analytical import Increment, Result

COLUMNS = ("step", "x", "y", "pressure", "shear_x", "shear_y", "slip_x", "slip_y", "dissipation")


def write_profiles(result: Result, directory: Path) -> None:
    """Write one row per cell of the line y = 0 and per loading step.

    Numbers have as many digits as it takes to read the same number again; the columns of an
    effect that is off are empty.
    """
    x = result.grid.x.tolist()
    with open(directory / PROFILES, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        for step in result.steps:
            table.writerows(_rows(step, x))


def _rows(step: Increment, x: list[float]) -> Iterator[tuple[object, ...]]:
    nothing: list[object] = [""] * len(x)
    pressure = along_centre_line(step.pressure).tolist()
    shear = [nothing] * 2 if step.shear is None else along_centre_line(step.shear).tolist()
    slip = [nothing] * 2 if step.slip is None else along_centre_line(step.slip).tolist()
    lost = nothing if step.dissipation is None else along_centre_line(step.dissipation).tolist()
    for values in zip(x, pressure, *shear, *slip, lost, strict=True):
        yield (step.step, values[0], 0.0, *values[1:])
