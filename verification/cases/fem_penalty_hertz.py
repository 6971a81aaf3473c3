"""Hertz's contact by finite elements with a penalty: what the penalty costs, and how it goes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import pi
from typing import TYPE_CHECKING

from verification.cases.fem_hertz import SCENE, meshed, pressure_error
from verification.cases.fem_levels import allowed, because, finest, judged_within
from verification.cases.hertz_point import SOURCE, approach_error, peak_error
from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.run import SectionRun, per_radius
from verification.judging.solver import Method
from verification.observed.end_state import approach, contact_radius, peak_pressure
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import Reference, ReferenceKind, closed_form, exact_zero

if TYPE_CHECKING:
    from fem_reference import Result

ASKED = "asked of the finite elements with a penalty, at their default penalty"
DEFAULT = "c = 10, one augmentation"
FACTORS = (2.5, 5.0, 10.0, 20.0, 40.0, 80.0)  # c
JUDGED = 10.0
PENALTY_LAW = (
    "springs of stiffness ε in series with Hertz's contact, to first order: the approach grows by "
    "d/dW of the energy ∫p²/2ε dA in them, which is p₀/2ε"
)


def fem_penalty_hertz(level: Level = Level.QUICK) -> Case:
    """The case, on a finer mesh at higher levels."""
    return fem_penalty_hertz_on(finest(level))


def fem_penalty_hertz_on(elements: int) -> Case:
    """The case on a mesh of so many elements per contact radius."""
    by_default = penalised(elements, JUDGED, 1)
    springs = {factor: penalised(elements, factor, 0) for factor in FACTORS}
    improved = {factor: penalised(elements, factor, 1) for factor in FACTORS if factor != JUDGED}
    run, bare = by_default.label, springs[JUDGED].label
    return Case(
        name="fem_penalty_hertz",
        title="Finite elements with a penalty: Hertz point contact",
        problem=(
            "The contact of fem_hertz with springs of stiffness ε = c E*/h between the surfaces at "
            "the Gauss points of the contact edges, h the length of an edge, instead of exact "
            "contact. Springs overlap, and k = c a/h says how much; one augmentation, in which the "
            "pressures of the springs become forces that need no overlap, takes that away."
        ),
        runs=(by_default, *springs.values(), *improved.values()),
        quantities=(
            Quantity(
                "peak_pressure", "largest pressure of any Gauss point", "Pa", run, peak_pressure,
                closed_form(HERTZ.peak_pressure, SOURCE), Required(2e-3, ASKED),
            ),
            Quantity(
                "approach", "approach of the bodies since first touch", "m", run, approach,
                closed_form(HERTZ.approach, SOURCE),
                Required(allowed(1e-4, elements, 2), f"as without a penalty: an augmentation takes "
                         f"away what springs add, 1/πk; {because(2)}"),
            ),
            Quantity(
                "contact_radius", "where the pressure ends, by a fit of its square", "m", run,
                contact_radius, closed_form(HERTZ.contact_radius, SOURCE),
                Required(0.1 / elements, "a tenth of an element: the last points ripple"),
            ),
            Quantity(
                "pressure", f"largest error of the pressure within "
                f"{judged_within(elements):.2g} of the radius, over p_H", "", run, pressure_error,
                exact_zero(SOURCE), Required(allowed(2e-3, elements, 2), because(2)), 1.0, "p_H",
            ),
            Quantity(
                "peak_pressure_of_springs", "the same as peak_pressure, without augmentation", "Pa",
                bare, peak_pressure, closed_form(HERTZ.peak_pressure, SOURCE),
                Required(2e-3, ASKED),
            ),
            Quantity(
                "approach_of_springs", "the same as approach, without augmentation", "m", bare,
                approach, closed_form(HERTZ.approach, SOURCE), Required(2e-3, ASKED),
            ),
            Quantity(
                "error_law", "error of the approach without augmentation, times k = c a/h", "",
                bare, _scaled_error(elements), Reference(1 / pi, ReferenceKind.THEORY, PENALTY_LAW),
                Required(0.05, "set by hand: the next order in 1/k and what the mesh adds"),
            ),
        ),
        charts=lambda results: (_chart(results, springs, improved | {JUDGED: by_default}),),
        limits=(
            "The measured error of the peak pressure is −0.54/k; no theory is at hand for that "
            "number.",
        ),
    )  # fmt: skip


def penalised(elements: int, factor: float, augmentations: int) -> SectionRun:
    """Hertz's contact on one mesh with a penalty."""
    discretisation = per_radius(elements, meshed(elements)).model_copy(
        update={"penalty": factor, "augmentations": augmentations}
    )
    words = "springs alone" if augmentations == 0 else "one augmentation"
    return SectionRun(f"c = {factor:g}, {words}", SCENE, discretisation, Method.PENALTY)


def _scaled_error(elements: int) -> Callable[[Result], float]:
    """Error of the approach times k."""
    per_contact = elements * HERTZ.contact_radius / meshed(elements)

    def measure(result: Result) -> float:
        k = result.discretisation.penalty * per_contact
        return (approach(result) / HERTZ.approach - 1) * k

    return measure


def _chart(
    results: Mapping[str, Result],
    springs: Mapping[float, SectionRun],
    improved: Mapping[float, SectionRun],
) -> Chart:
    factors = sorted(springs)
    series = (
        ("approach, springs alone", springs, approach_error),
        ("peak pressure, springs alone", springs, peak_error),
        ("approach, one augmentation", improved, approach_error),
        ("peak pressure, one augmentation", improved, peak_error),
    )
    curves = [
        curve(label, factors, [error(results[runs[c].label]) for c in factors], Look.POINTS, number)
        for number, (label, runs, error) in enumerate(series)
    ]
    bare = [approach_error(results[springs[c].label]) for c in factors]
    slope = [0.6 * bare[0] * factors[0] / c for c in factors]
    panel = Panel(
        x_label="c", y_label="relative error", logarithmic=True, height=2.6,
        curves=(curve("slope -1", factors, slope, Look.SLOPE, 0), *curves),
    )  # fmt: skip
    return Chart(
        name="fem_penalty_hertz_error",
        title="Error of the penalty",
        caption="Relative errors against the penalty factor c. Springs alone err by 1/c; one "
        "augmentation leaves the error of the mesh.",
        rows=((panel,),),
    )
