"""A ball pressed beside its tip: it rolls, and the contact is where the force acts."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import Body, LoadStep, Paraboloid, Scene
from verification.judging.case import Case, Comparison, Level, Quantity, Required
from verification.judging.run import Run
from verification.problems import paper_scene as paper
from verification.problems.layered_scene import SUBSTRATE, pressed, rigid_ball
from verification.problems.paper_scene import HERTZ, pressing
from verification.problems.reference import Reference, ReferenceKind

if TYPE_CHECKING:
    from semi_analytical import Result

SOURCE = "x²/2R - φx = (x - Rφ)²/2R - Rφ²/2: a tilted paraboloid is a shifted one"
CELLS = 64
WINDOW_PER_RADIUS = 4.0
MOVED = (8, 5)  # cells between the tip and the force, along x and y
INCREMENTS = 5


def eccentric_ball(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return eccentric_ball_on(CELLS if level is Level.QUICK else 2 * CELLS)


def eccentric_ball_on(cells: int) -> Case:
    """The case on a square grid of this many cells per side."""
    grid = paper.square_grid(cells, WINDOW_PER_RADIUS / 2 * HERTZ.contact_radius)
    e = tuple(number * side for number, side in zip(MOVED, grid.spacing, strict=True))
    forced = LoadStep(
        normal_force=paper.NORMAL_FORCE,
        moment=(paper.NORMAL_FORCE * e[1], paper.NORMAL_FORCE * e[0]),
        increments=INCREMENTS,
    )
    centred = pressing(INCREMENTS)
    steel = (paper.paraboloid(paper.STEEL), Body(material=paper.STEEL))
    unlike = (rigid_ball(), Body(material=SUBSTRATE))

    def scene(title: str, bodies: tuple[Paraboloid, Body], *steps: LoadStep) -> Scene:
        return pressed(title, *bodies, *steps, friction=paper.FRICTION)

    roll = tuple(length / paper.RADIUS for length in e)
    led = LoadStep(normal_force=paper.NORMAL_FORCE, tilt=(roll[1], roll[0]), increments=1)
    drop = 0.5 * paper.RADIUS * (roll[0] ** 2 + roll[1] ** 2)
    runs = (
        Run("centred", scene("Ball pressed at its tip", steel, centred), grid),
        Run("beside", scene("Ball pressed beside its tip", steel, forced), grid),
        Run("given tilt", scene("Tilted ball", steel, led), grid),
        Run("centred, unlike bodies", scene("Rigid ball", unlike, centred), grid),
        Run("beside, unlike bodies", scene("Rigid ball beside its tip", unlike, forced), grid),
    )
    return Case(
        name="eccentric_ball",
        title="Ball pressed beside its tip",
        problem=(
            "The paper's ball, its force of 1 kN acting a whole number of cells beside the tip. It "
            "rolls until the contact is below the force: the same contact, elsewhere, and as many "
            "cells, so that the fields agree to the tolerance of the solver - also where pressure "
            "and shear are coupled."
        ),
        runs=runs,
        quantities=(
            *(
                Quantity(
                    f"tilt_{axis}", f"slope along {axis}", "rad", "beside", _tilt(1 - number),
                    _exact(roll[number]), Required(1e-6, TOLERANCE),
                )
                for number, axis in enumerate("xy")
            ),
            Quantity(
                "moment_of_given_tilt", "moment M_y that the given tilt takes", "N m",
                "given tilt", lambda result: _component(result.steps[-1].moment, 1),
                _exact(paper.NORMAL_FORCE * e[0]), Required(1e-6, TOLERANCE),
            ),
        ),
        comparisons=(
            *(
                Comparison(
                    f"fields{suffix}", "largest difference of pressure and shear, shifted, over "
                    "the largest pressure and the largest friction limit",
                    (f"beside{suffix}", f"centred{suffix}"), _shifted_difference, 1e-5, TOLERANCE,
                    SOURCE,
                )
                for suffix in ("", ", unlike bodies")
            ),
            Comparison(
                "approach", "approach at the origin, and what rolling raises the tip by, against "
                "the approach of the centred ball", ("beside", "centred"),
                lambda beside, centred: abs(
                    (beside.steps[-1].approach + drop) / centred.steps[-1].approach - 1
                ),
                1e-6, TOLERANCE, SOURCE,
            ),
        ),
    )  # fmt: skip


TOLERANCE = "an identity of the discrete equations: what is left is the tolerance of the solver"


def _exact(value: float) -> Reference:
    return Reference(value, ReferenceKind.IDENTITY, SOURCE, 1e-12 * abs(value))


def _component(vector: np.ndarray | None, number: int) -> float:
    return float("nan") if vector is None else float(vector[number])


def _tilt(component: int) -> Callable[[Result], float]:
    return lambda result: _component(result.steps[-1].tilt, component)


def _shifted_difference(beside: Result, centred: Result) -> float:
    """Of the tractions, those of the centred ball moved by whole cells."""
    one, other = beside.steps[-1], centred.steps[-1]
    pressure = np.roll(other.pressure, MOVED, axis=(0, 1))
    worst = np.max(np.abs(one.pressure - pressure)) / other.peak_pressure
    if one.shear is None or other.shear is None:
        return float(worst)
    shear = np.roll(other.shear, MOVED, axis=(1, 2))
    limit = paper.FRICTION * other.peak_pressure
    return float(np.maximum(worst, np.max(np.abs(one.shear - shear)) / limit))
