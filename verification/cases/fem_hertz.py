"""Hertz's contact by finite elements, on many meshes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import LoadStep
from verification.cases.fem_levels import (
    MIDDLE,
    allowed,
    because,
    judged_within,
    label,
    levels,
    order_levels,
)
from verification.cases.fem_profiles import largest_error, radial_chart, relative_l2
from verification.cases.hertz_point import SOURCE, approach_error, peak_error, radius_error
from verification.exhibits.chart import Chart
from verification.exhibits.convergence_chart import convergence_chart
from verification.exhibits.profile_chart import ProfileLabels
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.order_of_convergence import Followed, OrderOfConvergence
from verification.judging.run import SectionRun, per_radius
from verification.observed.end_state import approach, contact_radius, peak_pressure
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import closed_form, exact_zero

if TYPE_CHECKING:
    from fem_reference import Result

# Elements per radius up to which the error is that of the contact zone.
STUDIED = 64
RADIUS_NOT_JUDGED = (
    "The radius errs by A h + B h²: A, up to 0.003, from reading the edge off the last two "
    "pressures, B, about 0.1, from the pressures. On these meshes neither dominates, so that it "
    "has no one order."
)
SCENE = paper.frictionless(
    "Ball on a half-space (paper's data, paraboloid), by finite elements",
    paper.paraboloid(paper.STEEL),
    paper.STEEL,
    LoadStep(normal_force=paper.NORMAL_FORCE),
)


def fem_hertz(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels."""
    return fem_hertz_on(levels(level), order_levels(level))


def fem_hertz_on(elements: tuple[int, ...], studied: tuple[tuple[int, float], ...] = ()) -> Case:
    """The case on meshes of so many elements per contact radius.

    studied  meshes for the orders, and where in its element the edge of the contact lies; none:
             the same meshes

    Where in its element the edge lies moves the error more than a few elements do. Values are
    judged with the edge in the middle of an element, orders over several places of it.
    """
    studied = studied or tuple((n, MIDDLE) for n in elements if n <= STUDIED)
    meshes = dict.fromkeys((*((n, MIDDLE) for n in elements), *studied))
    runs = tuple(
        SectionRun(label(*mesh), SCENE, per_radius(mesh[0], meshed(*mesh)), beyond=MIDDLE)
        for mesh in meshes
    )
    orders = tuple(label(n, place) for n, place in studied)
    n = elements[-1]
    finest = label(n)
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
                "order_of_pressure", Followed.PRESSURE,
                "pressure over the contact, L2", orders, l2_error, 1.0,
                "at the edge the hats cannot follow a square root: an error of O(√h) on a ring one "
                "element wide leaves O(h) in L2",
            ),
            OrderOfConvergence(
                "order_of_peak_pressure", Followed.PEAK_PRESSURE,
                "pressure on the axis", orders, peak_error, 2.0,
                "what the hats cannot follow of the square root at the edge comes to O(h²) of the "
                "load",
            ),
            OrderOfConvergence(
                "order_of_approach", Followed.APPROACH,
                "approach", orders, approach_error, 2.0,
                "the energy is stationary with respect to the edge of the contact, which is known "
                "to O(h)",
            ),
        ),
        charts=lambda results: _charts(
            results, finest, orders, {run.label: run.spacing for run in runs}
        ),
        limits=(
            "Away from the contact elements grow by the same ratio on every mesh, which leaves "
            "2e-6 of the peak pressure and 6e-6 of the approach on the finest.",
            RADIUS_NOT_JUDGED,
        ),
    )  # fmt: skip


def meshed(elements: int, place: float = MIDDLE) -> float:
    """The radius over which so many elements go where the edge of the contact is to lie at this
    part of the next one [length]."""
    return HERTZ.contact_radius * elements / (elements + place)


def l2_error(result: Result) -> float:
    """Relative L2 error of the pressure."""
    end = result.steps[-1]
    return relative_l2(end, end.pressure, HERTZ.pressure, HERTZ.contact_radius)


def pressure_error(result: Result) -> float:
    """Largest error of the pressure away from the edge, over the peak."""
    end = result.steps[-1]
    within = judged_within(result.discretisation.elements_per_radius) * HERTZ.contact_radius
    error = largest_error(end, end.pressure, HERTZ.pressure, within)
    return error / HERTZ.peak_pressure


def _charts(
    results: Mapping[str, Result], finest: str, studied: tuple[str, ...],
    spacings: Mapping[str, float],
) -> tuple[Chart, ...]:  # fmt: skip
    runs = [results[name] for name in studied]
    end = results[finest].steps[-1]
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
        "Relative errors, root mean square over the places of the edge in its element, against the "
        "side of an element over the contact radius.",
        [spacings[name] for name in studied],
        {
            "pressure (L2)": [l2_error(run) for run in runs],
            "peak pressure": [peak_error(run) for run in runs],
            "approach": [approach_error(run) for run in runs],
            "contact radius": [radius_error(run) for run in runs],
        },
        {"pressure (L2)": 1.0, "peak pressure": 2.0, "approach": 2.0},
        x_label="element side / contact radius",
    )
    return (profile, convergence)
