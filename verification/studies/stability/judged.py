"""Solve of one contact of the stability map, and the verdict on its result."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import numpy as np

import fem_reference
from contact_scene import FiniteElementDiscretisation, SceneError
from contact_scene.solver_errors import (
    GrossSliding,
    NotConverged,
    ResourceRefused,
    SolverError,
    UnsupportedScene,
)
from fem_reference import Method
from semi_analytical import (
    ContactAtWindowEdge,
    Coupling,
    Plan,
    Result,
    SurfaceGrid,
    solve,
)
from verification.judging.run import OTHER_NORMS
from verification.observed.laws import observed
from verification.running.study import CaseRecord
from verification.studies.stability.cell import CellRecord, Refusal, Solver, StabilityCell, Verdict
from verification.studies.stability.pose import TOLERANCE, Posed, pose

GROWTH = 1.3
MAX_WINDOWS = 4
ELEMENTS_PER_HARMONIC = 2


class SolvedContact(NamedTuple):
    """Result of a solver for one contact of the stability map, with its solution method.

    result  result of the solver
    way     solution method in words
    rounds  largest number of alternating iterations of pressure and shear in an increment
    """

    result: Any
    way: str
    rounds: int


def by_superposition(posed: Posed) -> SolvedContact:
    """Solve a contact of the stability map with the semi-analytical solver.

    If the contact reaches the edge of the window, the solve is repeated in a wider window.

    posed  scene and surface grid of the contact
    """
    result = _solve_in_window(posed)
    return SolvedContact(
        result, _method_text(result.plan), max(i.rounds for i in result.increments)
    )


def by_elements(posed: Posed, method: Method) -> SolvedContact:
    """Solve a contact of the stability map with finite elements.

    posed   scene and discretisation of the contact
    method  enforcement of the contact and friction laws: complementarity or penalty
    """
    on_harmonics = fem_reference.plan(posed.scene).path is fem_reference.Path.HARMONICS
    discretisation = FiniteElementDiscretisation(
        elements_per_radius=posed.elements,
        harmonics=posed.elements // ELEMENTS_PER_HARMONIC,
        # The study tests the convergence of the penalty method, not its remaining overlap.
        augmentations=0 if on_harmonics else 1,
        overlap=100.0,
        tolerance=posed.tolerance,
    )
    result = fem_reference.solve(posed.scene, discretisation, method)
    ways = sorted({i.path for i in result.increments if i.path is not None})
    way = "; ".join([result.plan.path.value, *ways])
    return SolvedContact(result, way, max(i.sweeps for i in result.increments))


SOLVERS: dict[Solver, Callable[[Posed], SolvedContact]] = {
    Solver.SEMI_ANALYTICAL: by_superposition,
    Solver.COMPLEMENTARITY: partial(by_elements, method=Method.COMPLEMENTARITY),
    Solver.PENALTY: partial(by_elements, method=Method.PENALTY),
}


def _solve_in_window(posed: Posed) -> Result:
    grid = posed.grid
    for _ in range(MAX_WINDOWS):
        try:
            return solve(posed.scene, grid, posed.tolerance)
        except ContactAtWindowEdge:
            if posed.scene.indenter.extent is not None:
                raise
            grid = SurfaceGrid(grid.cells, (GROWTH * grid.window[0], GROWTH * grid.window[1]))
    return solve(posed.scene, grid, posed.tolerance)


def _method_text(decided: Plan) -> str:
    if not decided.shear:
        return "pressure alone"
    if decided.coupling is Coupling.NONE:
        return "pressure, then shear"
    return "pressure and shear together"


# Errors that refuse a scene for its load, its kind or its size.
REFUSALS = (GrossSliding, UnsupportedScene, ResourceRefused)


@dataclass(frozen=True)
class StabilityRun:
    """Solve of one contact of the stability map, as a case of the study.

    The stability map shows which contacts the solvers can solve.

    An error of the solver is stored in the record of the contact as its outcome.
    """

    cell: StabilityCell

    @property
    def name(self) -> str:
        return self.cell.name

    def compute(self) -> CaseRecord:
        return judge_contact(self.cell).of_cell(self.cell)


def judge_contact(cell: StabilityCell) -> CellRecord:
    """Solve a contact of the stability map and return its verdict, residuals and cost.

    The stability map shows which contacts the solvers can solve. Errors of the scene or the solver
    become verdicts and are not raised. A result whose residuals exceed the allowed values is wrong
    without a message.
    """
    try:
        posed = pose(cell)
    except SceneError as error:
        return _failure_record(Verdict.REFUSED, error, TOLERANCE)
    tolerance = posed.tolerance
    try:
        result, way, rounds = SOLVERS[cell.solver](posed)
    except REFUSALS as error:
        return _failure_record(Verdict.REFUSED, error, tolerance)
    except SolverError as error:
        return _failure_record(Verdict.NOT_CONVERGED, error, tolerance)
    increments, seen = result.increments, observed(result).violation
    # np.max propagates a residual that is NaN.
    residual = float(np.max([increment.residuals.worst for increment in increments]))
    sound = residual <= tolerance and seen <= OTHER_NORMS * tolerance
    return CellRecord(
        verdict=Verdict.CONVERGED if sound else Verdict.SILENT,
        reason="" if np.isfinite([residual, seen]).all() else "some number is not finite",
        tolerance=tolerance,
        residual=_finite_or_none(residual),
        observed=_finite_or_none(seen),
        increments=len(increments),
        halvings=sum(increment.halvings for increment in increments),
        rounds=rounds,
        way=way,
        iterations=sum(increment.iterations for increment in increments),
        convolutions=sum(increment.convolutions or 0 for increment in increments),
    )


def _finite_or_none(value: float) -> float | None:
    """Return a residual, or None if it is not finite, because JSON cannot store such a value."""
    return value if np.isfinite(value) else None


def _failure_record(verdict: Verdict, error: Exception, tolerance: float) -> CellRecord:
    return CellRecord(
        verdict=verdict,
        refused_for=_refusal_category(error) if verdict is Verdict.REFUSED else Refusal.NONE,
        reason=f"{type(error).__name__}: {error}",
        tolerance=tolerance,
        residual=_finite_or_none(error.residual) if isinstance(error, NotConverged) else None,
    )


def _refusal_category(error: Exception) -> Refusal:
    """Return the category of an error by which a solver refuses a contact of the stability map.

    The category follows from the type of the error and the keys of the scene that the error names.
    A tangential force can only be refused for its size.
    """
    if isinstance(error, UnsupportedScene):
        return Refusal.POSE
    keys = {problem.path[-1:] for problem in getattr(error, "problems", ())}
    if isinstance(error, GrossSliding) or keys == {("tangential_force",)}:
        return Refusal.FORCE
    return Refusal.OTHER
