"""Thin layers on a rigid base: a foundation of springs, and an incompressible film."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, partial
from math import pi
from typing import TYPE_CHECKING

from contact_scene import RIGID, Body, IsotropicMaterial, Layer, LoadStep
from verification.closed_forms.coated_indentation import LayeredIndentation, paraboloid
from verification.judging.case import Case, Check, Finding, Level, Quantity, Required
from verification.judging.ladder import cells_label
from verification.judging.refinement import part_of_a_cell
from verification.judging.run import Run
from verification.observed.end_state import central_pressure, contact_radius, normal_force
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import pressed, rigid_ball, semi_closed, surface_of
from verification.problems.reference import Reference, ReferenceKind

if TYPE_CHECKING:
    from semi_analytical import Result

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


def thin_layer(level: Level = Level.QUICK) -> Case:
    """The case, on a finer grid above the quick level."""
    return thin_layer_on(256 if level is Level.QUICK else 512)


def thin_layer_on(cells: int) -> Case:
    """The case on a square grid of this many cells per side."""
    grid = paper.square_grid(cells, 1.1 * RADIUS)
    runs = tuple(
        Run(
            layer.name,
            pressed(
                f"Rigid ball on a thin layer on a rigid base, {layer.name}",
                rigid_ball(), layer.body, LoadStep(approach=layer.exact.approach),
            ),
            grid,
        )
        for layer in LAYERS
    )  # fmt: skip
    return Case(
        name="thin_layer",
        title="Thin layers on a rigid base",
        problem=(
            "A rigid ball on a layer much thinner than the contact, on a rigid base, pressed by "
            "the approach that belongs to a given contact radius. A compressible layer becomes a "
            "foundation of springs, an incompressible one lets nothing but flow along the base "
            "give way: its response vanishes as the square of the wavenumber, and ν = ½ is exact. "
            "Both limits are approached slowly, so the loads of the full solution are compared."
        ),
        runs=runs,
        checks=tuple(_ratio(layer) for layer in LAYERS),
        quantities=tuple(q for layer in LAYERS for q in _solved(layer, cells)),
        findings=tuple(
            Finding(
                "load_over_leading_term", "load over the leading term for a >> h", "", layer.name,
                partial(_over_leading_term, layer),
                "the limit itself is 1",
            )
            for layer in LAYERS
        ),
        limits=(f"On {cells_label(cells)} cells only; the orders are those of coated_paraboloid.",),
    )  # fmt: skip


def _over_leading_term(layer: ThinLayer, result: Result) -> float:
    return normal_force(result) / layer.leading_load


def _ratio(layer: ThinLayer) -> Check:
    return Check(
        "semi_closed_load", "load over the leading term, from the semi-closed solution", "",
        layer.name, lambda: layer.exact.load / layer.leading_load,
        Reference(layer.load_ratio, ReferenceKind.SEMI_CLOSED, PRINTED, 0.5 * SIX_DIGITS),
        Required(SIX_DIGITS, "the digits that are given"),
    )  # fmt: skip


def _solved(layer: ThinLayer, cells: int) -> tuple[Quantity, ...]:
    exact = layer.exact
    because = (
        "twice what is required of coatings at 128 x 128: layer and contact have scales of their "
        "own"
    )
    return (
        Quantity(
            "normal_force", "force that the approach takes", "N", layer.name, normal_force,
            semi_closed(exact.load), Required(4e-4, because),
        ),
        Quantity(
            "central_pressure", "pressure of the four cells around the axis", "Pa", layer.name,
            central_pressure, semi_closed(float(exact.pressure(0.0))), Required(4e-4, because),
        ),
        Quantity(
            "contact_radius", "√(contact area / π), cells at the edge counted in part", "m",
            layer.name, contact_radius, semi_closed(exact.contact_radius),
            Required(part_of_a_cell(0.5, cells, 2.2), "half a cell"),
        ),
    )  # fmt: skip
