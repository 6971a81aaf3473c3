"""Refinement levels of the semi-analytical solver: cells, window, increments and tolerance."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from math import ceil

import numpy as np
from scipy.fft import next_fast_len

import semi_analytical
from contact_errors.cost_estimate import Work, estimated_seconds, work_on_cells
from contact_errors.on_cells import coarse_solves
from contact_errors.refinement import Keeping, Refinement, RefinementLevel, no_context
from contact_errors.stress_errors import largest_tensile_stress
from contact_results.stress import on_cells
from contact_scene import Scene, SurfaceDiscretisation
from contact_scene.accuracy_reached import AccuracySettings
from contact_scene.free_memory import available_bytes
from contact_scene.solver_errors import ContactAtWindowEdge, ContactNotResolved
from contact_scene.stated_error import StatedErrors
from semi_analytical import Plan, Result, SurfaceGrid, memory
from semi_analytical.resolution import refuse_unresolved

# Cells along the shorter side of the first level; eleven per radius on a fitted window.
FIRST_CELLS = 24
# Error of the shear by increments on the first level.
FIRST_PATH_ACCURACY = 4e-2
MOST_CELLS = 16384
LEAST_TOLERANCE = 1e-12
# Enlargement of a fitted window, on as many more cells, where the contact reaches its edge.
ROOM, MOST_ENLARGEMENTS = 1.25, 5
# Doublings of the cells of the first level until they resolve the contact.
MOST_DOUBLINGS = 5


@dataclass(frozen=True)
class CellFineness:
    """Grid, increments of every step, and tolerance."""

    grid: SurfaceGrid
    increments: tuple[int, ...]
    tolerance: float


@dataclass(frozen=True)
class CellLevels:
    """See `refinement.Levels`.

    asked           window if given, ratio of the cells along the sides, largest tolerance
    stress_at       load step at whose end the largest tensile stress is requested, or None
    keeping, watching
                    contexts of each solve, with its checkpoint store and its progress
    """

    scene: Scene
    asked: SurfaceDiscretisation
    stress_at: int | None = None
    keeping: Keeping = no_context
    watching: Keeping = no_context

    def first(self) -> CellFineness:
        grid = semi_analytical.discretise(self.scene, self.asked)
        cells = _scaled(grid.cells, FIRST_CELLS / min(grid.cells))
        coarse = SurfaceGrid(cells, grid.window)
        return CellFineness(coarse, self._plan().increments, self.asked.tolerance)

    def solved(self, fineness: CellFineness) -> RefinementLevel[CellFineness]:
        began, began_processor = time.perf_counter(), time.process_time()
        result = self._solved(fineness)
        run, companions = coarse_solves(result)
        stated = StatedErrors(tuple(run.errors()), companions)
        below = None
        if self.stress_at is not None:
            below = largest_tensile_stress(result, stated, self.stress_at)
        return RefinementLevel(
            fineness=replace(fineness, grid=result.grid),
            result=result,
            stated=stated,
            run=run,
            seconds=time.perf_counter() - began,
            processor_seconds=time.process_time() - began_processor,
            below=below,
        )

    def refined(self, fineness: CellFineness, by: Refinement) -> CellFineness:
        grid = SurfaceGrid(_scaled(fineness.grid.cells, by.cells), fineness.grid.window)
        increments = by.increments_of(self.scene, fineness.increments)
        smaller = fineness.tolerance / by.others.get("tolerance", 1.0)
        return CellFineness(grid, increments, max(LEAST_TOLERANCE, smaller))

    def seconds(self, fineness: CellFineness, like: RefinementLevel[CellFineness]) -> float:
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
        """Largest memory of a level [byte]."""
        run = memory.estimated_bytes(fineness.grid, self._plan().cut_into(fineness.increments))
        if self.stress_at is None or not self.scene.body.deforms:
            return run
        stress = on_cells.estimated_bytes(self.scene.body, fineness.grid)
        return max(run, memory.LIBRARIES + stress)

    def most_growth(self, fineness: CellFineness) -> float:
        # Memory grows with the cells, apart from that of the libraries.
        most = MOST_CELLS / max(fineness.grid.cells)
        here, there = (self.memory(self.refined(fineness, Refinement(by))) for by in (1.0, most))
        share = min(1.0, max(0.0, (available_bytes() - here) / (there - here)))
        return float(np.sqrt(1.0 + share * (most**2 - 1.0)))

    def settings(self, fineness: CellFineness) -> AccuracySettings:
        return AccuracySettings(
            cells=fineness.grid.cells,
            increments=fineness.increments,
            tolerance=fineness.tolerance,
        )

    def _plan(self) -> Plan:
        """Effects, and the increments of the first level: as many as the scene names at least."""
        return semi_analytical.plan(self.scene, FIRST_PATH_ACCURACY, self.asked.edge)

    def _solved(self, fineness: CellFineness) -> Result:
        """Solve on a larger window of equal cells where a fitted window has become too small, and
        on finer cells where the contact is not resolved."""
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
                hx, hy = grid.spacing
                nx, ny = _scaled(grid.cells, ROOM)
                grid = SurfaceGrid((nx, ny), (nx * hx, ny * hy))
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
    """Return the smallest even number from `least` on with no prime factor above 5.

    Fourier transforms of its multiples are fast.
    """
    return int(2 * next_fast_len(max(1, ceil(round(least, 6) / 2)), real=True))
