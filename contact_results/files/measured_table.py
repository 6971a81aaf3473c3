"""Reader of measured tables: columns of known names, converted to SI."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contact_results.files.csv_file import WITH_UNIT
from contact_scene.reading import units
from contact_scene.reading.units import (
    Kind,
)

SHIFT, ACTUATOR = "tangential_shift", "actuator_shift"
LOAD, PLACE, PRESSURE, SHEAR = "tangential_force", "x", "pressure", "shear"
# Accepted names of a column, in lower case, including those of increments.csv and profiles.csv.
NAMES: Mapping[str, tuple[Kind, frozenset[str]]] = {
    SHIFT: (
        units.LENGTH,
        frozenset({"shift", "delta", "δ", "tangential_shift", "tangential_shift_x"}),
    ),
    ACTUATOR: (units.LENGTH, frozenset({"actuator_shift", "actuator_shift_x", "delta*", "δ*"})),
    LOAD: (units.FORCE, frozenset({"t", "f", "force", "tangential_force", "tangential_force_x"})),
    PLACE: (units.LENGTH, frozenset({"x"})),
    PRESSURE: (units.PRESSURE, frozenset({"p", "pressure"})),
    SHEAR: (units.PRESSURE, frozenset({"q", "shear", "shear_x"})),
}


def read_measured(path: Path) -> Mapping[str, NDArray[np.float64]]:
    """Read the columns with known names from a CSV table of measured values, in SI units.

    Other columns are ignored. The head of a column contains its name and unit, such as `force [N]`.
    NAMES lists the known names.

    Returns the values of each column by the name of the quantity.

    Raises ValueError for an unknown unit, and for values that are not finite numbers.
    """
    (heads, *rows), found = _read_cells(path), {}
    for position, head in enumerate(heads):
        split = WITH_UNIT.fullmatch(head.strip())
        name = (split["name"] if split else head).strip().lower()
        known = [(mine, kind) for mine, (kind, names) in NAMES.items() if name in names]
        if not known:
            continue
        ((mine, kind),) = known
        factor = kind.units.get(split["unit"] if split else "")
        if factor is None:
            raise ValueError(
                f"{path}: got the column {head!r}, expected a unit of {kind.si}; write "
                f"'{name} [{kind.si}]'"
            )
        try:
            found[mine] = float(factor) * np.array([row[position] for row in rows], dtype=float)
        except ValueError as error:
            raise ValueError(f"{path}: column {head!r}: {error}; write numbers only") from None
        if not np.all(np.isfinite(found[mine])):
            raise ValueError(f"{path}: column {head!r} has values that are not finite; remove them")
    return found


def _read_cells(path: Path) -> list[list[str]]:
    """Read the cells of a CSV table as texts: one list per row, with the header first.

    Raises ValueError if the file is not a CSV table, is empty, or has rows of unequal length.
    """
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file, strict=True))
    except (UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"{path} is not a table: {error}") from None
    if not rows:
        raise ValueError(f"{path} is empty; expected a line of column names")
    for number, row in enumerate(rows, 1):
        if len(row) != len(rows[0]):
            raise ValueError(
                f"{path}:{number}: the number of values between commas is {len(row)}, expected "
                f"{len(rows[0])} as in the first line"
            )
    return rows
