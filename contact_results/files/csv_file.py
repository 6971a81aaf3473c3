"""Tables as CSV: one line of names with units, such as `peak_pressure [Pa]`, then numbers in SI.

No line says anything else: pandas, Excel, MATLAB and numpy take the first line for the names, and
each stumbles in its own way over what comes before it, be it behind a #. Meanings and signs are in
a second table beside, in which every column has a row.
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

    unit  in SI, empty if dimensionless; None for words and for numbers that count or name a row
    """

    name: str
    unit: str | None
    meaning: str

    @property
    def header(self) -> str:
        """The name as the table has it, with its unit."""
        return self.name if self.unit is None else f"{self.name} [{self.unit or '1'}]"


WITH_UNIT = re.compile(r"(?P<name>.*) \[(?P<unit>[^\[\]]*)\]")  # `Column.header` read again
STEP = Column("step", None, "Loading step, from 1.")


def marked(name: str, mark: Reported, what: str = "") -> Column:
    """The column of a value that is reported."""
    return Column(name, mark.unit, what + mark.meaning)


def write_table(path: Path, columns: Sequence[Column], rows: Iterable[Sequence[object]]) -> None:
    """Write a table whole or not at all; None is an empty cell. Numbers have as many digits as it
    takes to read the same number again."""
    with atomic_file(path) as temporary, open(temporary, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(column.header for column in columns)
        table.writerows(rows)


def write_meanings(
    path: Path, files: Mapping[str, Sequence[Column]], convention: str = CONVENTION
) -> None:
    """Write what the columns of files mean: the convention of all of them, then a row for each."""
    head = [Column(name, None, "") for name in ("file", "column", "unit", "meaning")]
    rows = [
        (file, column.name, "" if column.unit is None else column.unit or "1", column.meaning)
        for file, columns in files.items()
        for column in columns
    ]
    write_table(path, head, [("all", "", "SI", convention), *rows])
