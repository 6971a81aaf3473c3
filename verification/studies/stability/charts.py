"""The map drawn: decade of the residual as colour and shape, cost as a number."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from verification.exhibits.chart import Chart, Curve, Look, Panel, curve, stacked
from verification.exhibits.numbers import plain
from verification.judging.run import OTHER_NORMS
from verification.studies.stability.record import CellRecord, Verdict
from verification.studies.stability.verdicts import WORK
from verification.studies.stability.views import View

Found = Mapping[str, CellRecord]

# Coordinates as people read them.
NAMES = {
    "friction": "µ", "push": "T / µW", "modulus_ratio": "E1/E2", "thickness": "h/a",
    "poisson_ratio": "ν of the layer", "path": "path", "surface": "surface", "load": "W / W(a)",
    "length": "a (m)", "modulus": "E2 (Pa)", "solver": "solver",
}  # fmt: skip

# Classes from best to worst, each with the series whose colour and shape it takes; a place shows
# the worst of its cells. First the decades of the residual over what is allowed.
CLASSES = (
    ("residual ≤ allowed / 100", 4),
    ("residual ≤ allowed / 10", 2),
    ("residual ≤ allowed", 0),
    ("refused", 3),
    ("not converged", 1),
    ("silent", 5),
)
SHAPES = "downward triangle, upward triangle, disc, diamond, square, cross"
DECADES = (0.01, 0.1)  # upper ends of the first two, over what is allowed
ENDS = {Verdict.REFUSED: 3, Verdict.NOT_CONVERGED: 4, Verdict.SILENT: 5}
HALVED = "*"
HEIGHT_PER_ROW, HEIGHT_OF_AXES = 0.24, 0.5
THOUSANDS = 10_000  # from here on the cost is rounded to them


def class_of(record: CellRecord) -> int:
    """Number of the class of a cell."""
    if record.verdict in ENDS:
        return ENDS[record.verdict]
    return sum(_part_of_allowed(record) > decade for decade in DECADES)


def _part_of_allowed(record: CellRecord) -> float:
    """The worse of both residuals over what is allowed of each, as `judged` holds them [1]."""
    stated, seen = record.residual or 0.0, record.observed or 0.0
    return max(stated, seen / OTHER_NORMS) / record.tolerance


def view_chart(view: View, found: Found) -> Chart:
    """One view of the map; places without a record stay empty."""
    x_values, y_values = view.values(view.x), view.values(view.y)
    places: dict[int, list[tuple[int, int]]] = {n: [] for n in range(len(CLASSES))}
    notes = []
    for i, x in enumerate(x_values):
        for j, y in enumerate(y_values):
            records = [found[cell.name] for cell in view.at(x, y) if cell.name in found]
            if records:
                places[max(map(class_of, records))].append((i, j))
                notes.append((float(i), float(j), _cost(records)))
    return stacked(
        f"stability_{view.name.replace('-', '_')}",
        view.title,
        "Colour and shape: the worst residual of the cells at a place beside what "
        f"is allowed, or how they ended ({'; '.join(_legend())}). Allowed is the tolerance, and of "
        f"what the fields alone show {OTHER_NORMS:g} times that. Number: the most "
        f"{WORK[view.by_elements]} that one of them took"
        f"{' (steps of Newton or of the active set)' if view.by_elements else ''}, with "
        f"{HALVED} where increments were halved.",
        Panel(
            x_label=NAMES[view.x],
            y_label=NAMES[view.y],
            curves=tuple(_tiles(n, where) for n, where in places.items() if where),
            height=HEIGHT_OF_AXES + HEIGHT_PER_ROW * len(y_values),
            notes=tuple(notes),
            x_places=_texts(x_values),
            y_places=_texts(y_values),
        ),
    )


def _tiles(number: int, where: list[tuple[int, int]]) -> Curve:
    x, y = zip(*where, strict=True)
    label, series = CLASSES[number]
    return curve(label, map(float, x), map(float, y), Look.TILES, series)


def _legend() -> list[str]:
    return [f"{s}: {label}" for s, (label, _) in zip(SHAPES.split(", "), CLASSES, strict=True)]


def _cost(records: list[CellRecord]) -> str:
    most = max(record.work for record in records)
    mark = HALVED if any(record.halvings for record in records) else ""
    number = "–" if most == 0 else str(most) if most < THOUSANDS else f"{most / 1000:.0f}k"
    return number + mark


def _texts(values: Iterable[Any]) -> tuple[str, ...]:
    return tuple(str(v) if isinstance(v, str) else plain(v, 6) for v in values)
