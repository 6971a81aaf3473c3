"""The data of a figure, apart from how it is drawn: enough to draw it again from a file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from enum import StrEnum
from math import isfinite
from typing import TypeVar

from contact_scene.reading.description import Description
from contact_scene.reading.engineering_units import engineering_unit

DIGITS = 6  # of a plotted number: far finer than a pixel, and equal on every machine


class Look(StrEnum):
    """Meaning of a curve; the drawing chooses the line style."""

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
    """Points joined by a line. Curves of one `series` belong together and share their colour."""

    label: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    look: Look = Look.COMPUTED
    series: int = 0


class Panel(Description):
    """One pair of axes."""

    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    title: str = ""
    logarithmic: bool = False
    height: float = 1.0
    notes: tuple[tuple[float, float, str], ...] = ()
    """Short texts at (x, y)."""

    x_places: tuple[str, ...] = ()
    """Names of the places 0, 1, … along x, where these are no numbers."""

    y_places: tuple[str, ...] = ()
    """The same along y."""


class Chart(Description):
    """Rows of panels; panels above each other share their x axis."""

    name: str
    title: str
    caption: str
    """What is seen, in words: also read out to those who do not see it."""

    rows: tuple[tuple[Panel, ...], ...]


def curve(
    label: str,
    x: Iterable[float],
    y: Iterable[float],
    look: Look = Look.COMPUTED,
    series: int = 0,
) -> Curve:
    """Return a curve of rounded numbers."""
    return Curve(label=label, x=_rounded(x), y=_rounded(y), look=look, series=series)


def _rounded(values: Iterable[float]) -> tuple[float, ...]:
    return tuple(float(f"{value:.{DIGITS}g}") for value in values)


def stacked(name: str, title: str, caption: str, *rows: Panel | tuple[Panel, ...]) -> Chart:
    """Stack panels; panels of one tuple stand side by side."""
    beside = tuple(row if isinstance(row, tuple) else (row,) for row in rows)
    return Chart(name=name, title=title, caption=caption, rows=beside)


HEIGHT = 2.4
BELOW = 0.6  # slope lines run under the data, by this factor

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
    y_places: tuple[str, ...] = (),
) -> Chart:
    """Return one panel of curves.

    y_places  names of the places 0, 1, … along y, for a y axis without numbers
    """
    panel = Panel(
        x_label=x_label, y_label=y_label, curves=tuple(curves), logarithmic=True, height=height,
        y_places=y_places,
    )  # fmt: skip
    return Chart(name=name, title=title, caption=caption, rows=((panel,),))


def drawable(points: Iterable[tuple[float | None, float | None]]) -> Points:
    """The magnitudes that logarithmic axes can show: finite, not zero and known."""
    return [(x, abs(y)) for x, y in points if x and y and isfinite(x) and isfinite(y)]


def point_curves(lines: Iterable[tuple[str, Points]], look: Look = Look.POINTS) -> list[Curve]:
    """A curve for every label that has points, in the order of their mention."""
    return [
        curve(label, [x for x, _ in points], [y for _, y in points], look, series)
        for series, (label, points) in enumerate(lines)
        if points
    ]


def slope_line(points: Points, order: float) -> list[Curve]:
    """Return a line of this slope below the points; empty without points."""
    if not points:
        return []
    (start, there), along = points[0], [x for x, _ in points]
    line = [BELOW * there * (x / start) ** order for x in along]
    return [curve(f"slope {order:g}", along, line, Look.SLOPE, 0)]


class Picture(Description):
    """A drawing, shown as an image, in which nothing can run.

    svg  the whole file; its own colours on white
    """

    name: str
    title: str
    caption: str
    """What is seen, in words: also read out to those who do not see it."""

    svg: str


NOT_FINITE = "not finite"


def value_text(value: float | None, unit: str, digits: int = 6) -> str:
    """Return a value with its unit."""
    if value is None:
        return NOT_FINITE
    if value == 0:
        return "0"
    if unit in ("", "°"):
        return plain(value, digits) + unit
    scale = engineering_unit(abs(value), unit)
    return f"{value / scale.size:#.{digits}g}".rstrip(".") + f" {scale.name}"


def plain(value: float | None, digits: int = 3) -> str:
    """Return a number without unit: 0.0123, 1.2e-5."""
    if value is None:
        return NOT_FINITE
    mantissa, e, exponent = f"{value:.{digits}g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if e else mantissa


def percent(part: float) -> str:
    """Return a fraction in per cent."""
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
    """Build a table with one line per item; the first column names the line."""
    return Table(
        title=title,
        columns=tuple(columns),
        rows=tuple(tuple(text(item) for text in columns.values()) for item in items),
        note=note,
        units=units,
    )
