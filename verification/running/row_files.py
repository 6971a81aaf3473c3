"""Rows as comma-separated text: every study has it."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence

from verification.running.row import CaseRecord, Row

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
