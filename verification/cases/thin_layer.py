"""Thin layers on a rigid base: a foundation of springs, and an incompressible film."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import pi

from contact_scene import RIGID, Body, IsotropicMaterial, Layer, LoadStep
from verification.closed_forms.coated_indentation import LayeredIndentation, paraboloid
from verification.judging.case import Case, Check, Level, Required
from verification.judging.declared_case import Reported, Row, Within, case, judged
from verification.judging.ladder import cells_label, named, on_cells, part_of_side
from verification.judging.observable import error_norm
from verification.judging.observables import CENTRAL_PRESSURE, CONTACT_RADIUS, NORMAL_FORCE
from verification.observed.end_state import normal_force
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import (
    FREDHOLM,
    SEMI_CLOSED_ERROR,
    pressed,
    rigid_ball,
    surface_of,
)
from verification.problems.problem import Problem
from verification.problems.reference import Reference, ReferenceKind

MODULUS = 10e6  # of the layer [Pa]; rubber
RADIUS = 2e-3  # of the contact [m]
SIX_DIGITS = 1e-6
PRINTED = "computed apart from this program: two settings agree to the digits given"


@dataclass(frozen=True)
class ThinLayer:
    """A layer of a/h contact radii per thickness, under the ball; with its exact load ratio.

    load_ratio  load over the leading term for a >> h, from outside
    """

    poisson_ratio: float
    a_over_h: float
    load_ratio: float

    @property
    def name(self) -> str:
        """For labels."""
        return f"ν = {self.poisson_ratio:g}, a/h = {self.a_over_h:g}"

    @property
    def body(self) -> Body:
        """The layer bonded to a rigid base."""
        material = IsotropicMaterial(young_modulus=MODULUS, poisson_ratio=self.poisson_ratio)
        return Body(
            material=RIGID, layers=(Layer(thickness=RADIUS / self.a_over_h, material=material),)
        )

    @cached_property
    def exact(self) -> LayeredIndentation:
        """The semi-closed solution at this contact radius."""
        return paraboloid(surface_of(self.body), paper.RADIUS, RADIUS)

    @property
    def problem(self) -> Problem:
        """Led to the approach of that solution."""
        scene = pressed(
            f"Rigid ball on a thin layer on a rigid base, {self.name}",
            rigid_ball(),
            self.body,
            LoadStep(approach=self.exact.approach),
        )
        return Problem(
            scene, (self.exact,), RADIUS, FREDHOLM, ReferenceKind.SEMI_CLOSED, SEMI_CLOSED_ERROR
        )

    @property
    def leading_load(self) -> float:
        """Leading term of the load for a >> h (Johnson 1985, section 5.8)."""
        E, nu, h, R = MODULUS, self.poisson_ratio, RADIUS / self.a_over_h, paper.RADIUS
        if nu == 0.5:
            return pi * E / 3 * RADIUS**6 / (32 * R * h**3)
        uniaxial = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        return pi * uniaxial * RADIUS**4 / (4 * R * h)


LAYERS = (
    ThinLayer(0.3, 5.0, 1.104343),
    ThinLayer(0.3, 20.0, 1.024688),
    ThinLayer(0.5, 10.0, 2.233304),
)


BECAUSE = (
    "twice what is required of coatings at 128 x 128: layer and contact have scales of their own"
)


def rows(layer: ThinLayer) -> tuple[Row, ...]:
    """What is judged of a layer."""
    over_leading_term = error_norm(
        "load_over_leading_term", "load over the leading term for a >> h",
        lambda result, *_: normal_force(result) / layer.leading_load,
    )  # fmt: skip
    return (
        Within(NORMAL_FORCE, 4e-4, BECAUSE),
        Within(CENTRAL_PRESSURE, 4e-4, BECAUSE),
        Within(CONTACT_RADIUS, part_of_side(0.5), "half a cell"),
        Reported(over_leading_term, "the limit itself is 1"),
    )


def thin_layer(level: Level = Level.QUICK) -> Case:
    """The case, on a finer grid above the quick level."""
    return thin_layer_on(256 if level is Level.QUICK else 512)


def thin_layer_on(cells: int) -> Case:
    """The case on a square grid of this many cells per side."""
    return case(
        "thin_layer",
        "Thin layers on a rigid base",
        "A rigid ball on a layer much thinner than the contact, on a rigid base, pressed by "
        "the approach that belongs to a given contact radius. A compressible layer becomes a "
        "foundation of springs, an incompressible one lets nothing but flow along the base "
        "give way: its response vanishes as the square of the wavenumber, and ν = ½ is exact. "
        "Both limits are approached slowly, so the loads of the full solution are compared.",
        *(
            judged(named(layer.name, on_cells(layer.problem, (cells,), 2.2)), rows(layer))
            for layer in LAYERS
        ),
        checks=tuple(_ratio(layer) for layer in LAYERS),
        limits=(f"On {cells_label(cells)} cells only; the orders are those of coated_paraboloid.",),
    )


def _ratio(layer: ThinLayer) -> Check:
    return Check(
        "semi_closed_load", "load over the leading term, from the semi-closed solution", "",
        layer.name, lambda: layer.exact.load / layer.leading_load,
        Reference(layer.load_ratio, ReferenceKind.SEMI_CLOSED, PRINTED, 0.5 * SIX_DIGITS),
        Required(SIX_DIGITS, "the digits that are given"),
    )  # fmt: skip
