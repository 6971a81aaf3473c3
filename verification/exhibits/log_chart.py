"""Diagrams on logarithmic axes: curves of points, and lines of a slope below them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isfinite

from verification.exhibits.chart import Chart, Curve, Look, Panel, curve

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
    """One panel of curves.

    y_places  names of the places 0, 1, … along y, where these are no numbers
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
    """The line of a slope below these points, from the first on; none without points."""
    if not points:
        return []
    (start, there), along = points[0], [x for x, _ in points]
    line = [BELOW * there * (x / start) ** order for x in along]
    return [curve(f"slope {order:g}", along, line, Look.SLOPE, 0)]
