"""Rows: what a study measures, one observation each, so that any rule, table or diagram reads it.

A case leaves one row. What it saw on its way (increments, points of a profile, verdicts) are the
row's parts, rows themselves.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields, is_dataclass
from enum import Enum
from typing import Any, ClassVar, Protocol, Self, TypeVar

from pydantic import Field

from contact_scene.reading.description import Description

Value = str | bool | int | float | None


class Row(Description):
    """One observation."""

    parameters: dict[str, Value] = Field(default_factory=dict)
    """What it is of: what was asked for."""

    measures: dict[str, float | None] = Field(default_factory=dict)
    """What was measured; null where it is not finite or not known."""

    units: dict[str, str] = Field(default_factory=dict)
    """Of the measures that have one."""

    counters: dict[str, int] = Field(default_factory=dict)
    """What was counted: the same at every run."""

    words: dict[str, str] = Field(default_factory=dict)
    """What was said: kinds of ends, reasons."""

    def number(self, name: str) -> float | None:
        """A measure, a counter or a parameter that is a number; None without one. What was asked
        for goes before what was counted under the same name."""
        known: Any = {**self.measures, **self.counters, **self.parameters}.get(name)
        return None if isinstance(known, str) else known


def value_of(row: Row, name: str) -> float:
    """A measure that is known; KeyError if the row lacks it, ValueError if it is null."""
    value = row.measures[name]
    if value is None:
        raise ValueError(f"{name} is not known of {row.parameters}")
    return value


class CaseRecord(Row):
    """What a case of a study leaves, whatever it computes."""

    parts: tuple[Row, ...] = ()
    """What it saw on its way."""

    seconds: float = 0.0
    """CPU time, of the worker's whole work where the case measures none; with `repeats`, all that
    differs between equal runs."""

    clock: dict[str, float] = Field(default_factory=dict)
    """CPU seconds of its parts by name, which no run repeats either."""

    repeats: int = 1
    """Solves of which `seconds` is the median."""


class TypedRow(Description):
    """A row whose names and types are known. Of its fields texts and members of enumerations are
    kept as words, whole numbers and what is true or not as counters, other numbers as measures."""

    PARAMETERS: ClassVar[tuple[str, ...]] = ()
    """Fields that say what it is of."""

    UNITS: ClassVar[Mapping[str, str]] = {}

    def row(self) -> Row:
        """As it is kept."""
        values = self.model_dump(mode="json")
        parameters = {name: values.pop(name) for name in self.PARAMETERS}
        words = {name: value for name, value in values.items() if isinstance(value, str)}
        counters = {name: int(value) for name, value in values.items() if isinstance(value, int)}
        return Row(
            parameters=parameters,
            measures={n: v for n, v in values.items() if n not in words and n not in counters},
            units={name: unit for name, unit in self.UNITS.items() if name in values},
            counters=counters,
            words=words,
        )

    @classmethod
    def of(cls, row: Row) -> Self:
        """Back from its row."""
        known: dict[str, Any] = {**row.parameters, **row.measures, **row.counters, **row.words}
        return cls.model_validate({name: known[name] for name in cls.model_fields if name in known})


class Named(Protocol):
    """A case, by what its record is found."""

    @property
    def name(self) -> str: ...


C = TypeVar("C", bound=Named)


def found(cases: Iterable[C], records: Mapping[str, CaseRecord]) -> dict[C, CaseRecord]:
    """The records that there are, by case, in the order of the cases."""
    return {case: records[case.name] for case in cases if case.name in records}


def rows_of(cases: Iterable[C], known: Mapping[C, CaseRecord]) -> list[CaseRecord]:
    """Of these cases, those that have one."""
    return [known[case] for case in cases if case in known]


def parameters_of(case: Any) -> dict[str, Value]:
    """The plain values that a case is made of, by the names of its fields."""
    values: dict[str, Value] = {}
    for field in fields(case):
        value = getattr(case, field.name)
        if is_dataclass(value):
            values |= parameters_of(value)
        elif isinstance(value, Enum):
            values[field.name] = value.value
        elif isinstance(value, tuple):
            values[field.name] = " x ".join(map(str, value))
        else:
            values[field.name] = value
    return values


ROWS, PARTS, FINDINGS, SECONDS = "rows.csv", "parts.csv", "findings.csv", "seconds.csv"

CASE = "case name"  # a column that no parameter can have: fields of cases have no space

Cells = Mapping[str, object]


def row_files(records: Mapping[str, CaseRecord], findings: Sequence[Row] = ()) -> dict[str, str]:
    """By file name: `rows.csv`, one line for every case; `parts.csv`, one for every part of one;
    `findings.csv`, one for every row of a conclusion; `seconds.csv` with what the clock said.
    Without those that would be empty."""
    clock = [(name, record.seconds, record.repeats) for name, record in records.items()]
    files: dict[str, Sequence[Cells]] = {
        ROWS: _named(records.items()),
        PARTS: _named((name, part) for name, record in records.items() for part in record.parts),
        FINDINGS: [_cells(row) for row in findings],
        SECONDS: [dict(zip((CASE, "seconds", "repeats"), line, strict=True)) for line in clock],
    }
    return {name: _text(lines) for name, lines in files.items() if lines}


def _named(rows: Iterable[tuple[str, Row]]) -> list[Cells]:
    """By name of the case that they are of."""
    return [{CASE: name, **_cells(row)} for name, row in rows]


def _cells(row: Row) -> Cells:
    """Parameters by their name, measures as name [unit], counters as name [count], words."""
    return {
        **row.parameters,
        **{f"{name} [{row.units.get(name, '1')}]": v for name, v in row.measures.items()},
        **{f"{name} [count]": count for name, count in row.counters.items()},
        **row.words,
    }


def _text(lines: Iterable[Cells]) -> str:
    """A column for every name that any line has."""
    lines = tuple(lines)
    text = io.StringIO()
    head = dict.fromkeys(name for line in lines for name in line)
    table = csv.DictWriter(text, head, lineterminator="\n")
    table.writeheader()
    table.writerows(lines)
    return text.getvalue()
