"""Columns of tables whose lines are rows, and the points that a diagram draws of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from verification.exhibits.log_chart import Points, drawable
from verification.exhibits.numbers import plain
from verification.running.row import Row

Text = Callable[[Row], str]


def number(name: str, digits: int = 2) -> Text:
    """The column of a number."""
    return lambda row: plain(row.number(name), digits)


def points(rows: Iterable[Row], x: str, y: str) -> Points:
    """One number against another, on logarithmic axes."""
    return drawable((row.number(x), row.number(y)) for row in rows)
