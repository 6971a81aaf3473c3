"""Rows as comma-separated text: every study has it."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence

from contact_scene.description import Description
from verification.running.row import CaseRecord, Row

ROWS, PARTS, SECONDS = "rows.csv", "parts.csv", "seconds.csv"


def row_files(records: Mapping[str, Description]) -> dict[str, str]:
    """`rows.csv`, one line for every case; `parts.csv`, one for every part of one, where there
    are any; `seconds.csv` with what the clock said. By file name; nothing without a record."""
    known = {name: r for name, r in records.items() if isinstance(r, CaseRecord)}
    if not known:
        return {}
    parts = [(name, part) for name, record in known.items() for part in record.parts]
    clock = [(name, record.seconds, record.repeats) for name, record in known.items()]
    return {
        ROWS: row_text(known.items()),
        **({PARTS: row_text(parts)} if parts else {}),
        SECONDS: _text(("case", "seconds", "repeats"), clock),
    }


def row_text(rows: Iterable[tuple[str, Row]]) -> str:
    """A line for every row, by name of its case; a column for every name that any of them has:
    parameters by their name, measures as name [unit], counters as name [count], words."""
    lines = [(name, _cells(row)) for name, row in rows]
    head = dict.fromkeys(column for _, cells in lines for column in cells)
    return _text(("case", *head), [(name, *map(cells.get, head)) for name, cells in lines])


def _cells(row: Row) -> Mapping[str, object]:
    return {
        **row.parameters,
        **{f"{name} [{row.units.get(name, '1')}]": v for name, v in row.measures.items()},
        **{f"{name} [count]": count for name, count in row.counters.items()},
        **row.words,
    }


def _text(head: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerows([head, *rows])
    return text.getvalue()
