"""Who can be asked to solve a cell, and what they must tell."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Protocol

import fem_reference
from contact_scene import FiniteElementDiscretisation
from fem_reference import Method
from semi_analytical import (
    ContactAtWindowEdge,
    Coupling,
    Plan,
    Result,
    SurfaceGrid,
    solve,
)
from verification.observed.sections import section_laws
from verification.observed.surfaces import surface_violation
from verification.studies.stability.cell import Solver
from verification.studies.stability.pose import Posed

GROWTH = 1.3
MAX_WINDOWS = 4
ELEMENTS_PER_HARMONIC = 2


class WithResiduals(Protocol):
    """The largest residual of an increment, as its solver states it."""

    @property
    def worst(self) -> float: ...


class SolvedIncrement(Protocol):
    """What the map asks of an increment, whoever solved it."""

    @property
    def residuals(self) -> WithResiduals: ...
    @property
    def iterations(self) -> int: ...
    @property
    def halvings(self) -> int: ...


@dataclass(frozen=True)
class Solved:
    """What a solver made of a cell.

    increments    all of the history
    observed      the largest violation of the laws of contact and friction in their fields
    way           how it went about it, for a reader
    rounds        the most steps that pressure and shear took together
    """

    increments: Sequence[SolvedIncrement]
    observed: float
    way: str
    rounds: int
    convolutions: int = 0


def by_superposition(posed: Posed) -> Solved:
    """With the semi-analytical solver, in a wider window if the contact needs it."""
    result = _solved(posed)
    increments = result.increments
    return Solved(
        increments=increments,
        observed=surface_violation(result),
        way=_way(result.plan),
        rounds=max(i.rounds for i in increments),
        convolutions=sum(i.convolutions for i in increments),
    )


def by_elements(posed: Posed, method: Method) -> Solved:
    """With finite elements on a section, on a larger mesh if the contact needs it."""
    on_harmonics = fem_reference.plan(posed.scene).path is fem_reference.Path.HARMONICS
    discretisation = FiniteElementDiscretisation(
        elements_per_radius=posed.elements,
        harmonics=posed.elements // ELEMENTS_PER_HARMONIC,
        # Whether a penalty converges is asked here, and not what it leaves.
        augmentations=0 if on_harmonics else 1,
        overlap=100.0,
        tolerance=posed.tolerance,
    )
    result = fem_reference.solve(posed.scene, discretisation, method)
    increments = result.increments
    ways = sorted({i.path for i in increments if i.path is not None})
    return Solved(
        increments=increments,
        observed=section_laws(result)[0],
        way="; ".join([result.plan.path.value, *ways]),
        rounds=max(i.sweeps for i in increments),
    )


SOLVERS: dict[Solver, Callable[[Posed], Solved]] = {
    Solver.SEMI_ANALYTICAL: by_superposition,
    Solver.COMPLEMENTARITY: partial(by_elements, method=Method.COMPLEMENTARITY),
    Solver.PENALTY: partial(by_elements, method=Method.PENALTY),
}


def _solved(posed: Posed) -> Result:
    grid = posed.grid
    for _ in range(MAX_WINDOWS):
        try:
            return solve(posed.scene, grid, posed.tolerance)
        except ContactAtWindowEdge:
            if posed.scene.indenter.extent is not None:
                raise
            grid = SurfaceGrid(grid.cells, (GROWTH * grid.window[0], GROWTH * grid.window[1]))
    return solve(posed.scene, grid, posed.tolerance)


def _way(decided: Plan) -> str:
    if not decided.shear:
        return "pressure alone"
    if decided.coupling is Coupling.NONE:
        return "pressure, then shear"
    return "pressure and shear together"
