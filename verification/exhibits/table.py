"""A table of a report, as a person reads it."""

from collections.abc import Callable, Iterable, Mapping
from typing import TypeVar

from contact_scene.reading.description import Description

T = TypeVar("T")
NONE: Mapping[str, str] = {}  # units: every number is a count or a ratio


class Table(Description):
    """Rows of texts; the first column names the row."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""
    """What to see in it."""
    name: str = ""
    """By which it is found, where somebody looks for it."""
    units: Mapping[str, str] | None = None
    """By column, of numbers that have one; all others have none. None in a record of before units
    were named, of which nothing is known."""


def table_of(
    title: str,
    columns: Mapping[str, Callable[[T], str]],
    items: Iterable[T],
    note: str = "",
    units: Mapping[str, str] = NONE,
) -> Table:
    """A line for every item; columns by their heads, the first one names the line."""
    return Table(
        title=title,
        columns=tuple(columns),
        rows=tuple(tuple(text(item) for text in columns.values()) for item in items),
        note=note,
        units=units,
    )
