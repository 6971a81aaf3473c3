"""Frictionless contact of a rigid ball with coated bodies, with tabulated and semi-closed
answers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from verification.problems.classical import hertzian
from verification.problems.layered_scene import (
    FREDHOLM,
    FREDHOLM_EQUATION,
    SEMI_CLOSED_ERROR,
    coated,
    exact_contact,
    film,
    pressed,
    rigid_ball,
)
from verification.problems.paper_scene import HERTZ
from verification.problems.problem import OVER_PEAK, Problem, ReferenceKind, TabulatedContact
from verification.references import load_reference

SOURCE = "references/coated_frictionless_paraboloid.json: Fredholm equation, two settings agree"
ROWS = load_reference("coated_frictionless_paraboloid")["rows"]
BARE = hertzian(pressed("Rigid ball on the uncoated half-space", rigid_ball(), coated()))


def coated_ball(row: Mapping[str, Any]) -> Problem:
    """Create the problem of a rigid ball on a coated body from one row of the tabulated reference.

    row  numbers relative to the Hertz contact of the substrate, modulus ratio E1/E2 of coating and
         substrate, and coating thickness over the Hertz radius
    """
    contact = TabulatedContact(row)
    ratio, thickness = row["E1_over_E2"], row["h_over_aH"]
    title = f"Rigid ball on a coating, E1/E2 = {ratio:g}, h = {thickness:g} a_H"
    return Problem(
        pressed(title, rigid_ball(), coated(film(ratio, thickness))),
        (contact,),
        contact.contact_radius,
        SOURCE,
        ReferenceKind.SEMI_CLOSED,
        row["est_rel_error"],
        {OVER_PEAK: HERTZ.peak_pressure},
        equations=(FREDHOLM_EQUATION,),
    )


def solved_here(problem: Problem) -> Problem:
    """Replace the tabulated answer of a coated problem by the semi-closed solution of its contact.

    The semi-closed solution gives the pressure at every radius.
    """
    exact = exact_contact(problem.scene.body)
    return replace(
        problem, ends=(exact,), radius=exact.contact_radius, source=FREDHOLM,
        uncertainty=SEMI_CLOSED_ERROR,
    )  # fmt: skip
