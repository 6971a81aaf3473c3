"""`increments.csv`: one row per increment with its scalars."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from contact_results.directory.file_names import INCREMENTS
from contact_results.files.csv_file import STEP, Column, marked, write_table
from contact_scene.increment import SCALARS, components, numbers

if TYPE_CHECKING:
    from contact_results.surface import Result

COLUMNS = (
    STEP,
    Column("increment", None, "Increment within the step, from 1."),
    *(marked(part, mark) for name, mark in SCALARS.items() for part in components(name)),
)


def write_increments(result: Result, directory: Path) -> None:
    """Write one row per increment; what an increment does not have is empty."""
    rows = ((i.step, i.index, *numbers(i).values()) for i in result.increments)
    write_table(directory / INCREMENTS, COLUMNS, rows)
