"""The verdict on one cell."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray

from contact_scene import FrictionMap, Scene, SceneError
from contact_scene.solver_errors import (
    GrossSliding,
    NotConverged,
    ResourceRefused,
    SolverError,
    UnsupportedScene,
)
from verification.studies.stability.cell import StabilityCell
from verification.studies.stability.observed import observed
from verification.studies.stability.pose import TOLERANCE, pose
from verification.studies.stability.record import CellRecord, Verdict
from verification.studies.stability.solvers import SOLVERS

Field = NDArray[np.float64]

# What a scene may be refused for: its load, its meaning, its size.
REFUSALS = (GrossSliding, UnsupportedScene, ResourceRefused)
# Fields are judged apart from the solver, with other norms.
OTHER_NORMS = 10.0


def judged(cell: StabilityCell) -> CellRecord:
    """Solve a cell and say what became of it; never raises for a solver's sake."""
    started = time.process_time()
    try:
        posed = pose(cell)
    except SceneError as error:
        return _without_answer(Verdict.REFUSED, error, TOLERANCE, started)
    tolerance = posed.tolerance
    try:
        solved = SOLVERS[cell.solver](posed)
    except REFUSALS as error:
        return _without_answer(Verdict.REFUSED, error, tolerance, started)
    except SolverError as error:
        return _without_answer(Verdict.NOT_CONVERGED, error, tolerance, started)
    residual = max(increment.residuals.worst for increment in solved.increments)
    seen = observed(solved.increments, solved.cell_area, _friction(posed.scene))
    sound = residual <= tolerance and seen <= OTHER_NORMS * tolerance
    return CellRecord(
        verdict=Verdict.CONVERGED if sound else Verdict.SILENT,
        tolerance=tolerance,
        residual=residual,
        observed=seen,
        increments=len(solved.increments),
        halvings=solved.halvings,
        rounds=solved.rounds,
        way=solved.way,
        iterations=solved.iterations,
        convolutions=solved.convolutions,
        seconds=time.process_time() - started,
    )


def _without_answer(
    verdict: Verdict, error: Exception, tolerance: float, started: float
) -> CellRecord:
    return CellRecord(
        verdict=verdict,
        reason=f"{type(error).__name__}: {error}",
        tolerance=tolerance,
        residual=error.residual if isinstance(error, NotConverged) else None,
        seconds=time.process_time() - started,
    )


def _friction(scene: Scene) -> float | Field:
    """µ, one number or one per cell."""
    assert scene.friction is not None
    coefficient = scene.friction.coefficient
    return coefficient.map.values if isinstance(coefficient, FrictionMap) else coefficient
