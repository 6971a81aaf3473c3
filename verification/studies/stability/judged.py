"""A cell solved, and the verdict on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene import SceneError
from contact_scene.solver_errors import (
    GrossSliding,
    NotConverged,
    ResourceRefused,
    SolverError,
    UnsupportedScene,
)
from verification.judging.run import OTHER_NORMS
from verification.running.row import CaseRecord
from verification.studies.stability.cell import StabilityCell
from verification.studies.stability.pose import TOLERANCE, pose
from verification.studies.stability.record import CellRecord, Refusal, Verdict
from verification.studies.stability.solvers import SOLVERS

# What a scene may be refused for: its load, its meaning, its size.
REFUSALS = (GrossSliding, UnsupportedScene, ResourceRefused)


@dataclass(frozen=True)
class StabilityRun:
    """A cell to be solved; whatever the solver says is the record."""

    cell: StabilityCell

    @property
    def name(self) -> str:
        return self.cell.name

    def compute(self) -> CaseRecord:
        return judged(self.cell).of_cell(self.cell)


def judged(cell: StabilityCell) -> CellRecord:
    """Solve a cell and say what became of it; never raises for a solver's sake."""
    try:
        posed = pose(cell)
    except SceneError as error:
        return _without_answer(Verdict.REFUSED, error, TOLERANCE)
    tolerance = posed.tolerance
    try:
        solved = SOLVERS[cell.solver](posed)
    except REFUSALS as error:
        return _without_answer(Verdict.REFUSED, error, tolerance)
    except SolverError as error:
        return _without_answer(Verdict.NOT_CONVERGED, error, tolerance)
    increments, seen = solved.increments, solved.observed
    # Here a residual that is no number wins.
    residual = float(np.max([increment.residuals.worst for increment in increments]))
    sound = residual <= tolerance and seen <= OTHER_NORMS * tolerance
    return CellRecord(
        verdict=Verdict.CONVERGED if sound else Verdict.SILENT,
        reason="" if np.isfinite([residual, seen]).all() else "some number is not finite",
        tolerance=tolerance,
        residual=_finite(residual),
        observed=_finite(seen),
        increments=len(increments),
        halvings=sum(increment.halvings for increment in increments),
        rounds=solved.rounds,
        way=solved.way,
        iterations=sum(increment.iterations for increment in increments),
        convolutions=solved.convolutions,
    )


def _finite(value: float) -> float | None:
    """As it can be stored."""
    return value if np.isfinite(value) else None


def _without_answer(verdict: Verdict, error: Exception, tolerance: float) -> CellRecord:
    return CellRecord(
        verdict=verdict,
        refused_for=_refused_for(error) if verdict is Verdict.REFUSED else Refusal.NONE,
        reason=f"{type(error).__name__}: {error}",
        tolerance=tolerance,
        residual=_finite(error.residual) if isinstance(error, NotConverged) else None,
    )


def _refused_for(error: Exception) -> Refusal:
    """Told by the kind of error, and of a scene by its keys: what is wrong with the force of a cell
    is its size alone."""
    if isinstance(error, UnsupportedScene):
        return Refusal.POSE
    keys = {problem.path[-1:] for problem in getattr(error, "problems", ())}
    if isinstance(error, GrossSliding) or keys == {("tangential_force",)}:
        return Refusal.FORCE
    return Refusal.OTHER
