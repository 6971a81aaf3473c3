"""Who can be asked to solve a cell, and what they must tell."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from contact_scene import HeightMap
from semi_analytical import (
    ContactAtWindowEdge,
    Coupling,
    Increment,
    Plan,
    Result,
    SurfaceGrid,
    solve,
)
from verification.studies.stability.cell import Solver
from verification.studies.stability.pose import Posed

GROWTH = 1.3
MOST_WINDOWS = 4


@dataclass(frozen=True)
class Solved:
    """What a solver made of a cell.

    increments    all of the history
    cell_area     of the surface elements that carry the tractions [length²]
    way           how it went about it, for a reader
    """

    increments: Sequence[Increment]
    cell_area: float
    way: str
    rounds: int
    iterations: int
    convolutions: int
    halvings: int


def by_superposition(posed: Posed) -> Solved:
    """With the semi-analytical solver, in a wider window if the contact needs it."""
    result = _solved(posed)
    increments = result.increments
    rounds = max(i.rounds for i in increments)
    return Solved(
        increments=increments,
        cell_area=result.grid.cell_area,
        way=_way(result.plan, rounds),
        rounds=rounds,
        iterations=sum(i.iterations for i in increments),
        convolutions=sum(i.convolutions for i in increments),
        halvings=sum(i.halvings for i in increments),
    )


SOLVERS: dict[Solver, Callable[[Posed], Solved]] = {Solver.SEMI_ANALYTICAL: by_superposition}


def _solved(posed: Posed) -> Result:
    grid = posed.grid
    for _ in range(MOST_WINDOWS):
        try:
            return solve(posed.scene, grid, posed.tolerance)
        except ContactAtWindowEdge:
            if isinstance(posed.scene.indenter, HeightMap):
                raise
            grid = SurfaceGrid(grid.cells, (GROWTH * grid.window[0], GROWTH * grid.window[1]))
    return solve(posed.scene, grid, posed.tolerance)


def _way(decided: Plan, rounds: int) -> str:
    if not decided.shear:
        return "pressure alone"
    if decided.coupling is Coupling.NONE:
        return "pressure, then shear"
    return "alternation" if rounds < 3 else "alternation, extrapolated"
