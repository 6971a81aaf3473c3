"""Errors and work of the penalty, drawn."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from verification.cases.case import Level
from verification.cases.chart import Chart, Curve, Look, Panel, curve
from verification.studies.penalty.case import FRICTIONAL, PenaltyCase, PenaltyRecord
from verification.studies.penalty.families import (
    BOXED,
    UPDATES,
    of_boxes,
    of_friction,
    of_increments,
    of_springs,
)
from verification.studies.penalty.verdicts import Found

Value = Callable[[PenaltyRecord], float | None]
Along = Callable[[PenaltyCase], float]
BELOW = 0.6  # slope lines run under the data, by this factor
HEIGHT = 2.4
NAMES = {
    "hertz": "no friction", "weak": "µ = 0.1", "strong": "µ = 0.3", "coated": "coated, µ = 0.1"
}  # fmt: skip


def charts(level: Level, found: Found) -> tuple[Chart, ...]:
    """All figures."""
    return (
        _stiffness(level, found),
        _ripple(level, found),
        _work(level, found),
        _increments(level, found),
        _boxes(level, found),
    )


def _stiffness(level: Level, found: Found) -> Chart:
    bare, once = (
        [c for c in of_springs(level) if c.augmentations == updates] for updates in (0, 1)
    )
    curves = [
        *_slope(bare, found, _factor, lambda r: r.approach, -1),
        *_curve("approach, springs alone", bare, found, _factor, lambda r: r.approach, 0),
        *_curve("peak pressure, springs alone", bare, found, _factor, lambda r: r.peak, 1),
        *_curve("approach, one augmentation", once, found, _factor, lambda r: r.approach, 2),
        *_curve("peak pressure, one augmentation", once, found, _factor, lambda r: r.peak, 3),
    ]
    return _chart(
        "penalty_stiffness",
        "Error against the stiffness of the springs",
        "Relative errors of Hertz's contact against the penalty factor c. Springs alone err by a "
        "constant over c until the mesh's error is left; one augmentation leaves it at any c.",
        "c", "relative error", curves,
    )  # fmt: skip


def _ripple(level: Level, found: Found) -> Chart:
    curves: list[Curve] = []
    for series, updates in enumerate(UPDATES):
        cases = [c for c in of_springs(level) if c.augmentations == updates]
        words = "springs alone" if updates == 0 else f"augmentations: {updates}"
        curves += _curve(words, cases, found, _factor, lambda r: r.ripple, series)
    return _chart(
        "penalty_ripple",
        "Ripple of the pressure at the edge",
        "L2 norm of the pressure's error over that of the pressure, against c. It is nearly all in "
        "the last element: stiff springs and many augmentations make it larger.",
        "c", "L2 error of the pressure", curves,
    )  # fmt: skip


def _work(level: Level, found: Found) -> Chart:
    curves: list[Curve] = []
    for series, contact in enumerate(FRICTIONAL):
        cases = of_friction(level, contact, 1)
        curves += _curve(NAMES[contact], cases, found, _factor, _systems, series)
    return _chart(
        "penalty_work",
        "Work against the stiffness of the springs",
        "Linear systems per increment, two passes each, against c. Where Newton's method gives up "
        "and springs in series take over, their systems are added to its own.",
        "c", "linear systems per increment", curves,
    )  # fmt: skip


def _increments(level: Level, found: Found) -> Chart:
    cases = of_increments(level)
    curves = [
        *_slope(cases, found, _number, lambda r: r.shear, -1),
        *_curve("shear", cases, found, _number, lambda r: r.shear, 0),
        *_curve("pressure", cases, found, _number, lambda r: r.pressure, 1),
        *_curve("approach", cases, found, _number, lambda r: r.approach, 2),
    ]
    return _chart(
        "penalty_increments",
        "Error against the number of increments",
        "Pressing with µ = 0.3 at the default penalty. Shear remembers the path, until the mesh's "
        "error at the edge of stick is left; approach and pressure hardly notice it.",
        "increments", "error", curves,
    )  # fmt: skip


def _boxes(level: Level, found: Found) -> Chart:
    curves: list[Curve] = []
    for series, contact in enumerate(BOXED):
        cases = of_boxes(level, contact)
        curves += _curve(NAMES[contact], cases, found, _box, lambda r: r.approach, series)
    return _chart(
        "penalty_box",
        "Error of the approach against the size of the section",
        "The displacement of the substrate under the load is prescribed on the border. A coating "
        "adds a source that this leaves out, which falls with the square of the size.",
        "size of the section / contact radius", "relative error of the approach", curves,
    )  # fmt: skip


def _factor(case: PenaltyCase) -> float:
    return case.factor


def _number(case: PenaltyCase) -> float:
    return case.increments


def _systems(record: PenaltyRecord) -> float:
    return record.systems / record.increments


def _box(case: PenaltyCase) -> float:
    assert case.box is not None
    return case.box


def _curve(
    label: str,
    cases: Sequence[PenaltyCase],
    found: Found,
    along: Along,
    value: Value,
    series: int,
) -> list[Curve]:
    points = _points(cases, found, along, value)
    if not points:
        return []
    x, y = zip(*points, strict=True)
    return [curve(label, x, y, Look.POINTS, series)]


def _slope(
    cases: Sequence[PenaltyCase], found: Found, along: Along, value: Value, order: float
) -> list[Curve]:
    points = _points(cases, found, along, value)
    if not points:
        return []
    (start, value_there), x = points[0], [place for place, _ in points]
    line = [BELOW * value_there * (place / start) ** order for place in x]
    return [curve(f"slope {order:g}", x, line, Look.SLOPE, 0)]


def _points(
    cases: Sequence[PenaltyCase], found: Found, along: Along, value: Value
) -> list[tuple[float, float]]:
    return [
        (along(case), abs(y))
        for case in cases
        if case in found and (y := value(found[case])) is not None and y != 0
    ]


def _chart(
    name: str, title: str, caption: str, x_label: str, y_label: str, curves: Iterable[Curve]
) -> Chart:
    panel = Panel(
        x_label=x_label, y_label=y_label, curves=tuple(curves), logarithmic=True, height=HEIGHT
    )
    return Chart(name=name, title=title, caption=caption, rows=((panel,),))
