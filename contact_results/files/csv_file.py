"""CSV tables: a header of names with units, such as `peak_pressure [Pa]`, then numbers in SI.

There are no comment lines, because pandas, Excel, MATLAB and numpy treat them differently. A second
table has one row for every column, with its meaning and sign.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from contact_results.directory.atomic_file import atomic_file
from contact_scene.quantities.field_metadata import CONVENTION, Reported


@dataclass(frozen=True)
class Column:
    """A column of a table.

    unit  SI unit, empty if dimensionless; None for words and for row numbers
    """

    name: str
    unit: str | None
    meaning: str

    @property
    def header(self) -> str:
        """Name and unit, as in the first line of the table."""
        return self.name if self.unit is None else f"{self.name} [{self.unit or '1'}]"


WITH_UNIT = re.compile(r"(?P<name>.*) \[(?P<unit>[^\[\]]*)\]")  # inverse of `Column.header`
STEP = Column("step", None, "Loading step, from 1.")


def marked(name: str, mark: Reported, prefix: str = "") -> Column:
    """Return the column of a reported value."""
    return Column(name, mark.unit, prefix + mark.meaning)


def write_table(path: Path, columns: Sequence[Column], rows: Iterable[Sequence[object]]) -> None:
    """Write a table atomically. None is an empty cell; numbers are written without loss."""
    with atomic_file(path) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(column.header for column in columns)
        table.writerows(rows)


def write_meanings(
    path: Path, files: Mapping[str, Sequence[Column]], convention: str = CONVENTION
) -> None:
    """Write the table of meanings: the convention, then a row for each column of each file."""
    head = [Column(name, None, "") for name in ("file", "column", "unit", "meaning")]
    rows = [
        (file, column.name, "" if column.unit is None else column.unit or "1", column.meaning)
        for file, columns in files.items()
        for column in columns
    ]
    write_table(path, head, [("all", "", "SI", convention), *rows])
