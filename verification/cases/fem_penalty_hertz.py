"""Hertz's contact by finite elements with a penalty: what the penalty costs, and how it goes."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi
from typing import Any

from verification.cases.fem_levels import because, finest
from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.declared_case import Drawing, Within, case, judged
from verification.judging.ladder import (
    Ladder,
    asked,
    meshed,
    on_springs,
    part_of_side,
    with_edge_at,
)
from verification.judging.observables import (
    APPROACH,
    CONTACT_RADIUS,
    PEAK_PRESSURE,
    PRESSURE_WITHIN,
)
from verification.problems.hertz import BALL
from verification.problems.reference import Reference, ReferenceKind

ASKED = "asked of the finite elements with a penalty, at their default penalty"
FACTORS = (2.5, 5.0, 10.0, 20.0, 40.0, 80.0)  # c
JUDGED = 10.0  # c, with one augmentation
PENALTY_LAW = (
    "springs of stiffness ε in series with Hertz's contact, to first order: the approach grows by "
    "d/dW of the energy ∫p²/2ε dA in them, which is p₀/2ε"
)
ROWS = (
    Within(PEAK_PRESSURE, 2e-3, ASKED),
    Within(
        APPROACH, asked(1e-4, 2),
        f"as without a penalty: an augmentation takes away what springs add, 1/πk; {because(2)}",
    ),
    Within(CONTACT_RADIUS, part_of_side(0.1), "a tenth of an element: the last points ripple"),
    Within(PRESSURE_WITHIN, asked(2e-3, 2), because(2)),
)  # fmt: skip
OF_SPRINGS = (
    Within(PEAK_PRESSURE, 2e-3, ASKED, name="peak_pressure_of_springs"),
    Within(APPROACH, 2e-3, ASKED, name="approach_of_springs"),
)


def fem_penalty_hertz(level: Level = Level.QUICK) -> Case:
    """The case, on a finer mesh at higher levels."""
    return fem_penalty_hertz_on(finest(level))


def fem_penalty_hertz_on(elements: int) -> Case:
    """The case on a mesh of so many elements per contact radius."""
    springs = {factor: penalised(elements, factor, 0) for factor in FACTORS}
    improved = {factor: penalised(elements, factor, 1) for factor in FACTORS}
    return case(
        "fem_penalty_hertz",
        "Finite elements with a penalty: Hertz point contact",
        "The contact of fem_hertz with springs of stiffness ε = c E*/h between the surfaces at the "
        "Gauss points of the contact edges, h the length of an edge, instead of exact contact. "
        "Springs overlap, and k = c a/h says how much; one augmentation, in which the pressures "
        "of the springs become forces that need no overlap, takes that away.",
        judged(improved[JUDGED], ROWS),
        judged(springs[JUDGED], OF_SPRINGS),
        runs=tuple(run for one in (springs, improved) for of in one.values() for run in of.runs),
        quantities=(_error_law(elements, springs[JUDGED].judged.run.label),),
        charts=(_chart(springs, improved),),
        limits=(
            "The measured error of the peak pressure is −0.54/k; no theory is at hand for that "
            "number.",
        ),
    )


def penalised(elements: int, factor: float, augmentations: int) -> Ladder:
    """Hertz's contact on one mesh with a penalty."""
    words = "springs alone" if augmentations == 0 else "one augmentation"
    meshes = with_edge_at(BALL, (elements,))
    return on_springs(
        meshes,
        f"c = {factor:g}, {words}",
        penalty=factor,
        augmentations=augmentations,
        overlap=1.0,
    )


def _error_law(elements: int, run: str) -> Quantity:
    """Error of the approach times k."""
    k = JUDGED * elements * BALL.radius / meshed(BALL.radius, elements)
    error = APPROACH.error(BALL)
    return Quantity(
        "error_law", "error of the approach without augmentation, times k = c a/h", "", run,
        lambda result: error(result) * k, Reference(1 / pi, ReferenceKind.THEORY, PENALTY_LAW),
        Required(0.05, "set by hand: the next order in 1/k and what the mesh adds"),
    )  # fmt: skip


def _chart(springs: Mapping[float, Ladder], improved: Mapping[float, Ladder]) -> Drawing:
    series = [
        (f"{what.label}, {words}", what.error(BALL), ladders)
        for words, ladders in (("springs alone", springs), ("one augmentation", improved))
        for what in (APPROACH, PEAK_PRESSURE)
    ]

    def draw(results: Mapping[str, Any]) -> Chart:
        errors = [
            [abs(error(results[ladders[c].judged.run.label])) for c in FACTORS]
            for _, error, ladders in series
        ]
        curves = [
            curve(label, FACTORS, found, Look.POINTS, number)
            for number, ((label, *_), found) in enumerate(zip(series, errors, strict=True))
        ]
        slope = [0.6 * errors[0][0] * FACTORS[0] / c for c in FACTORS]
        panel = Panel(
            x_label="c", y_label="relative error", logarithmic=True, height=2.6,
            curves=(curve("slope -1", FACTORS, slope, Look.SLOPE, 0), *curves),
        )  # fmt: skip
        return Chart(
            name="fem_penalty_hertz_error",
            title="Error of the penalty",
            caption="Relative errors against the penalty factor c. Springs alone err by 1/c; one "
            "augmentation leaves the error of the mesh.",
            rows=((panel,),),
        )

    return draw
