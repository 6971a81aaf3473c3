"""Data records of charts and tables of a verification report, and texts of its numbers.

The records are independent of the drawing, which `verification.report` does.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from enum import StrEnum
from math import isfinite
from typing import TypeVar

from contact_scene.reading.description import Description
from contact_scene.reading.engineering_units import engineering_unit

DIGITS = 6  # of a plotted number: far finer than a pixel, and equal on every machine


class Look(StrEnum):
    """Meaning of a curve in a chart; the drawing derives line style and markers from it."""

    COMPUTED = "computed"
    POINTS = "points"
    REFERENCE = "reference"
    BOUND = "bound"
    SLOPE = "slope"
    LEVELS = "levels"  # points of a refinement, not joined
    FITTED = "fitted"
    BAND = "band"  # the outline of an area
    MARKS = "marks"
    TILES = "tiles"  # places of a map that belong to one class


class Curve(Description):
    """Points of a curve in a chart. Curves with the same `series` have the same colour."""

    label: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    look: Look = Look.COMPUTED
    series: int = 0


class Panel(Description):
    """One pair of axes of a chart, with its curves and labels."""

    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    title: str = ""
    logarithmic: bool = False
    least_range: float = 1.0
    """Smallest ratio of the ends of a logarithmic x axis, such as 10 for times of chance."""

    height: float = 1.0
    notes: tuple[tuple[float, float, str], ...] = ()
    """Short texts at (x, y)."""

    x_places: tuple[str, ...] = ()
    """Names of the positions 0, 1, … along x, for an axis without numbers."""

    y_places: tuple[str, ...] = ()
    """Names of the positions 0, 1, … along y, for an axis without numbers."""


class Chart(Description):
    """A figure of a report: rows of panels with title and caption, without the drawing.

    Panels in one column share their x axis.
    """

    name: str
    title: str
    caption: str
    """Description of the chart in words, also for screen readers."""

    rows: tuple[tuple[Panel, ...], ...]


def curve(
    label: str,
    x: Iterable[float],
    y: Iterable[float],
    look: Look = Look.COMPUTED,
    series: int = 0,
) -> Curve:
    """Create the record of a chart curve; coordinates are rounded to 6 significant digits.

    label   text of the legend; empty for none
    x, y    coordinates of the points (points,)
    look    meaning of the curve, such as computed or reference, which determines its line style
    series  number that determines its colour
    """
    return Curve(
        label=label, x=_rounded_coordinates(x), y=_rounded_coordinates(y), look=look, series=series
    )


def _rounded_coordinates(values: Iterable[float]) -> tuple[float, ...]:
    return tuple(float(f"{value:.{DIGITS}g}") for value in values)


def stacked(name: str, title: str, caption: str, *rows: Panel | tuple[Panel, ...]) -> Chart:
    """Create a chart of panels one above the other, where a tuple of panels is placed side by side.

    name     identifier of the chart
    rows     panels, from top to bottom
    """
    beside = tuple(row if isinstance(row, tuple) else (row,) for row in rows)
    return Chart(name=name, title=title, caption=caption, rows=beside)


HEIGHT = 2.4

Points = Sequence[tuple[float, float]]


def log_chart(
    name: str,
    title: str,
    caption: str,
    x_label: str,
    y_label: str,
    curves: Iterable[Curve],
    *,
    height: float = HEIGHT,
) -> Chart:
    """Create a chart of one panel with logarithmic axes, for instance for errors against cell size.

    x_label, y_label  labels of the axes
    height            height of the panel; the unit is 1.5 inches
    """
    panel = Panel(
        x_label=x_label,
        y_label=y_label,
        curves=tuple(curves),
        logarithmic=True,
        height=height,
    )
    return stacked(name, title, caption, panel)


def drawable(points: Iterable[tuple[float | None, float | None]]) -> Points:
    """Return the points (x, |y|) of a curve that logarithmic axes can show.

    Points with a zero, unknown or non-finite coordinate are removed.
    """
    return [(x, abs(y)) for x, y in points if x and y and isfinite(x) and isfinite(y)]


def point_curves(lines: Iterable[tuple[str, Points]], look: Look = Look.POINTS) -> list[Curve]:
    """Create one chart curve for each label that has points.

    lines  pairs of a label and its points (x, y); the position in the list selects the colour
    look   style of all curves
    """
    return [
        curve(label, [x for x, _ in points], [y for _, y in points], look, series)
        for series, (label, points) in enumerate(lines)
        if points
    ]


NOT_FINITE = "not finite"


def value_text(value: float | None, unit: str, digits: int = 6) -> str:
    """Return the text of a value with its unit and an engineering prefix, such as "1.23 µm".

    The text is "not finite" for None.

    unit    SI unit; empty for a number without unit
    digits  number of significant digits
    """
    if value is None:
        return NOT_FINITE
    if value == 0:
        return "0"
    if unit in ("", "°"):
        return plain(value, digits) + unit
    scale = engineering_unit(abs(value), unit)
    text = f"{value / scale.size:#.{digits}g}".rstrip(".")
    if "e-" in text:
        text = plain(float(text), digits)
    return f"{float(text):.0f} {scale.name}" if "e+" in text else f"{text} {scale.name}"


def plain(value: float | None, digits: int = 3) -> str:
    """Return the text of a number without unit, such as 0.0123 or 1.2e-5.

    The text is "not finite" for None.

    digits  number of significant digits
    """
    if value is None:
        return NOT_FINITE
    mantissa, e, exponent = f"{value:.{digits}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


T = TypeVar("T")
NONE: Mapping[str, str] = {}  # units: every number is a count or a ratio


class Table(Description):
    """Table of a report with title and headings; all cells are texts, and the first column names
    the row.
    """

    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""
    """Explanation of the table for readers."""
    name: str = ""
    """Name by which other code finds the table."""
    units: Mapping[str, str] | None = None
    """Units of the numbers by column; other columns have none. None for older records without
    units.
    """


def table_of(
    title: str,
    columns: Mapping[str, Callable[[T], str]],
    items: Iterable[T],
    note: str = "",
    units: Mapping[str, str] = NONE,
) -> Table:
    """Build the record of a report table with one row per object; the first column names the row.

    columns  by heading of the column: function that returns the text of an object
    items    objects of the rows
    note     explanation below the table
    units    units of the numbers, by heading of the column
    """
    return Table(
        title=title,
        columns=tuple(columns),
        rows=tuple(tuple(text(item) for text in columns.values()) for item in items),
        note=note,
        units=units,
    )
