"""Hertz's contact by finite elements, on many meshes."""

from __future__ import annotations

from dataclasses import replace

from verification.cases.fem_levels import because, levels, order_levels
from verification.judging.case import Case, Level
from verification.judging.declared_case import Falls, Within, case, judged
from verification.judging.drawings import PRESSURE, convergence, profile
from verification.judging.ladder import MIDDLE, Rung, asked, with_edge_at
from verification.judging.observables import (
    APPROACH,
    CONTACT_RADIUS,
    PEAK_PRESSURE,
    PRESSURE_L2,
    PRESSURE_WITHIN,
)
from verification.problems.hertz import BALL
from verification.problems.paper_scene import HERTZ

# Elements per radius up to which the error is that of the contact zone.
STUDIED = 64
RADIUS_NOT_JUDGED = (
    "The radius errs by A h + B h²: A, up to 0.003, from reading the edge off the last two "
    "pressures, B, about 0.1, from the pressures. On these meshes neither dominates, so that it "
    "has no one order."
)


def radius_allowed(rung: Rung) -> float:
    """Of the contact radius."""
    return asked(2e-4, 1)(rung)


ROWS = (
    Within(PEAK_PRESSURE, asked(1e-4, 2), because(2)),
    Within(APPROACH, asked(1e-4, 2), because(2)),
    Within(
        CONTACT_RADIUS, radius_allowed,
        "the edge is known to a seventieth of an element; 2e-3 is asked at 64 per radius",
    ),
    Within(PRESSURE_WITHIN, asked(2e-3, 2), because(2)),
    Falls(
        PRESSURE_L2, 1.0,
        "at the edge the hats cannot follow a square root: an error of O(√h) on a ring one element "
        "wide leaves O(h) in L2",
    ),
    Falls(
        PEAK_PRESSURE, 2.0,
        "what the hats cannot follow of the square root at the edge comes to O(h²) of the load",
    ),
    Falls(
        APPROACH, 2.0,
        "the energy is stationary with respect to the edge of the contact, which is known to O(h)",
    ),
)  # fmt: skip


def fem_hertz(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels."""
    return fem_hertz_on(levels(level), order_levels(level))


def fem_hertz_on(elements: tuple[int, ...], studied: tuple[tuple[int, float], ...] = ()) -> Case:
    """The case on meshes of so many elements per contact radius.

    studied  meshes for the orders, and where in its element the edge of the contact lies; none:
             the same meshes
    """
    studied = studied or tuple((n, MIDDLE) for n in elements if n <= STUDIED)
    meshes = with_edge_at(BALL, elements, studied)
    return case(
        "fem_hertz",
        "Finite elements: Hertz point contact",
        "The contact of hertz_point solved by axisymmetric finite elements that share nothing "
        "with the semi-analytical solver but the scene: quadratic elements on a section of a "
        "hundred contact radii, pressure linear between its rings, contact as a linear "
        "complementarity problem.",
        judged(meshes, ROWS),
        charts=(
            profile(
                meshes,
                "fem_hertz_profile",
                "Pressure over the radius",
                "Pressure by finite elements over Hertz's, and their difference: a ripple of the "
                "last elements at the edge.",
                "p / p₀",
                HERTZ.peak_pressure,
                replace(PRESSURE, profile="hertz"),
            ),
            convergence(
                meshes,
                ROWS,
                "fem_hertz_convergence",
                "Convergence of the finite elements",
                "Relative errors, root mean square over the places of the edge in its element, "
                "against the side of an element over the contact radius.",
                also=(CONTACT_RADIUS,),
            ),
        ),
        limits=(
            "Away from the contact elements grow by the same ratio on every mesh, which leaves "
            "2e-6 of the peak pressure and 6e-6 of the approach on the finest.",
            RADIUS_NOT_JUDGED,
        ),
    )
