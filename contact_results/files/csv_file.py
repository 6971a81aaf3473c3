"""CSV tables: a header of names with units, such as `peak_pressure [Pa]`, then numbers in SI.

There are no comment lines, because pandas, Excel, MATLAB and numpy treat them differently. A second
table has one row for every column, with its meaning and sign.
"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from contact_scene.quantities.field_metadata import CONVENTION, Reported


@dataclass(frozen=True)
class Column:
    """Column of a CSV table: name, unit and meaning.

    name     name of the column, without the unit
    unit     SI unit, empty if dimensionless; None for words and for row numbers
    meaning  one sentence for the table of column meanings
    """

    name: str
    unit: str | None
    meaning: str

    @property
    def header(self) -> str:
        """Name and unit, as in the first line of the table: `peak_pressure [Pa]`."""
        return self.name if self.unit is None else f"{self.name} [{self.unit or '1'}]"


STEP = Column("step", None, "Loading step, from 1.")


def reported_column(name: str, mark: Reported, prefix: str = "") -> Column:
    """Create the table column of a value whose unit and meaning are declared in the code.

    name    name of the column
    mark    unit and meaning of the value
    prefix  text in front of the meaning
    """
    return Column(name, mark.unit, prefix + mark.meaning)


def write_table(path: Path, columns: Sequence[Column], rows: Iterable[Sequence[object]]) -> None:
    """Write a CSV table.

    columns  columns of the table, for its first line
    rows     cells of each row; None is an empty cell, and numbers are written without loss of
             digits
    """
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(column.header for column in columns)
        table.writerows(rows)


def write_meanings(
    path: Path, files: Mapping[str, Sequence[Column]], convention: str = CONVENTION
) -> None:
    """Write the table with the units and meanings of the columns of other tables.

    The first row is the convention of axes and signs. One row follows for each column of each file.

    path        path of the table of meanings
    files       columns of each described file, by file name
    convention  text about units, axes and signs
    """
    head = [Column(name, None, "") for name in ("file", "column", "unit", "meaning")]
    rows = [
        (file, column.name, "" if column.unit is None else column.unit or "1", column.meaning)
        for file, columns in files.items()
        for column in columns
    ]
    write_table(path, head, [("all", "", "SI", convention), *rows])
