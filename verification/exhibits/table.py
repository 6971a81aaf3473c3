"""A table of a report, as a person reads it."""

from collections.abc import Callable, Iterable, Mapping
from typing import TypeVar

from contact_scene.description import Description

T = TypeVar("T")


class Table(Description):
    """Rows of texts; the first column names the row."""

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""
    """What to see in it."""
    name: str = ""
    """By which it is found, where somebody looks for it."""


def table_of(
    title: str, columns: Mapping[str, Callable[[T], str]], items: Iterable[T], note: str = ""
) -> Table:
    """A line for every item; columns by their heads, the first one names the line."""
    return Table(
        title=title,
        columns=tuple(columns),
        rows=tuple(tuple(text(item) for text in columns.values()) for item in items),
        note=note,
    )
