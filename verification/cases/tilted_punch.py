"""A flat punch pressed beside its axis: it tilts."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import FlatPunch, LoadStep, Scene
from verification.closed_forms.tilted_punch import TiltedPunch
from verification.judging.case import Case, Comparison, Level, Quantity, Required
from verification.judging.ladder import cells_label
from verification.judging.refinement import refinement
from verification.judging.run import Run
from verification.observed.end_state import approach
from verification.problems import paper_scene as paper
from verification.problems.reference import closed_form, exact_zero

if TYPE_CHECKING:
    from semi_analytical import Result

SOURCE = "Galin's theorem; tilting stiffness (4/3) E* a³"
RADIUS = 0.4e-3
WINDOW_PER_RADIUS = 2.2
LOAD = paper.NORMAL_FORCE
# Oblique to the grid, and a little less than the third of the radius at which the punch lifts off.
ECCENTRICITY = (0.18 * RADIUS, 0.24 * RADIUS)
EXACT = TiltedPunch(RADIUS, paper.CONTACT_MODULUS, LOAD, ECCENTRICITY)


def _scene(title: str, step: LoadStep) -> Scene:
    return paper.frictionless(
        title, FlatPunch(radius=RADIUS, material=paper.STEEL), paper.STEEL, step
    )


MOMENT = (LOAD * ECCENTRICITY[1], LOAD * ECCENTRICITY[0])
FORCED = _scene("Flat punch pressed beside its axis", LoadStep(normal_force=LOAD, moment=MOMENT))
LED = _scene(
    "Flat punch tilted as it is pressed",
    LoadStep(approach=EXACT.approach, tilt=(EXACT.tilt[1], EXACT.tilt[0])),
)


def tilted_punch(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return tilted_punch_on(refinement(32, 128 if level is Level.QUICK else 256))


def tilted_punch_on(cells: tuple[int, ...]) -> Case:
    """The case on square grids of these many cells per side."""
    half_width = WINDOW_PER_RADIUS / 2 * RADIUS
    runs = tuple(Run(cells_label(n), FORCED, paper.square_grid(n, half_width)) for n in cells)
    led = Run("given tilt", LED, runs[-1].grid)
    finest = runs[-1].label
    cell = runs[-1].grid.spacing[0] / RADIUS
    staircase = (
        "the rim is a staircase of cells under an infinite pressure, so that the radius seems to "
        "be wrong by up to half a cell"
    )
    return Case(
        name="tilted_punch",
        title="Flat punch pressed beside its axis",
        problem=(
            "A flat punch of 0.4 mm radius, its load of 1 kN 0.3 radii from the axis in a "
            "direction oblique to the grid. Up to a third of the radius it touches all over, and a "
            "plane of displacement has a closed form."
        ),
        runs=(*runs, led),
        quantities=(
            *(
                Quantity(
                    f"tilt_{axis}", f"slope along {axis}", "rad", finest, _tilt(1 - number),
                    closed_form(EXACT.tilt[number], SOURCE),
                    Required(1.5 * cell, f"one and a half cells over the radius, of which the tilt "
                             f"is the third power: {staircase}"),
                )
                for number, axis in enumerate("xy")
            ),
            Quantity(
                "approach", "approach of the axis", "m", finest, approach,
                closed_form(EXACT.approach, SOURCE),
                Required(cell / 2, f"half a cell over the radius: {staircase}"),
            ),
            Quantity(
                "inner_pressure", "largest |p - p_exact| / p_exact within half the radius", "",
                finest, inner_error, exact_zero(SOURCE),
                Required(1.5 * cell, "as the tilt"), 1.0, "p_exact",
            ),
        ),
        comparisons=(
            Comparison(
                "both_controls", "given moment against given tilt, each relative to the stiffness: "
                "load over approach and moment over tilt", (finest, "given tilt"), _stiffnesses,
                1e-6, "the punch touches all over: the response is linear to the tolerance of the "
                "solver", "linearity of a contact that does not change",
            ),
        ),
    )  # fmt: skip


def inner_error(result: Result) -> float:
    """Largest relative error of the pressure within half the radius, clear of the rim."""
    x, y = result.grid.coordinates()
    inside = np.hypot(x, y) < 0.5 * RADIUS
    exact = EXACT.pressure(x[inside], y[inside])
    return float(np.max(np.abs(result.steps[-1].pressure[inside] / exact - 1)))


def _tilt(component: int) -> Callable[[Result], float]:
    def tilt(result: Result) -> float:
        reached = result.steps[-1].tilt
        return float("nan") if reached is None else float(reached[component])

    return tilt


def _stiffnesses(one: Result, other: Result) -> float:
    """Largest relative difference of the stiffnesses of two states."""

    def of(result: Result) -> np.ndarray:
        end = result.steps[-1]
        assert end.moment is not None
        assert end.tilt is not None
        return np.array([end.normal_force / end.approach, *(end.moment / end.tilt)])

    return float(np.max(np.abs(of(one) / of(other) - 1)))
