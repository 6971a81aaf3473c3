"""Hertz contact with an elliptical contact area."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import Ellipsoid, LoadStep
from semi_analytical.grid import SurfaceGrid
from verification.cases.hertz_point import label
from verification.closed_forms.elliptical_contact import EllipticalContact
from verification.exhibits.chart import Chart
from verification.exhibits.profile_chart import Profile, ProfileLabels, Section, profile_chart
from verification.judging.case import Case, Derived, Level, Quantity
from verification.judging.order_of_convergence import Followed, OrderOfConvergence
from verification.judging.refinement import part_of_a_cell, refinement
from verification.judging.run import Run
from verification.norms import relative_l2
from verification.observed.end_state import approach, contact_radius, peak_pressure
from verification.problems import paper_scene as paper
from verification.problems.reference import closed_form

if TYPE_CHECKING:
    from semi_analytical import Result

SOURCE = "Hertz 1882, by Carlson's elliptic integrals"
RADII = (90e-3, 18e-3)
EXACT = EllipticalContact.under_load(paper.NORMAL_FORCE, RADII, paper.CONTACT_MODULUS)
SCENE = paper.frictionless(
    "Barrel on a half-space (radii 90 mm and 18 mm)",
    Ellipsoid(radii=RADII, material=paper.STEEL),
    paper.STEEL,
    LoadStep(normal_force=paper.NORMAL_FORCE),
)


def hertz_elliptical(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return hertz_elliptical_on(refinement(32, 256 if level is Level.QUICK else 512))


def hertz_elliptical_on(cells: tuple[int, ...]) -> Case:
    """The case on grids of these many cells per side, in proportion to the ellipse."""
    runs = tuple(Run(label(n), SCENE, _grid(n)) for n in cells)
    levels = tuple(run.label for run in runs)
    finest = levels[-1]
    mean_radius = float(np.sqrt(EXACT.semi_axes[0] * EXACT.semi_axes[1]))
    return Case(
        name="hertz_elliptical",
        title="Elliptical Hertz contact",
        problem=(
            "A barrel with principal radii of 90 mm and 18 mm: the contact is an ellipse with "
            f"b/a = {EXACT.axis_ratio:.4f}. Cells are oblong like the window, three semi-axes "
            "along each side."
        ),
        runs=runs,
        quantities=(
            Quantity(
                "peak_pressure", "largest pressure of any cell", "Pa", finest, peak_pressure,
                closed_form(EXACT.peak_pressure, SOURCE),
                Derived(levels, 2.0, 1.5e-4, "order 2; the cap is the figure required of "
                        "hertz_point at 128 x 128"),
            ),
            Quantity(
                "approach", "approach of the bodies since first touch", "m", finest, approach,
                closed_form(EXACT.approach, SOURCE),
                Derived(levels, 2.0, 5e-5, "order 2; the cap is the figure required of "
                        "hertz_point"),
            ),
            Quantity(
                "mean_contact_radius", "√(contact area / π) = √(ab)", "m", finest, contact_radius,
                closed_form(mean_radius, SOURCE),
                Derived(levels, 1.0, part_of_a_cell(0.1, cells[-1], paper.WINDOW_PER_RADIUS),
                        "order 1: the edge is known to a part of a cell; the cap is a tenth of "
                        "a cell along the longer axis"),
            ),
        ),
        orders=(
            OrderOfConvergence(
                "order_of_pressure", Followed.PRESSURE,
                "pressure over the window, L2", levels, pressure_error, 1.0,
                "square-root edge, as for the circle",
            ),
        ),
        charts=_charts,
    )  # fmt: skip


def pressure_error(result: Result) -> float:
    """Relative L2 error of the pressure."""
    return relative_l2(result.steps[-1].pressure, EXACT.pressure(*result.grid.coordinates()))


def _grid(cells: int) -> SurfaceGrid:
    a, b = EXACT.semi_axes
    window = (paper.WINDOW_PER_RADIUS * a, paper.WINDOW_PER_RADIUS * b)
    return SurfaceGrid((cells, cells), window)


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    finest = list(results.values())[-1]
    section = Section(finest.grid, EXACT.semi_axes[0])
    profile = Profile(
        "computed",
        section.of(finest.steps[-1].pressure) / EXACT.peak_pressure,
        EXACT.pressure(section.x, section.y) / EXACT.peak_pressure,
    )
    labels = ProfileLabels(
        "elliptical_profile",
        "Pressure along the long axis of the ellipse",
        "Computed pressure on the row of cells next to y = 0 over the exact one, and their "
        "difference.",
        "p / p₀",
    )
    return (profile_chart(labels, section, [profile]),)
