"""A cone on a half-space: pressure with a logarithmic peak under the apex."""

from __future__ import annotations

from collections.abc import Mapping
from math import radians
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import Cone, LoadStep
from verification.closed_forms.cone import ConeContact
from verification.exhibits.chart import Chart
from verification.exhibits.profile_chart import Profile, ProfileLabels, Section, profile_chart
from verification.judging.case import Case, Derived, Level, Quantity
from verification.judging.ladder import cells_label
from verification.judging.order_of_convergence import Followed, OrderOfConvergence
from verification.judging.refinement import part_of_a_cell, refinement
from verification.judging.run import Run
from verification.norms import relative_l1
from verification.observed.end_state import approach, contact_radius
from verification.problems import paper_scene as paper
from verification.problems.reference import closed_form

if TYPE_CHECKING:
    from semi_analytical import Result

SOURCE = "Love 1939; Sneddon 1965"
SLOPE = radians(1.0)
EXACT = ConeContact.under_load(paper.NORMAL_FORCE, SLOPE, paper.CONTACT_MODULUS)
MEAN_PRESSURE = EXACT.load / (np.pi * EXACT.contact_radius**2)
SCENE = paper.frictionless(
    "Cone on a half-space (flank at 1°)",
    Cone(slope_angle=SLOPE, material=paper.STEEL),
    paper.STEEL,
    LoadStep(normal_force=paper.NORMAL_FORCE),
)


def cone_contact(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return cone_contact_on(refinement(32, 128 if level is Level.QUICK else 256))


def cone_contact_on(cells: tuple[int, ...]) -> Case:
    """The case on square grids of these many cells per side."""
    half_width = paper.WINDOW_PER_RADIUS / 2 * EXACT.contact_radius
    runs = tuple(Run(cells_label(n), SCENE, paper.square_grid(n, half_width)) for n in cells)
    levels = tuple(run.label for run in runs)
    finest = levels[-1]
    return Case(
        name="cone_contact",
        title="Cone on a half-space",
        problem=(
            "A cone whose flanks rise by 1° under 1 kN. The pressure is infinite under the apex, "
            "as a logarithm, and falls to zero at the edge."
        ),
        runs=runs,
        quantities=(
            Quantity(
                "approach", "approach of the bodies since first touch", "m", finest, approach,
                closed_form(EXACT.approach, SOURCE),
                Derived(levels, 2.0, 1e-4, "order 2: the apex falls between cells and moves the "
                        "load of a few of them; the cap is twice what is required of the ball"),
            ),
            Quantity(
                "contact_radius", "√(contact area / π), cells at the edge counted in part", "m",
                finest, contact_radius, closed_form(EXACT.contact_radius, SOURCE),
                Derived(levels, 1.0, part_of_a_cell(0.1, cells[-1], paper.WINDOW_PER_RADIUS),
                        "order 1: the edge is known to a part of a cell; the cap is a tenth of "
                        "a cell"),
            ),
        ),
        orders=(
            OrderOfConvergence(
                "order_of_pressure", Followed.PRESSURE,
                "pressure over the window, L1", levels, pressure_error, 1.5,
                "at the edge O(√h) on a ring one cell wide; the logarithm at the apex is O(1) in "
                "a few cells, O(h²)",
            ),
        ),
        charts=_charts,
        limits=("The pressure of the cells at the apex is an average of an infinite peak.",),
    )  # fmt: skip


def pressure_error(result: Result) -> float:
    """Relative L1 error of the pressure."""
    return relative_l1(
        result.steps[-1].pressure, EXACT.pressure(np.hypot(*result.grid.coordinates()))
    )


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    finest = list(results.values())[-1]
    section = Section(finest.grid, EXACT.contact_radius)
    profile = Profile(
        "computed",
        section.of(finest.steps[-1].pressure) / MEAN_PRESSURE,
        EXACT.pressure(section.r) / MEAN_PRESSURE,
    )
    labels = ProfileLabels(
        "cone_profile",
        "Pressure next to y = 0",
        "Computed pressure over the exact one, in units of the mean pressure, and their "
        "difference.",
        "p / mean p",
    )
    return (profile_chart(labels, section, [profile]),)
