"""Reader of CSV tables: arrays by column name, with units and meanings."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_results.files.csv_file import WITH_UNIT


@dataclass(frozen=True, eq=False)
class StoredValues:
    """Array read from a file, with unit and meaning.

    array    the values
    unit     SI unit; empty if dimensionless, and for words
    meaning  one sentence about the values
    indices  meaning of each array index: increment, step, component, row, or the name of a
             coordinate; empty if the file does not state them
    """

    array: NDArray[Any]
    unit: str
    meaning: str
    indices: tuple[str, ...] = ()


StoredTable = Mapping[str, StoredValues]


class StoredTables(Mapping[str, StoredTable]):
    """Existing CSV tables of a directory by file name without suffix; a table is read on access.

    directory  directory of the tables
    names      names of the files that the directory may contain
    meanings   name of the table with the meanings of all columns
    """

    def __init__(self, directory: Path, names: Sequence[str], meanings: str) -> None:
        self._paths = {
            Path(name).stem: directory / name for name in names if (directory / name).is_file()
        }
        self._meanings = directory / meanings

    def __getitem__(self, name: str) -> StoredTable:
        if name not in self._paths:
            raise KeyError(f"{self._meanings.parent} has no table {name!r}: {(*self._paths,)}")
        path = self._paths[name]
        return read_table(path, read_meanings(self._meanings, path.name))

    def __iter__(self) -> Iterator[str]:
        return iter(self._paths)

    def __len__(self) -> int:
        return len(self._paths)


def read_table(path: Path, meanings: Mapping[str, str]) -> StoredTable:
    """Read a CSV table as arrays by column name, with units and meanings.

    A column contains integers, numbers with NaN for empty cells, or words.

    meanings  meaning of each column, by name

    Raises ValueError if the file is no table of slipstick or has a column without meaning.
    """
    header, *rows = read_cells(path)
    columns = list(zip(*rows, strict=True)) or [()] * len(header)
    found = {}
    for heading, cells in zip(header, columns, strict=True):
        split = WITH_UNIT.fullmatch(heading)
        name, unit = (heading, "") if split is None else (split["name"], split["unit"])
        if name not in meanings:
            raise ValueError(
                f"{path}: column {heading!r} has no entry in the table of columns: the files are "
                "of different or earlier versions; write them again"
            )
        try:
            array = _numbers(cells) if split else _labels(cells)
        except ValueError as error:
            raise ValueError(f"{path}: column {heading!r}: {error}") from None
        found[name] = StoredValues(array, "" if unit == "1" else unit, meanings[name], ("row",))
    return found


def read_meanings(path: Path, file: str) -> Mapping[str, str]:
    """Read the meanings of the columns of one CSV table, by column name.

    path  path of the table of meanings
    file  name of the described table

    Raises ValueError if the table of meanings is missing.
    """
    if not path.is_file():
        raise ValueError(
            f"{path} with the meanings of the columns of {file} is missing: the files are of an "
            "earlier version; write them again"
        )
    _, *rows = read_cells(path)
    return {name: meaning for of, name, _, meaning in rows if of == file}


def read_cells(path: Path) -> list[list[str]]:
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
                f"{path}:{number}: {len(row)} values, expected {len(rows[0])} as in the first line"
            )
    return rows


def _numbers(cells: Sequence[str]) -> NDArray[Any]:
    """Convert the cells of a column to numbers; an empty cell becomes NaN."""
    return np.array([float(cell or "nan") for cell in cells], dtype=np.float64)


def _labels(cells: Sequence[str]) -> NDArray[Any]:
    """Convert the cells of a column to integers if all are integers; else keep the words."""
    whole = all(cell.isascii() and cell.isdigit() for cell in cells)
    return np.array([int(cell) for cell in cells] if whole else cells)
