"""Hertz's contact by finite elements, on many meshes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import LoadStep
from verification.cases import paper_scene as paper
from verification.cases.case import (
    Case,
    Level,
    OrderOfConvergence,
    Quantity,
    Required,
    closed_form,
    exact_zero,
)
from verification.cases.chart import Chart
from verification.cases.convergence_chart import convergence_chart
from verification.cases.end_state import approach, contact_radius, peak_pressure
from verification.cases.fem_levels import allowed, because, judged_within, label, levels
from verification.cases.fem_profiles import largest_error, radial_chart
from verification.cases.paper_scene import HERTZ
from verification.cases.profile_chart import ProfileLabels
from verification.cases.section_run import SectionRun, per_radius

if TYPE_CHECKING:
    from fem_reference import Result

SOURCE = "Hertz 1882; Johnson 1985, ch. 4"
# Elements per radius up to which the error is that of the contact zone.
STUDIED = 64
SCENE = paper.frictionless(
    "Ball on a half-space (paper's data, paraboloid), by finite elements",
    paper.paraboloid(paper.STEEL),
    paper.STEEL,
    LoadStep(normal_force=paper.NORMAL_FORCE),
)


def fem_hertz(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels."""
    return fem_hertz_on(levels(level))


def fem_hertz_on(elements: tuple[int, ...]) -> Case:
    """The case on meshes of so many elements per contact radius.

    On every mesh the edge of the contact lies in the middle of an element: where in its element it
    lies moves the error more than a few elements do, and would hide the order.
    """
    runs = tuple(SectionRun(label(n), SCENE, per_radius(n, meshed(n))) for n in elements)
    labels = tuple(run.label for run in runs)
    studied = tuple(run.label for run in runs if run.discretisation.elements_per_radius <= STUDIED)
    finest, n = labels[-1], elements[-1]
    return Case(
        name="fem_hertz",
        title="Finite elements: Hertz point contact",
        problem=(
            "The contact of hertz_point solved by axisymmetric finite elements that share nothing "
            "with the semi-analytical solver but the scene: quadratic elements on a section of a "
            "hundred contact radii, pressure linear between its rings, contact as a linear "
            "complementarity problem."
        ),
        runs=runs,
        quantities=(
            Quantity(
                "peak_pressure", "largest pressure of any ring", "Pa", finest, peak_pressure,
                closed_form(HERTZ.peak_pressure, SOURCE), Required(allowed(1e-4, n, 2), because(2)),
            ),
            Quantity(
                "approach", "approach of the bodies since first touch", "m", finest, approach,
                closed_form(HERTZ.approach, SOURCE), Required(allowed(1e-4, n, 2), because(2)),
            ),
            Quantity(
                "contact_radius", "where the pressure ends, from its last two values", "m", finest,
                contact_radius, closed_form(HERTZ.contact_radius, SOURCE),
                Required(min(2e-3, allowed(5e-4, n, 1)), "asked is 2e-3 at 64 elements per radius; "
                         "the edge is known to a thirtieth of an element"),
            ),
            Quantity(
                "pressure", f"largest error of the pressure within "
                f"{judged_within(n):.2g} of the radius, over p_H", "",
                finest, pressure_error, exact_zero(SOURCE),
                Required(allowed(2e-3, n, 2), because(2)), 1.0, "p_H",
            ),
        ),
        orders=(
            OrderOfConvergence(
                "order_of_peak_pressure", "pressure on the axis", studied, peak_error, 2.0,
                "what the hats cannot follow of the square root at the edge comes to O(h²) of the "
                "load",
            ),
        ),
        charts=_charts,
        limits=(
            "Away from the contact elements grow by the same ratio on every mesh, which leaves "
            "2e-6 of the peak pressure and 6e-6 of the approach on the finest: no order is judged "
            "there.",
        ),
    )  # fmt: skip


def meshed(elements: int) -> float:
    """The radius over which so many elements go half an element short of the contact's edge."""
    return HERTZ.contact_radius * elements / (elements + 0.5)


def pressure_error(result: Result) -> float:
    """Largest error of the pressure away from the edge, over the peak."""
    end = result.steps[-1]
    within = judged_within(result.discretisation.elements_per_radius) * HERTZ.contact_radius
    error = largest_error(end, end.pressure, HERTZ.pressure, within)
    return error / HERTZ.peak_pressure


def peak_error(result: Result) -> float:
    """Relative error of the peak pressure."""
    return abs(peak_pressure(result) / HERTZ.peak_pressure - 1)


def approach_error(result: Result) -> float:
    """Relative error of the approach."""
    return abs(approach(result) / HERTZ.approach - 1)


def radius_error(result: Result) -> float:
    """Relative error of the contact radius."""
    return abs(contact_radius(result) / HERTZ.contact_radius - 1)


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    runs = list(results.values())
    end = runs[-1].steps[-1]
    r = np.linspace(0.0, HERTZ.contact_radius, 80)
    profile = radial_chart(
        ProfileLabels(
            "fem_hertz_profile", "Pressure over the radius",
            "Pressure by finite elements over Hertz's, and their difference: a ripple of the last "
            "elements at the edge.", "p / p₀", "r / a",
        ),
        HERTZ.contact_radius, HERTZ.peak_pressure, end, end.pressure, (r, HERTZ.pressure(r)),
    )  # fmt: skip
    convergence = convergence_chart(
        "fem_hertz_convergence",
        "Convergence of the finite elements",
        "Relative errors against the side of an element over the contact radius. They "
        "end at what the elements far from the contact leave.",
        [1 / run.discretisation.elements_per_radius for run in runs],
        {
            "peak pressure": [peak_error(run) for run in runs],
            "approach": [approach_error(run) for run in runs],
            "contact radius": [radius_error(run) for run in runs],
        },
        {"peak pressure": 2.0},
        x_label="element side / contact radius",
    )
    return (profile, convergence)
