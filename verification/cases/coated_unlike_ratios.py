"""A coating whose Poisson's ratio is not its substrate's, by both solvers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact_scene import Body, IsotropicMaterial, Layer
from semi_analytical.frf.stack import Film, HalfSpace, Stack
from semi_analytical.frf.surface import scalars
from verification.cases.levels import because, finest
from verification.closed_forms.coated_indentation import LayeredSurface, paraboloid_under
from verification.judging.case import Case, Level
from verification.judging.declared_case import Within, case, judged
from verification.judging.ladder import asked, named, on_cells, on_elements, part_of_side
from verification.judging.observables import APPROACH, CENTRAL_PRESSURE, CONTACT_RADIUS
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import (
    FREDHOLM,
    SEMI_CLOSED_ERROR,
    pressed,
    rigid_ball,
)
from verification.problems.paper_scene import HERTZ
from verification.problems.problem import Problem
from verification.problems.reference import ReferenceKind

CELLS = 128
ASKED = "asked of coated bodies on 128 x 128 cells, as in coated_paraboloid"
THICKNESS = 0.5 * HERTZ.contact_radius
MODULUS = 210e9
ON_CELLS = (
    Within(APPROACH, 2e-4, ASKED),
    Within(CONTACT_RADIUS, part_of_side(0.1), "a tenth of a cell"),
    Within(CENTRAL_PRESSURE, 2e-4, ASKED),
)
ON_ELEMENTS = (
    Within(APPROACH, asked(1e-4, 2), because(2)),
    Within(CONTACT_RADIUS, 2e-3, "asked of the finite elements at 64 per radius"),
    Within(CENTRAL_PRESSURE, asked(1e-4, 2), because(2)),
)


def unlike_ratios(film: float, substrate: float) -> Problem:
    """The ball on a layer of one Poisson's ratio on a body of another: one Young's modulus
    throughout, so that only the ratios tell them apart.

    The answer is of constants that are written down here once more: a stack that were made of the
    scene would share its mistakes.
    """
    material, film_material = (
        IsotropicMaterial(young_modulus=MODULUS, poisson_ratio=ratio) for ratio in (substrate, film)
    )
    body = Body(material=material, layers=(Layer(thickness=THICKNESS, material=film_material),))
    of_film, of_substrate = (MODULUS / (2 * (1 + ratio)) for ratio in (film, substrate))
    stack = Stack([Film(of_film, film, THICKNESS)], HalfSpace(of_substrate, substrate))

    def compliance(k: NDArray[np.float64]) -> NDArray[np.float64]:
        return scalars(stack, k).c22

    surface = LayeredSurface(compliance, 2 * of_film / (1 - film), THICKNESS)
    exact = paraboloid_under(paper.NORMAL_FORCE, surface, paper.RADIUS)
    return Problem(
        pressed(f"Rigid ball on a coating, ν = {film:g} on ν = {substrate:g}", rigid_ball(), body),
        (exact,),
        exact.contact_radius,
        FREDHOLM,
        ReferenceKind.SEMI_CLOSED,
        SEMI_CLOSED_ERROR,
    )


def coated_unlike_ratios(level: Level = Level.QUICK) -> Case:
    """The case, on a finer mesh at higher levels."""
    n = finest(level)
    pairs = {
        f"ν = {film:g} on ν = {substrate:g}": unlike_ratios(film, substrate)
        for film, substrate in ((0.1, 0.45), (0.45, 0.1))
    }
    return case(
        "coated_unlike_ratios",
        "Coatings of another Poisson's ratio",
        "The paper's ball, rigid, under 1 kN on a layer of half a Hertz radius that has the "
        "Young's modulus of its substrate and another Poisson's ratio. The other coated cases "
        "have one ratio throughout, and would not see the two exchanged.",
        *(judged(on_cells(pair, (CELLS,), of=name), ON_CELLS) for name, pair in pairs.items()),
        *(
            judged(named(f"{name}, {n} elements", on_elements(pair, (n,), of=name)), ON_ELEMENTS)
            for name, pair in pairs.items()
        ),
    )
