"""One coated contact said in several ways, and coated bodies that are homogeneous ones."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from contact_scene import RIGID, Body, IsotropicMaterial, Layer, Paraboloid
from verification.cases.levels import ASKED
from verification.judging.case import Case, Comparison, Level, Quantity, Required
from verification.judging.run import Run
from verification.observed.end_state import approach, central_pressure, peak_pressure
from verification.problems import paper_scene as paper
from verification.problems.hertz import SOURCE
from verification.problems.layered_scene import (
    SUBSTRATE,
    coated,
    exact_contact,
    film,
    pressed,
    rigid_ball,
    semi_closed,
)
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import closed_form

if TYPE_CHECKING:
    from semi_analytical import Result

CELLS = 128
COATING = film(2.0, 1.0)
# Both solves stop within the solver's tolerance of the same answer.
SAME = 1e-7
SAME_BECAUSE = "the solver's tolerance, times ten"


def _part(layer: Layer, part: float) -> Layer:
    return Layer(thickness=part * layer.thickness, material=layer.material)


def _ball(*layers: Layer, material: IsotropicMaterial) -> Paraboloid:
    return Paraboloid(radius=paper.RADIUS, material=material, layers=layers)


BALL = IsotropicMaterial(young_modulus=300e9, poisson_ratio=0.25)
ELASTIC_PAIRS = {
    "elastic ball on the coating": (_ball(material=BALL), coated(COATING)),
    "coated ball on another coating": (
        _ball(film(0.5, 0.3), material=BALL),
        coated(film(4.0, 0.5), film(0.25, 0.2)),
    ),
    "soft film on a hard one": (rigid_ball(), coated(film(0.5, 0.2), film(4.0, 0.3))),
}
SAME_CONTACT = {
    "coated body": (rigid_ball(), coated(COATING)),
    "coated ball on a rigid body": (
        _ball(COATING, material=SUBSTRATE),
        Body(material=RIGID),
    ),
    "coating cut in three": (
        rigid_ball(),
        coated(_part(COATING, 0.2), _part(COATING, 0.5), _part(COATING, 0.3)),
    ),
    "substrate as a further layer": (rigid_ball(), coated(COATING, film(1.0, 0.7))),
}
HOMOGENEOUS = {
    "layer of the substrate's material": (rigid_ball(), coated(film(1.0, 0.5))),
    "three such layers": (
        rigid_ball(),
        coated(film(1.0, 0.1), film(1.0, 0.2), film(1.0, 3.0)),
    ),
}


def layered_identities(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    return layered_identities_on(CELLS)


def layered_identities_on(cells: int) -> Case:
    """The case on a square grid of this many cells per side."""
    pairs = {**SAME_CONTACT, **HOMOGENEOUS, **ELASTIC_PAIRS}
    runs = {
        name: Run(name, pressed(name, *pair), paper.hertz_grid(cells), problem=name)
        for name, pair in pairs.items()
    }
    first, *others = SAME_CONTACT
    return Case(
        name="layered_identities",
        title="Coatings on either body, cut or made of the substrate",
        problem=(
            "A contact does not know which body carries the coating, whether it is one layer or "
            "three of the same material, or whether the substrate begins as a layer; and a layer "
            "of the substrate's material is none. Pairs of elastic, both coated bodies are "
            "compared with the semi-closed solution for the sum of their responses."
        ),
        runs=tuple(runs.values()),
        comparisons=tuple(
            Comparison(
                "same_pressure", "largest difference of the pressure over the largest pressure",
                (other, first), pressure_difference, SAME, SAME_BECAUSE,
                "the same bodies in other words",
            )
            for other in others
        ),
        quantities=(
            *(
                quantity
                for name in HOMOGENEOUS
                for quantity in (
                    Quantity(
                        "approach", "approach of the bodies since first touch", "m", name,
                        approach, closed_form(HERTZ.approach, SOURCE), Required(5e-5, ASKED),
                    ),
                    Quantity(
                        "peak_pressure", "largest pressure of any cell", "Pa", name,
                        peak_pressure, closed_form(HERTZ.peak_pressure, SOURCE),
                        Required(1.5e-4, ASKED),
                    ),
                )
            ),
            *(q for name, pair in ELASTIC_PAIRS.items() for q in _against_exact(name, *pair)),
        ),
    )  # fmt: skip


def pressure_difference(one: Result, other: Result) -> float:
    """Largest difference of the pressures over the largest pressure."""
    p, q = one.steps[-1].pressure, other.steps[-1].pressure
    return float(np.max(np.abs(p - q)) / np.max(q))


def _against_exact(name: str, ball: Paraboloid, body: Body) -> tuple[Quantity, Quantity]:
    exact = exact_contact(body, Body(material=ball.material, layers=ball.layers))
    tolerance = Required(2e-4, f"{ASKED}, for coated bodies")
    return (
        Quantity(
            "approach", "approach of the bodies since first touch", "m", name, approach,
            semi_closed(exact.approach), tolerance,
        ),
        Quantity(
            "central_pressure", "pressure of the four cells around the axis", "Pa", name,
            central_pressure, semi_closed(float(exact.pressure(0.0))), tolerance,
        ),
    )  # fmt: skip
