"""Tables read back: arrays by the names of columns, with units and meanings."""

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
    """An array as it is stored.

    unit     in SI; empty if dimensionless, and of words
    indices  what each index counts: increment, component, or a name of the coordinates; of a table
             row. Empty where the file, of an earlier version, does not say
    """

    array: NDArray[Any]
    unit: str
    meaning: str
    indices: tuple[str, ...] = ()


StoredTable = Mapping[str, StoredValues]


class StoredTables(Mapping[str, StoredTable]):
    """Those of the tables of a directory that are there, by the names of their files without
    ending; each is read when it is asked for."""

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
    """The columns of a table: whole numbers, numbers with NaN for what is empty, or words.

    Raises ValueError for what is no table of ours, or one of a version that named no units.
    """
    header, *rows = read_cells(path)
    columns = list(zip(*rows, strict=True)) or [()] * len(header)
    found = {}
    for heading, cells in zip(header, columns, strict=True):
        split = WITH_UNIT.fullmatch(heading)
        name, unit = (heading, "") if split is None else (split["name"], split["unit"])
        if name not in meanings:
            raise ValueError(
                f"{path}: column {heading!r} is not among those that the table of columns beside "
                "it explains; the files are of different or earlier versions, write them again"
            )
        try:
            array = _numbers(cells) if split else _labels(cells)
        except ValueError as error:
            raise ValueError(f"{path}: column {heading!r}: {error}") from None
        found[name] = StoredValues(array, "" if unit == "1" else unit, meanings[name], ("row",))
    return found


def read_meanings(path: Path, file: str) -> Mapping[str, str]:
    """What the columns of one file mean, by name; raises ValueError where nothing says so."""
    if not path.is_file():
        raise ValueError(
            f"{path} is missing, which says what the columns of {file} are: the files are of an "
            "earlier version; write them again"
        )
    _, *rows = read_cells(path)
    return {name: meaning for of, name, _, meaning in rows if of == file}


def read_cells(path: Path) -> list[list[str]]:
    """Read the texts of a table, the line of names first; raises ValueError for what is none."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file, strict=True))
    except (UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"{path} is no table: {error}") from None
    if not rows:
        raise ValueError(f"{path} is empty; a line of names is expected")
    for number, row in enumerate(rows, 1):
        if len(row) != len(rows[0]):
            raise ValueError(
                f"{path}:{number}: {len(row)} values, expected {len(rows[0])} as in the first line"
            )
    return rows


def _numbers(cells: Sequence[str]) -> NDArray[Any]:
    return np.array([float(cell or "nan") for cell in cells], dtype=np.float64)


def _labels(cells: Sequence[str]) -> NDArray[Any]:
    whole = all(cell.isascii() and cell.isdigit() for cell in cells)
    return np.array([int(cell) for cell in cells] if whole else cells)
