"""The ladder of the semi-analytical solver: cells, window, increments and tolerance."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from math import ceil

import numpy as np

import semi_analytical
from contact_errors.cost_estimate import Work, estimated_seconds, work_on_cells
from contact_errors.half_the_cells import Progress
from contact_errors.ladder import Growth, Rung, unkept
from contact_errors.on_cells import judged, rules_at
from contact_errors.tension import largest_tension
from contact_errors.values import values_of
from contact_results.cycles import fretting_cycles
from contact_scene import Scene, SurfaceDiscretisation
from contact_scene.accuracy import LARGEST_TENSION
from contact_scene.accuracy_reached import AccuracySettings
from contact_scene.free_memory import available_bytes
from contact_scene.solver_errors import ContactAtWindowEdge, ContactNotResolved
from contact_scene.standing import Keeper
from semi_analytical import Plan, Result, SurfaceGrid
from semi_analytical.memory import estimated_bytes
from semi_analytical.resolution import refuse_unresolved

# Cells along the shorter side of the first rung; eleven per radius on a fitted window.
FIRST_CELLS = 24
# Of the shear, by increments on the first rung.
FIRST_PATH_ACCURACY = 4e-2
MOST_CELLS = 16384
LEAST_TOLERANCE = 1e-12
# More room, on as many more cells, where the contact reaches the edge of a fitted window after all.
ROOM, MOST_ENLARGEMENTS = 1.25, 5
# How often the cells of the first rung are doubled until they resolve the contact.
MOST_DOUBLINGS = 5


@dataclass(frozen=True)
class CellFineness:
    """How fine cells solve a scene: grid, increments of every step, tolerance."""

    grid: SurfaceGrid
    increments: tuple[int, ...]
    tolerance: float


# What keeps the solve of a rung while it lasts, and what is told of its increments.
Keeping = Callable[[CellFineness], AbstractContextManager[Keeper | None]]
Watching = Callable[[CellFineness], AbstractContextManager[Progress | None]]


@dataclass(frozen=True)
class CellLadder:
    """See `ladder.Ladder`.

    asked           window if it is given, ratio of the cells along the sides, largest tolerance
    stress_at       loading step at whose end the largest tension is wanted; None where it is not
    """

    scene: Scene
    asked: SurfaceDiscretisation
    stress_at: int | None = None
    keeping: Keeping = unkept
    watching: Watching = unkept

    def first(self) -> CellFineness:
        grid = semi_analytical.discretise(self.scene, self.asked)
        cells = _scaled(grid.cells, FIRST_CELLS / min(grid.cells))
        coarse = SurfaceGrid(cells, grid.window)
        return CellFineness(coarse, self._plan().increments, self.asked.tolerance)

    def climbed(self, fineness: CellFineness) -> Rung[CellFineness]:
        began, began_processor = time.perf_counter(), time.process_time()
        result = self._solved(fineness)
        stated, by_step = judged(result)
        below = None
        if self.stress_at is not None:
            below = largest_tension(result, stated, self.stress_at)
        rules = rules_at(result, result.steps)
        return Rung(
            fineness=replace(fineness, grid=result.grid),
            result=result,
            stated=stated,
            values=values_of(result, fretting_cycles(result)),
            rules={**rules, **({LARGEST_TENSION: below.rule} if below else {})},
            by_step=by_step,
            seconds=time.perf_counter() - began,
            processor_seconds=time.process_time() - began_processor,
            below=below,
        )

    def refined(self, fineness: CellFineness, by: Growth) -> CellFineness:
        grid = SurfaceGrid(_scaled(fineness.grid.cells, by.cells), fineness.grid.window)
        matters = [step.path_matters for step in self._plan().path]
        increments = by.increments_of(fineness.increments, matters)
        tolerance = max(LEAST_TOLERANCE, fineness.tolerance * by.less.get("tolerance", 1.0))
        return CellFineness(grid, increments, tolerance)

    def seconds(self, fineness: CellFineness, like: Rung[CellFineness]) -> float:
        return estimated_seconds(
            like.processor_seconds, self._work(like.fineness), self._work(fineness)
        )

    def _work(self, fineness: CellFineness) -> Work:
        return work_on_cells(fineness.grid.cells, fineness.increments, self._plan().shear)

    def too_large(self, fineness: CellFineness) -> str | None:
        grid, available = fineness.grid, available_bytes()
        if max(grid.cells) > MOST_CELLS:
            return f"the next round would take more than {MOST_CELLS} cells along a side"
        needed = self.memory(fineness)
        if needed <= available:
            return None
        return (
            f"the next round, {grid.cells[0]} x {grid.cells[1]} cells and "
            f"{sum(fineness.increments)} increments, needs about {needed / 2**30:.1f} GiB; "
            f"{available / 2**30:.1f} GiB are available"
        )

    def memory(self, fineness: CellFineness) -> int:
        """Largest memory that a rung holds at once [byte]."""
        return estimated_bytes(fineness.grid, self._plan().cut_into(fineness.increments))

    def most_growth(self, fineness: CellFineness) -> float:
        # Libraries apart, memory goes with the cells; on few of them libraries are all of it.
        most = MOST_CELLS / max(fineness.grid.cells)
        here, there = (self.memory(self.refined(fineness, Growth(by))) for by in (1.0, most))
        share = min(1.0, max(0.0, (available_bytes() - here) / (there - here)))
        return float(np.sqrt(1.0 + share * (most**2 - 1.0)))

    def settings(self, fineness: CellFineness) -> AccuracySettings:
        return AccuracySettings(
            cells=fineness.grid.cells,
            increments=fineness.increments,
            tolerance=fineness.tolerance,
        )

    def _plan(self) -> Plan:
        """Effects, and the increments of the first rung: as many as the scene names at least."""
        return semi_analytical.plan(self.scene, FIRST_PATH_ACCURACY, self.asked.edge)

    def _solved(self, fineness: CellFineness) -> Result:
        """The result; on a larger window of the same cells where a fitted one has become too small,
        on finer ones where the contact is not resolved."""
        plan = self._plan().cut_into(fineness.increments)
        grid, fitted = fineness.grid, self.asked.window is None
        enlarged = doubled = 0
        while True:
            tried = replace(fineness, grid=grid)
            try:
                with self.keeping(tried) as keeper, self.watching(tried) as progress:
                    result = semi_analytical.solve(
                        self.scene, grid, fineness.tolerance, progress, plan, keeper
                    )
                refuse_unresolved(result)
            except ContactAtWindowEdge:
                enlarged += 1
                if not fitted or enlarged > MOST_ENLARGEMENTS or self.scene.indenter.extent:
                    raise
                grid = _roomier(grid)
            except ContactNotResolved:
                doubled += 1
                if doubled > MOST_DOUBLINGS:
                    raise
                grid = grid.refined()
            else:
                return result


def _scaled(cells: tuple[int, int], factor: float) -> tuple[int, int]:
    nx, ny = (even_smooth(factor * n) for n in cells)
    return nx, ny


def even_smooth(least: float) -> int:
    """The smallest even number of cells from `least` on with no prime factor above 7: transforms of
    its multiples are fast."""
    number = max(2, 2 * ceil(round(least, 6) / 2))
    while not _is_smooth(number):
        number += 2
    return number


def _is_smooth(number: int) -> bool:
    for prime in (2, 3, 5, 7):
        while number % prime == 0:
            number //= prime
    return number == 1


def _roomier(grid: SurfaceGrid) -> SurfaceGrid:
    nx, ny = _scaled(grid.cells, ROOM)
    hx, hy = grid.spacing
    return SurfaceGrid((nx, ny), (nx * hx, ny * hy))
