"""The map of hard cases as a user asks of it: is it solved, and how much longer does it take."""

from __future__ import annotations

from dataclasses import dataclass
from statistics import median

from verification.exhibits.chart import Chart, Panel
from verification.exhibits.numbers import plain
from verification.report.sections import study_of
from verification.running.report_record import Report

VIEW = "stability_coating"  # what a designer chooses: stiffness and thickness of the coating
# By the series that the study draws its classes with; all others are solved.
ENDS = {1: "gave up", 3: "refused", 5: "wrong"}
EFFORTS = (1.5, 3.0, 10.0)  # times the work of the median place
THOUSAND = "k"
HALVED = "*"


@dataclass(frozen=True)
class Place:
    """A place of the map.

    kind  `effort-0` to `effort-3`, or how it ended
    text  the work of its dearest cell in multiples of the median place's, or how it ended
    """

    kind: str
    text: str


@dataclass(frozen=True)
class StabilityMap:
    """Rows from the top of the map down, each with its name and its places from left to right;
    None where nothing was solved."""

    title: str
    x_label: str
    y_label: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, tuple[Place | None, ...]], ...]


def stability_map(report: Report) -> StabilityMap | None:
    """Stiffness against thickness of a coating; None where no record of it is at hand."""
    record = study_of(report, "stability")
    charts = () if record is None else record.conclusion.charts
    chart = next((one for one in charts if one.name == VIEW), None)
    return None if chart is None else _map(chart)


def legend() -> tuple[tuple[str, str], ...]:
    """Kinds of places, and what they mean."""
    _, *dearer = (plain(effort) for effort in EFFORTS)
    words = ("solved at the usual cost", *(f"up to {n} times it" for n in dearer), "more than that")
    assert len(words) == len(EFFORTS) + 1
    return (
        *((f"effort-{n}", word) for n, word in enumerate(words)),
        ("refused", "refused, with its reason"),
        ("gave up", "gave up, and said so"),
        ("wrong", "wrong in silence"),
    )


def _map(chart: Chart) -> StabilityMap:
    ((panel,),) = chart.rows
    ends = {
        place: ENDS[curve.series]
        for curve in panel.curves
        if curve.series in ENDS
        for place in zip(curve.x, curve.y, strict=True)
    }
    work = {(x, y): _work(text) for x, y, text in panel.notes}
    usual = median([value for value in work.values() if value] or [1.0])
    places = {
        at: Place(ends[at], ends[at]) if at in ends else _solved(value / usual)
        for at, value in work.items()
    }
    return StabilityMap(
        chart.title, panel.x_label, panel.y_label, panel.x_places, tuple(_rows(panel, places))
    )


def _rows(
    panel: Panel, places: dict[tuple[float, float], Place]
) -> list[tuple[str, tuple[Place | None, ...]]]:
    return [
        (name, tuple(places.get((float(i), float(j))) for i in range(len(panel.x_places))))
        for j, name in reversed(list(enumerate(panel.y_places)))
    ]


def _solved(effort: float) -> Place:
    return Place(f"effort-{sum(effort > bound for bound in EFFORTS)}", f"{plain(effort, 2)} ×")


def _work(text: str) -> float:
    """A number that the study's map shows: 876, 17k, with a mark where increments were halved."""
    number = text.rstrip(HALVED)
    if number.endswith(THOUSAND):
        return 1000 * float(number[: -len(THOUSAND)])
    return float(number) if number.isdecimal() else 0.0
