"""Tractions at own points, as strangers write them: a table for each level and loading step."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from contact_results.directory.refusal import Refused
from verification.challenge.answer import Field, Key
from verification.challenge.answer_files import IN_ONE, columns_are_there, records, text_of
from verification.challenge.export import FIELD_COLUMNS, FIELDS, IN_PASCAL, LEVELS
from verification.challenge.requested_quantities import Challenge

Columns = Mapping[str, Any]  # numbers by the head of their column


def read_fields(
    folder: Path, challenge: Challenge, levels: Mapping[str, Any]
) -> dict[str, dict[Key, Field]]:
    """By level, quantity and loading step. Raises Refused."""
    found: dict[str, dict[Key, Field]] = {}
    in_one = (folder / IN_ONE).exists()
    for where, level, step, columns in (_in_json if in_one else _in_files)(folder):
        if level not in levels or not step.isdigit():
            raise Refused(
                f"{where}: level {level!r} and load_step {step!r}, expected a level of {LEVELS} "
                f"({', '.join(levels)}) and a whole number"
            )
        here = [f.quantity for f in challenge.fields if f.step == int(step)]
        if not here:
            steps = ", ".join(dict.fromkeys(str(f.step) for f in challenge.fields))
            raise Refused(
                f"{where}: no traction of step {step} is asked, but of step {steps or 'none'}"
            )
        columns_are_there(where, list(columns), FIELD_COLUMNS)
        quantities = [q for q in here if f"{q}{IN_PASCAL}" in columns]
        if not quantities:
            expected = " or ".join(f"'{q}{IN_PASCAL}'" for q in here)
            there = ", ".join(map(repr, columns))
            raise Refused(
                f"{where}: no traction of step {step}, expected {expected}; there is {there}"
            )
        for quantity in quantities:
            names = (*FIELD_COLUMNS[:2], f"{quantity}{IN_PASCAL}", FIELD_COLUMNS[2])
            try:
                field = Field(*(np.asarray(columns[name], dtype=float) for name in names))
            except (ValueError, TypeError) as error:
                raise Refused(f"{where}: {error}") from None
            found.setdefault(level, {})[quantity, int(step)] = field
    return found


def _in_files(folder: Path) -> Iterator[tuple[str, str, str, Columns]]:
    """Place, level, loading step, columns."""
    tables = folder / FIELDS
    for path in sorted(tables.glob("*")) if tables.is_dir() else ():
        level, _, step = path.stem.rpartition("_")
        if path.suffix != ".csv" or not level:
            raise Refused(f"{path}: expected LEVEL_STEP.csv, with a level of {LEVELS}")
        head, _, rest = text_of(path).partition("\n")
        header = [name.strip() for name in head.split(",")]
        columns_are_there(f"{path}:1", header, FIELD_COLUMNS)
        lines = rest.splitlines()
        try:
            table = np.loadtxt(lines, delimiter=",", ndmin=2) if any(lines) else np.zeros((0, 0))
            if table.shape[1] not in (0, len(header)):
                raise ValueError(f"{table.shape[1]} numbers a row, expected {len(header)}")
        except ValueError as error:
            reason = str(error).partition("; use `usecols`")[0]
            raise Refused(f"{path}, below its head: {reason}") from None
        columns = table.T if table.size else np.zeros((len(header), 0))
        yield f"{path}:1", level, step, dict(zip(header, columns, strict=True))


def _in_json(folder: Path) -> Iterator[tuple[str, str, str, Columns]]:
    for where, record in records(folder, FIELDS):
        columns = {k: v for k, v in record.items() if k not in ("level", "load_step")}
        yield where, str(record.get("level", "")), str(record.get("load_step", "")), columns
