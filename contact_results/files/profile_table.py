"""`profiles.csv`: tractions, slip and dissipation along y = 0 at the end of steps, in SI."""

import csv
from collections.abc import Iterator
from pathlib import Path

from contact_results.directory.file_names import PROFILES
from contact_results.surface import Surface, surface_of
from semi_analytical import Increment, Result

COLUMNS = ("step", "x", "y", "pressure", "shear_x", "shear_y", "slip_x", "slip_y", "dissipation")


def write_profiles(result: Result, directory: Path) -> None:
    """Write one row per cell of the line y = 0 and per loading step.

    Numbers have as many digits as it takes to read the same number again; the columns of an
    effect that is off are empty.
    """
    surface = surface_of(result)
    x = result.grid.x.tolist()
    with open(directory / PROFILES, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        for step in result.steps:
            table.writerows(_rows(step, surface, x))


def _rows(step: Increment, surface: Surface, x: list[float]) -> Iterator[tuple[object, ...]]:
    nothing: list[object] = [""] * len(x)
    pressure = surface.along(step.pressure).tolist()
    shear = [nothing] * 2 if step.shear is None else surface.along(step.shear).tolist()
    slip = [nothing] * 2 if step.slip is None else surface.along(step.slip).tolist()
    lost = nothing if step.dissipation is None else surface.along(step.dissipation).tolist()
    for values in zip(x, pressure, *shear, *slip, lost, strict=True):
        yield (step.step, values[0], 0.0, *values[1:])
