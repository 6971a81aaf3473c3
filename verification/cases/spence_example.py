"""The example of Kalker's program CONTACT that Spence's theory is behind, as that publishes it."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
)
from semi_analytical.grid import SurfaceGrid
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.run import Run
from verification.observed.end_state import approach, peak_pressure
from verification.problems.reference import Reference, ReferenceKind

if TYPE_CHECKING:
    from semi_analytical import Result

SOURCE = "CONTACT, example of Spence's problem: published output"
# The program's units are N and mm: gap 0.004116 r², G = 0.5, ν = 0, cells of 0.2.
MILLIMETRE, MEGAPASCAL = 1e-3, 1e6
CELLS, SIDE = 45, 0.2 * MILLIMETRE
INCREMENTS = 35
FORCE = (INCREMENTS / 45) ** 3
CONTACT_CELLS, STICK_CELLS = 921, 225
RADIUS = sqrt(CONTACT_CELLS / np.pi) * SIDE
SCENE = Scene(
    title="CONTACT's example of Spence's problem",
    indenter=Paraboloid(radius=MILLIMETRE / (2 * 0.004116), material=RIGID),
    body=Body(material=IsotropicMaterial(young_modulus=1 * MEGAPASCAL, poisson_ratio=0.0)),
    friction=CoulombFriction(coefficient=0.2986),
    loading=(LoadStep(normal_force=FORCE, increments=INCREMENTS),),
)
# The published numbers are those of tractions that are constant on these cells.
GRID = SurfaceGrid((CELLS, CELLS), (CELLS * SIDE, CELLS * SIDE))
RUN = Run("45 x 45, edge off", SCENE, GRID, edge="off")


def spence_example(level: Level = Level.QUICK) -> Case:
    """The case, on the grid of the example at every level."""
    return Case(
        name="spence_example",
        title="CONTACT's Spence example",
        problem=(
            "A rigid paraboloid pressed with µ = 0.2986 on a half-space with ν = 0 in 35 equal "
            "steps of the contact radius: half of the radius sticks. The same cells and steps as "
            "in the published example, so that the two programs can be compared cell by cell."
        ),
        runs=(RUN,),
        quantities=(
            Quantity(
                "approach", "approach of the bodies since first touch", "m", RUN.label, approach,
                _published(0.09874 * MILLIMETRE, 0.5e-5 * MILLIMETRE),
                Required(2e-4, "four times half a digit of what is printed"),
            ),
            Quantity(
                "peak_pressure", "largest pressure of any cell", "Pa", RUN.label, peak_pressure,
                _published(0.02392 * MEGAPASCAL, 0.5e-5 * MEGAPASCAL),
                Required(1e-3, "both codes take the mean over the same cell"),
            ),
            Quantity(
                "stick_ratio", "√(cells that stick / cells in contact)", "", RUN.label,
                _stick_ratio,
                _published(sqrt(STICK_CELLS / CONTACT_CELLS), 1 / STICK_CELLS),
                Required(
                    0.1 * SIDE / RADIUS, "both codes count cells: a tenth of one, one was asked for"
                ), 1.0, "the contact radius",
            ),
        ),
        limits=("The published output has four to five digits.",),
    )  # fmt: skip


def _published(value: float, uncertainty: float) -> Reference:
    return Reference(value, ReferenceKind.EXTERNAL_CODE, SOURCE, uncertainty)


def _stick_ratio(result: Result) -> float:
    end = result.steps[-1]
    assert end.in_stick is not None
    return sqrt(np.count_nonzero(end.in_stick) / np.count_nonzero(end.in_contact))
