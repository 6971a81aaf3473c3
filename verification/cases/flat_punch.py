"""A flat punch on a half-space: the pressure is infinite at the rim."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import FlatPunch, LoadStep
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.exhibits.chart import Chart
from verification.exhibits.convergence_chart import convergence_chart
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.ladder import cells_label
from verification.judging.refinement import refinement
from verification.judging.run import Run
from verification.observed.end_state import approach, central_pressure
from verification.problems import paper_scene as paper
from verification.problems.reference import closed_form

if TYPE_CHECKING:
    from semi_analytical import Result

SOURCE = "Boussinesq 1885; Johnson 1985, ch. 3.4"
EXACT = FlatPunchContact(0.4e-3, paper.CONTACT_MODULUS, paper.NORMAL_FORCE)
MEAN_PRESSURE = EXACT.load / (np.pi * EXACT.contact_radius**2)
WINDOW_PER_RADIUS = 2.2
SCENE = paper.frictionless(
    "Flat punch on a half-space",
    FlatPunch(radius=EXACT.contact_radius, material=paper.STEEL),
    paper.STEEL,
    LoadStep(normal_force=paper.NORMAL_FORCE),
)


def flat_punch(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return flat_punch_on(refinement(32, 128 if level is Level.QUICK else 256))


def flat_punch_on(cells: tuple[int, ...]) -> Case:
    """The case on square grids of these many cells per side."""
    half_width = WINDOW_PER_RADIUS / 2 * EXACT.contact_radius
    runs = tuple(Run(cells_label(n), SCENE, paper.square_grid(n, half_width)) for n in cells)
    finest = runs[-1].label
    cell = runs[-1].grid.spacing[0] / EXACT.contact_radius
    staircase = (
        "the rim is a staircase of cells and carries an infinite pressure, so the punch seems "
        "larger or smaller by a part of a cell"
    )
    return Case(
        name="flat_punch",
        title="Flat punch on a half-space",
        problem=(
            "A flat-ended cylinder of 0.4 mm radius under 1 kN. Contact radius and approach are "
            "proportional; the pressure is singular at the rim, as 1/√(distance)."
        ),
        runs=runs,
        quantities=(
            Quantity(
                "approach", "approach of the bodies since first touch", "m", finest, approach,
                closed_form(EXACT.approach, SOURCE),
                Required(cell / 2, f"half a cell over the radius: {staircase}"),
            ),
            Quantity(
                "central_pressure", "pressure of the cells around the axis", "Pa", finest,
                central_pressure, closed_form(float(EXACT.pressure(0.0)), SOURCE),
                Required(cell, f"one cell over the radius: pressure goes as 1/radius², and "
                         f"{staircase}"),
            ),
        ),
        charts=_charts,
        limits=(
            "First order in the cell side with scatter: how the circle cuts the cells differs from "
            "grid to grid, so no order is judged.",
        ),
    )  # fmt: skip


def _charts(results: Mapping[str, Result]) -> tuple[Chart, ...]:
    runs = list(results.values())
    exact = float(EXACT.pressure(0.0))
    return (
        convergence_chart(
            "flat_punch_convergence",
            "Convergence of the flat punch",
            "Relative errors against cell side, with a line of slope one.",
            [run.grid.spacing[0] / EXACT.contact_radius for run in runs],
            {
                "approach": [abs(approach(run) / EXACT.approach - 1) for run in runs],
                "central pressure": [abs(central_pressure(run) / exact - 1) for run in runs],
            },
            {"approach": 1.0},
        ),
    )
