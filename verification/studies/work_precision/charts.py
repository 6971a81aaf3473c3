"""Work–precision diagrams."""

from __future__ import annotations

from collections.abc import Sequence

from verification.exhibits.chart import Chart, Curve, Look, Panel, curve
from verification.studies.work_precision.contacts import PreciseContact
from verification.studies.work_precision.point import (
    Cost,
    Point,
    dependable,
    operations,
    pareto,
    seconds,
)
from verification.studies.work_precision.setting import Method

HEIGHT = 2.4
FLOOR = 1e-9  # of what can be drawn on a logarithmic axis
# One colour and marker per method on all diagrams; other codes follow.
SERIES = [method.value for method in Method]


def time_chart(contact: PreciseContact, quantity: str, points: Sequence[Point]) -> Chart:
    """Error against CPU seconds."""
    meaning = contact.errors[quantity]
    return _chart(
        f"precision_{contact.name}_{quantity}",
        f"{contact.title}: {meaning}",
        f"Error of the {meaning} against CPU seconds, set-up included, of the best settings of "
        "every method; thin black dashes are the Pareto line of all of them.",
        "CPU seconds", points, seconds,
    )  # fmt: skip


def work_chart(contact: PreciseContact, quantity: str, points: Sequence[Point]) -> Chart:
    """Error against counted work."""
    meaning = contact.errors[quantity]
    return _chart(
        f"counted_{contact.name}_{quantity}",
        f"{contact.title}: {meaning}, by counted work",
        f"Error of the {meaning} against operations that follow from counters, the same on every "
        "machine; set-up of exact coefficients is not counted.",
        "operations / 10⁹", points, lambda point: operations(point) / 1e9,
    )  # fmt: skip


def _chart(
    name: str, title: str, caption: str, x_label: str, points: Sequence[Point], cost: Cost
) -> Chart:
    steady = dependable(points)
    names = [*SERIES, *sorted({point.method for point in points} - set(SERIES))]
    curves: list[Curve] = []
    for series, method in enumerate(names):
        line = pareto([p for p in steady if p.method == method], cost)
        if line:
            curves.append(_curve(method, line, cost, Look.POINTS, series))
    best = pareto(steady, cost)
    curves.append(_curve("Pareto line", best, cost, Look.BOUND))
    panel = Panel(
        x_label=x_label,
        y_label="relative error",
        curves=tuple(curves),
        logarithmic=True,
        height=HEIGHT,
    )
    return Chart(name=name, title=title, caption=caption, rows=((panel,),))


def _curve(label: str, line: Sequence[Point], cost: Cost, look: Look, series: int = 0) -> Curve:
    return curve(label, [cost(p) for p in line], [max(p.error, FLOOR) for p in line], look, series)
