"""Work–precision diagrams."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from verification.exhibits.chart import Chart, Look
from verification.exhibits.log_chart import Points, log_chart, point_curves
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


def methods_of(points: Iterable[Point]) -> list[str]:
    """Ours in their order, then others."""
    tried = {point.method for point in points}
    return [name for name in SERIES if name in tried] + sorted(tried - set(SERIES))


def _chart(
    name: str, title: str, caption: str, x_label: str, points: Sequence[Point], cost: Cost
) -> Chart:
    steady = dependable(points)

    def drawn(points: Iterable[Point]) -> Points:
        return [(cost(p), max(p.error, FLOOR)) for p in pareto(points, cost)]

    names = [*SERIES, *methods_of(points)]
    lines = [(n, drawn(p for p in steady if p.method == n)) for n in dict.fromkeys(names)]
    best = point_curves([("Pareto line", drawn(steady))], Look.BOUND)
    return log_chart(name, title, caption, x_label, "relative error", point_curves(lines) + best)
