"""A table of a report, as a person reads it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TypeVar

from contact_scene.reading.description import Description
from contact_scene.reading.engineering_units import engineering_unit

NOT_FINITE = "not finite"


def value_text(value: float | None, unit: str, digits: int = 6) -> str:
    """A value with its unit."""
    if value is None:
        return NOT_FINITE
    if value == 0:
        return "0"
    if unit in ("", "°"):
        return plain(value, digits) + unit
    scale = engineering_unit(abs(value), unit)
    return f"{value / scale.size:#.{digits}g}".rstrip(".") + f" {scale.name}"


def plain(value: float | None, digits: int = 3) -> str:
    """A number without unit: 0.0123, 1.2e-5."""
    if value is None:
        return NOT_FINITE
    mantissa, e, exponent = f"{value:.{digits}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def percent(part: float) -> str:
    """A part of something, in hundredths."""
    return f"{plain(100 * part, 2)} %"


NOT_REACHED = "–"


EXTRAPOLATED = "≈"  # before a cost that no setting was tried for


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
