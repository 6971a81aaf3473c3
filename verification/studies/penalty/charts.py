"""Errors and work of the penalty, drawn."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from verification.exhibits.chart import Chart, Curve, Look, Panel, curve
from verification.judging.case import Level
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
Drawn = tuple[str, Sequence[PenaltyCase], Value]  # label, cases, their value
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
    drawn: tuple[Drawn, ...] = (
        ("approach, springs alone", bare, lambda r: r.approach),
        ("peak pressure, springs alone", bare, lambda r: r.peak),
        ("approach, one augmentation", once, lambda r: r.approach),
        ("peak pressure, one augmentation", once, lambda r: r.peak),
    )
    curves = _slope(bare, found, _factor, lambda r: r.approach, -1) + _curves(drawn, found, _factor)
    return _chart(
        "penalty_stiffness",
        "Error against the stiffness of the springs",
        "Relative errors of Hertz's contact against the penalty factor c. Springs alone err by a "
        "constant over c until the mesh's error is left; one augmentation leaves it at any c.",
        "c", "relative error", curves,
    )  # fmt: skip


def _ripple(level: Level, found: Found) -> Chart:
    by_updates = (
        (
            "springs alone" if updates == 0 else f"augmentations: {updates}",
            [c for c in of_springs(level) if c.augmentations == updates],
            lambda r: r.ripple,
        )
        for updates in UPDATES
    )
    return _chart(
        "penalty_ripple",
        "Ripple of the pressure at the edge",
        "L2 norm of the pressure's error over that of the pressure, against c. It is nearly all in "
        "the last element: stiff springs and many augmentations make it larger.",
        "c", "L2 error of the pressure", _curves(by_updates, found, _factor),
    )  # fmt: skip


def _work(level: Level, found: Found) -> Chart:
    by_contact = ((NAMES[c], of_friction(level, c, 1), _systems) for c in FRICTIONAL)
    return _chart(
        "penalty_work",
        "Work against the stiffness of the springs",
        "Linear systems per increment, two passes each, against c. Where Newton's method gives up "
        "and springs in series take over, their systems are added to its own.",
        "c", "linear systems per increment", _curves(by_contact, found, _factor),
    )  # fmt: skip


def _increments(level: Level, found: Found) -> Chart:
    cases = of_increments(level)
    drawn: tuple[Drawn, ...] = (
        ("shear", cases, lambda r: r.shear),
        ("pressure", cases, lambda r: r.pressure),
        ("approach", cases, lambda r: r.approach),
    )
    curves = _slope(cases, found, _number, lambda r: r.shear, -1) + _curves(drawn, found, _number)
    return _chart(
        "penalty_increments",
        "Error against the number of increments",
        "Pressing with µ = 0.3 at the default penalty. Shear remembers the path, until the mesh's "
        "error at the edge of stick is left; approach and pressure hardly notice it.",
        "increments", "error", curves,
    )  # fmt: skip


def _boxes(level: Level, found: Found) -> Chart:
    by_contact = ((NAMES[c], of_boxes(level, c), lambda r: r.approach) for c in BOXED)
    return _chart(
        "penalty_box",
        "Error of the approach against the size of the section",
        "The displacement of the substrate under the load is prescribed on the border. A coating "
        "adds a source that this leaves out, which falls with the square of the size.",
        "size of the section / contact radius", "relative error of the approach",
        _curves(by_contact, found, _box),
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


def _curves(drawn: Iterable[Drawn], found: Found, along: Along) -> list[Curve]:
    """In the order of their mention, without those that have no points."""
    curves = []
    for series, (label, cases, value) in enumerate(drawn):
        points = _points(cases, found, along, value)
        if points:
            x, y = zip(*points, strict=True)
            curves.append(curve(label, x, y, Look.POINTS, series))
    return curves


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
