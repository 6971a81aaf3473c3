"""The paper's ball with its exact arc, and how far that is from the paraboloid."""

from __future__ import annotations

from contact_scene import LoadStep, Sphere
from verification.cases.hertz_point import label
from verification.closed_forms.sphere import SphereContact
from verification.judging.case import Case, Derived, Finding, Level, Quantity
from verification.judging.refinement import part_of_a_cell, refinement
from verification.judging.run import Run
from verification.observed.end_state import approach, contact_radius, peak_pressure
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import ROUNDING, Reference, ReferenceKind

SOURCE = "Sneddon 1965, arc of a circle, by Gauss quadrature"
EXACT = SphereContact.under_load(paper.NORMAL_FORCE, paper.RADIUS, paper.CONTACT_MODULUS)
SCENE = paper.frictionless(
    "Ball with its exact arc on a half-space",
    Sphere(radius=paper.RADIUS, material=paper.STEEL),
    paper.STEEL,
    LoadStep(normal_force=paper.NORMAL_FORCE),
)


def hertz_exact_sphere(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return hertz_exact_sphere_on(refinement(64, 256 if level is Level.QUICK else 512))


def hertz_exact_sphere_on(cells: tuple[int, ...]) -> Case:
    """The case on square grids of these many cells per side."""
    runs = tuple(Run(label(n), SCENE, paper.hertz_grid(n)) for n in cells)
    levels = tuple(run.label for run in runs)
    finest = levels[-1]
    return Case(
        name="hertz_exact_sphere",
        title="Ball with its exact arc",
        problem=(
            "The ball of hertz_point as a circular arc in the same half-space. Its exact solution "
            "is an integral; it differs from Hertz's by a²/R² times numbers near 1/15, far less "
            "than any measurement but more than the error of the solver."
        ),
        runs=runs,
        quantities=(
            Quantity(
                "approach", "approach of the bodies since first touch", "m", finest, approach,
                _reference(EXACT.approach),
                Derived(levels, 2.0, 1e-5, "order 2 as for the paraboloid; the cap is a third of "
                        "the distance from Hertz's approach, so that the two can be told apart"),
            ),
            Quantity(
                "peak_pressure", "largest pressure of any cell", "Pa", finest, peak_pressure,
                _reference(EXACT.peak_pressure),
                Derived(levels, 2.0, 4e-5, "order 2: distance of the centre from the next cell "
                        "centre; the cap is the figure required of the paraboloid at 256 x 256"),
            ),
            Quantity(
                "contact_radius", "√(contact area / π), cells at the edge counted in part", "m",
                finest, contact_radius, _reference(EXACT.contact_radius),
                Derived(levels, 1.0, part_of_a_cell(0.1, cells[-1], paper.WINDOW_PER_RADIUS),
                        "as for the paraboloid"),
            ),
        ),
        findings=(
            Finding(
                "approach_beyond_hertz", "computed approach over Hertz's, less one", "", finest,
                lambda result: approach(result) / HERTZ.approach - 1,
                f"the closed forms differ by {EXACT.approach / HERTZ.approach - 1:.2e}",
            ),
            Finding(
                "peak_pressure_beyond_hertz", "computed peak pressure over Hertz's, less one", "",
                finest, lambda result: peak_pressure(result) / HERTZ.peak_pressure - 1,
                "the closed forms differ by "
                f"{EXACT.peak_pressure / HERTZ.peak_pressure - 1:.2e}; the largest cell value is "
                "low by h²/4a²",
            ),
        ),
        limits=("Linear elasticity of a half-space: large strains are another matter.",),
    )  # fmt: skip


def _reference(value: float) -> Reference:
    return Reference(value, ReferenceKind.SEMI_CLOSED, SOURCE, 100 * ROUNDING * value)
