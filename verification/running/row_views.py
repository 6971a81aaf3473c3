"""Tables of rows, and the points that a diagram draws of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from verification.exhibits.log_chart import Points, drawable
from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.running.row import Row

Text = Callable[[Row], str]


def row_table(
    title: str, columns: Mapping[str, Text], rows: Iterable[Row], note: str = ""
) -> Table:
    """A line for every row; columns by their heads, the first one names the row."""
    return Table(
        title=title,
        columns=tuple(columns),
        rows=tuple(tuple(text(row) for text in columns.values()) for row in rows),
        note=note,
    )


def number(name: str, digits: int = 2) -> Text:
    """The column of a number."""
    return lambda row: plain(row.number(name), digits)


def points(rows: Iterable[Row], x: str, y: str) -> Points:
    """One number against another, on logarithmic axes."""
    return drawable((row.number(x), row.number(y)) for row in rows)
