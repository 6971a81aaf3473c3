"""A coating whose Poisson's ratio is not its substrate's, by both solvers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from contact_scene import Body, IsotropicMaterial, Layer
from semi_analytical.frf.stack import Film, HalfSpace, Stack
from semi_analytical.frf.surface import scalars
from verification.cases.fem_levels import allowed, because, finest
from verification.closed_forms.coated_indentation import (
    LayeredIndentation,
    LayeredSurface,
    paraboloid_under,
)
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.ladder import cells_label
from verification.judging.refinement import part_of_a_cell
from verification.judging.run import Run, SectionRun, per_radius
from verification.observed.end_state import approach, central_pressure, contact_radius
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import pressed, rigid_ball, semi_closed
from verification.problems.paper_scene import HERTZ

CELLS = 128
ASKED = "asked of coated bodies on 128 x 128 cells, as in coated_paraboloid"
THICKNESS = 0.5 * HERTZ.contact_radius
MODULUS = 210e9


@dataclass(frozen=True)
class UnlikeRatios:
    """One Young's modulus throughout: only Poisson's ratios tell the layer from its substrate."""

    film: float
    substrate: float

    @property
    def name(self) -> str:
        """For labels."""
        return f"ν = {self.film:g} on ν = {self.substrate:g}"

    @property
    def body(self) -> Body:
        """The coated body of the scene."""
        return Body(
            material=_material(self.substrate),
            layers=(Layer(thickness=THICKNESS, material=_material(self.film)),),
        )

    @cached_property
    def exact(self) -> LayeredIndentation:
        """Of constants that are written down here once more: a stack that were made of the scene
        would share its mistakes."""
        film, substrate = _shear_modulus(self.film), _shear_modulus(self.substrate)
        stack = Stack([Film(film, self.film, THICKNESS)], HalfSpace(substrate, self.substrate))

        def compliance(k: NDArray[np.float64]) -> NDArray[np.float64]:
            return scalars(stack, k).c22

        surface = LayeredSurface(compliance, 2 * film / (1 - self.film), THICKNESS)
        return paraboloid_under(paper.NORMAL_FORCE, surface, paper.RADIUS)

    def surface_run(self) -> Run:
        """On cells."""
        half_width = paper.WINDOW_PER_RADIUS / 2 * self.exact.contact_radius
        grid = paper.square_grid(CELLS, half_width)
        scene = pressed(f"Rigid ball on a coating, {self.name}", rigid_ball(), self.body)
        return Run(f"{self.name}, {cells_label(CELLS)}", scene, grid, problem=self.name)

    def section_run(self, elements: int) -> SectionRun:
        """By finite elements."""
        scene = pressed(
            f"Rigid ball on a coating, {self.name}, by finite elements", rigid_ball(), self.body
        )
        name = f"{self.name}, {elements} elements"
        return SectionRun(name, scene, per_radius(elements), problem=self.name)

    def quantities(self, elements: int) -> tuple[Quantity, ...]:
        """What is judged."""
        cells, mesh = self.surface_run().label, self.section_run(elements).label
        cell = part_of_a_cell(0.1, CELLS, paper.WINDOW_PER_RADIUS)
        by_mesh = Required(allowed(1e-4, elements, 2), because(2))
        by_cells = Required(2e-4, ASKED)
        exact = self.exact
        figures = (
            ("approach", "approach since first touch", "m", approach, exact.approach,
             by_cells, cells),
            ("contact_radius", "√(contact area / π), cells at the edge counted in part", "m",
             contact_radius, exact.contact_radius, Required(cell, "a tenth of a cell"), cells),
            ("central_pressure", "pressure of the cells around the axis", "Pa",
             central_pressure, float(exact.pressure(0.0)), by_cells, cells),
            ("approach", "approach since first touch", "m", approach, exact.approach,
             by_mesh, mesh),
            ("contact_radius", "where the pressure ends, from its last two values", "m",
             contact_radius, exact.contact_radius,
             Required(2e-3, "asked of the finite elements at 64 per radius"), mesh),
            ("central_pressure", "pressure on the axis", "Pa", central_pressure,
             float(exact.pressure(0.0)), by_mesh, mesh),
        )  # fmt: skip
        return tuple(
            Quantity(name, meaning, unit, run, measure, semi_closed(value), tolerance)
            for name, meaning, unit, measure, value, tolerance, run in figures
        )


PAIRS = (UnlikeRatios(0.1, 0.45), UnlikeRatios(0.45, 0.1))


def coated_unlike_ratios(level: Level = Level.QUICK) -> Case:
    """The case, on a finer mesh at higher levels."""
    n = finest(level)
    return Case(
        name="coated_unlike_ratios",
        title="Coatings of another Poisson's ratio",
        problem=(
            "The paper's ball, rigid, under 1 kN on a layer of half a Hertz radius that has the "
            "Young's modulus of its substrate and another Poisson's ratio. The other coated cases "
            "have one ratio throughout, and would not see the two exchanged."
        ),
        runs=tuple(run for pair in PAIRS for run in (pair.surface_run(), pair.section_run(n))),
        quantities=tuple(quantity for pair in PAIRS for quantity in pair.quantities(n)),
    )


def _material(ratio: float) -> IsotropicMaterial:
    return IsotropicMaterial(young_modulus=MODULUS, poisson_ratio=ratio)


def _shear_modulus(ratio: float) -> float:
    return MODULUS / (2 * (1 + ratio))
