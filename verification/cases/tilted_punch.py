"""A flat punch pressed beside its axis: it tilts."""

from __future__ import annotations

from typing import Any

import numpy as np

from contact_scene import FlatPunch, LoadStep, Scene
from verification.cases.flat_punch import STAIRCASE
from verification.closed_forms.tilted_punch import TiltedPunch
from verification.judging.case import Case, Comparison, Level
from verification.judging.declared_case import Within, case, judged
from verification.judging.ladder import on_cells, part_of_side
from verification.judging.observable import Observable, error_norm
from verification.judging.observables import APPROACH
from verification.judging.refinement import refinement
from verification.judging.run import Run
from verification.problems import paper_scene as paper
from verification.problems.classical import PUNCH_RADIUS, PUNCH_WINDOW
from verification.problems.problem import Problem

LOAD = paper.NORMAL_FORCE
# Oblique to the grid, and a little less than the third of the radius at which the punch lifts off.
ECCENTRICITY = (0.18 * PUNCH_RADIUS, 0.24 * PUNCH_RADIUS)
EXACT = TiltedPunch(PUNCH_RADIUS, paper.CONTACT_MODULUS, LOAD, ECCENTRICITY)
MOMENT = (LOAD * ECCENTRICITY[1], LOAD * ECCENTRICITY[0])
LED = "given tilt"


def _scene(title: str, step: LoadStep) -> Scene:
    punch = FlatPunch(radius=PUNCH_RADIUS, material=paper.STEEL)
    return paper.frictionless(title, punch, paper.STEEL, step)


FORCED = Problem(
    _scene("Flat punch pressed beside its axis", LoadStep(normal_force=LOAD, moment=MOMENT)),
    (EXACT,),
    PUNCH_RADIUS,
    "Galin's theorem; tilting stiffness (4/3) E* a³",
)
OF_TILT = _scene(
    "Flat punch tilted as it is pressed",
    LoadStep(approach=EXACT.approach, tilt=(EXACT.tilt[1], EXACT.tilt[0])),
)


def _tilt(axis: str) -> Observable:
    """The slope along an axis, which is a rotation about the other."""
    along = "xy".index(axis)

    def slope(result: Any, step: int, problem: Problem) -> float:
        tilt = result.steps[step].tilt
        return float("nan") if tilt is None else float(tilt[1 - along])

    return Observable(
        f"tilt_{axis}", f"slope along {axis}", "rad", slope, lambda exact: float(exact.tilt[along])
    )


def _inner_error(result: Any, step: int, problem: Problem) -> float:
    """Largest relative error of the pressure within half the radius, clear of the rim."""
    x, y = result.grid.coordinates()
    inside = np.hypot(x, y) < 0.5 * PUNCH_RADIUS
    exact = EXACT.pressure(x[inside], y[inside])
    return float(np.max(np.abs(result.steps[step].pressure[inside] / exact - 1)))


INNER = error_norm(
    "inner_pressure", "largest |p - p_exact| / p_exact within half the radius", _inner_error,
    "p_exact",
)  # fmt: skip
ROWS = (
    *(
        Within(
            _tilt(axis), part_of_side(1.5),
            "one and a half cells over the radius, of which the tilt is the third power: "
            f"{STAIRCASE}",
        )
        for axis in "xy"
    ),
    Within(APPROACH, part_of_side(0.5), f"half a cell over the radius: {STAIRCASE}"),
    Within(INNER, part_of_side(1.5), "as the tilt"),
)  # fmt: skip


def tilted_punch(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    grids = on_cells(FORCED, refinement(32, 128 if level is Level.QUICK else 256), PUNCH_WINDOW)
    finest = grids.judged.run
    assert isinstance(finest, Run)
    return case(
        "tilted_punch",
        "Flat punch pressed beside its axis",
        "A flat punch of 0.4 mm radius, its load of 1 kN 0.3 radii from the axis in a direction "
        "oblique to the grid. Up to a third of the radius it touches all over, and a plane of "
        "displacement has a closed form.",
        judged(grids, ROWS),
        runs=(Run(LED, OF_TILT, finest.grid),),
        comparisons=(
            Comparison(
                "both_controls", "given moment against given tilt, each relative to the stiffness: "
                "load over approach and moment over tilt", (finest.label, LED), _stiffnesses,
                1e-6, "the punch touches all over: the response is linear to the tolerance of the "
                "solver", "linearity of a contact that does not change",
            ),
        ),
    )  # fmt: skip


def _stiffnesses(one: Any, other: Any) -> float:
    """Largest relative difference of the stiffnesses of two states."""

    def of(result: Any) -> np.ndarray:
        end = result.steps[-1]
        return np.array([end.normal_force / end.approach, *(end.moment / end.tilt)])

    return float(np.max(np.abs(of(one) / of(other) - 1)))
