"""The radial solver against closed forms, and against other programs where there are layers."""

from __future__ import annotations

from typing import Any

import numpy as np

from radial.bodies import Bodies
from radial.disc import disc
from radial.surface import pressure
from verification.judging.case import Case, Level
from verification.judging.declared_case import Within, case, judged
from verification.judging.ladder import on_radii
from verification.judging.observable import error_norm
from verification.judging.observables import APPROACH, CONTACT_RADIUS
from verification.problems.classical import CONE, PUNCH, mean_pressure
from verification.problems.coated_ball import BARE, ROWS, coated_ball
from verification.problems.problem import OVER_PEAK, Problem

ASKED = "both are right to rounding, of which forty times are allowed; 1e-10 was asked"
WITHIN = 0.995  # radii up to which pressures are compared: at the edge they have no finite slope
PROBLEMS = {"ball": BARE, "cone": CONE, "punch": PUNCH} | {
    f"E1/E2 = {row['E1_over_E2']:g}, h = {row['h_over_aH']:g} a_H": coated_ball(row) for row in ROWS
}


def _pressure_error(result: Any, _: int, problem: Problem) -> float:
    """At the rings, or at the radii of a table."""
    end, exact = result.steps[-1], problem.ends[0]
    scale = problem.scales.get(OVER_PEAK) or mean_pressure(problem)
    r, found = end.radii, end.pressure
    if hasattr(exact, "radii"):
        r = exact.radii
        contact = disc(Bodies.of(problem.scene), problem.scene.indenter, end.contact_radius)
        found = pressure(contact, r / contact.radius)
    else:
        inside = r < WITHIN * problem.radius
        r, found = r[inside], found[inside]
    return float(np.max(np.abs(found - exact.pressure(r))) / scale)


PRESSURE = error_norm(
    "pressure",
    f"largest error of the pressure up to {WITHIN:g} a, or at the radii of a table",
    _pressure_error,
    "p_H, or the mean pressure of cone and punch",
)
ROWS_OF_ALL = [
    Within(what, 1e-12, ASKED, each=True) for what in (APPROACH, CONTACT_RADIUS, PRESSURE)
]


def radial_pressing(level: Level = Level.QUICK) -> Case:
    """The case; above the quick level also with twice the orders and points."""
    fineness = (1,) if level is Level.QUICK else (2, 1)
    return case(
        "radial_pressing",
        "Pressing in one dimension",
        "The paper's ball, a cone and a flat punch on half-spaces, and the ball, rigid, on "
        f"{len(ROWS)} coatings, under 1 kN without friction, by the radial solver. It has the "
        "response of layers to a wavenumber in common with the semi-analytical solver; the "
        "references have neither that nor its polynomials.",
        *(
            judged(on_radii(problem, name, fineness), ROWS_OF_ALL)
            for name, problem in PROBLEMS.items()
        ),
    )
