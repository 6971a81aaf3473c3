"""`increments.csv`: one row per increment with its scalars, in SI."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING

from contact_results.directory.file_names import INCREMENTS
from contact_scene.increment import SCALARS, components, numbers

if TYPE_CHECKING:
    from contact_results.surface import Result

COLUMNS = ("step", "increment", *(part for name in SCALARS for part in components(name)))


def write_increments(result: Result, directory: Path) -> None:
    """Write one row per increment; what an increment does not have is empty."""
    with open(directory / INCREMENTS, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        for increment in result.increments:
            table.writerow((increment.step, increment.index, *numbers(increment).values()))
