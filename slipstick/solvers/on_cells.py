"""Adapter of the semi-analytical solver to the solver interface of the commands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import semi_analytical
from contact_errors.cost_estimate import (
    MAX_CELLS,
    MAX_STEPS,
    coarse_increments,
    work_on_cells,
)
from contact_errors.on_cells import CellSolver
from contact_scene import Scene, SurfaceDiscretisation
from contact_scene.reading.engineering_units import engineering_unit
from contact_scene.solver_errors import ContactNotResolved, SolverError
from contact_scene.stepping.checkpoint import CheckpointStore
from semi_analytical import Plan, Result, SurfaceGrid, all_effects
from semi_analytical.memory import estimated_bytes
from slipstick.solvers.solver import (
    MAX_STEPS_SHOWN,
    Pairs,
    Progress,
    Solver,
    increments_text,
    time_of_run,
)

# Number of load steps, with one increment each, of the coarse solves that measure the convolutions
# saved by the plan.
FORCED_INCREMENTS = 4
LEAST_SAVING = 1.1  # smallest ratio of convolutions that is reported
FEWEST = 8  # smallest number of cells along a side of the coarse solve for the time estimate


class OnCells(Solver):
    """Semi-analytical solver on a grid of surface cells, with the interface `solver.Solver`."""

    table = "semi_analytical"
    discretisation = SurfaceDiscretisation
    refinable = CellSolver

    def plan(self, scene: Scene, fineness: SurfaceDiscretisation) -> Plan:
        return semi_analytical.plan(scene, fineness.path_accuracy, fineness.edge)

    def solve(
        self,
        scene: Scene,
        fineness: SurfaceDiscretisation,
        plan: Plan,
        progress: Progress | None = None,
        store: CheckpointStore | None = None,
    ) -> Result:
        return semi_analytical.solve_discretised(scene, fineness, progress, plan, store)

    def refined(self, scene: Scene, fineness: Any, stress: bool = False) -> CellSolver:
        return CellSolver(scene, fineness, stress=stress)

    def work(self, scene: Scene, fineness: SurfaceDiscretisation, plan: Plan) -> Pairs:
        """Yield names and texts of grid, tolerance, increments, time and memory of a planned solve.

        The text marks a grid that the program has chosen. The time is estimated by a coarse solve.
        """
        grid = semi_analytical.discretise(scene, fineness)
        left_open = [name for name in ("cells", "window") if getattr(fineness, name) is None]
        chosen = f" ({' and '.join(left_open)} chosen)" if left_open else ""
        yield "grid", _grid_text(grid) + chosen
        yield "tolerance", f"{fineness.tolerance:.3g}"
        yield "increments", increments_text(plan.increments)
        if any(step.path_matters for step in plan.path):
            accuracy = f"{fineness.path_accuracy:.3g}, for load steps without prescribed increments"
            yield "path accuracy", accuracy
        yield self._time(scene, fineness, grid, plan)
        yield from _saving(scene, fineness, grid, plan)
        yield "memory", f"about {estimated_bytes(grid, plan) / 2**20:.0f} MiB"

    def _time(
        self,
        scene: Scene,
        fineness: SurfaceDiscretisation,
        grid: SurfaceGrid,
        plan: Plan,
        most: int = MAX_CELLS,
    ) -> tuple[str, str]:
        """Estimate the CPU time of a run from a coarse solve of its first load steps.

        The cells are doubled while the coarse solve does not resolve the contact. Returns the word
        "time" and the text of the estimate.

        most  largest number of cells of the coarse solve along a side
        """
        path = plan.path[:MAX_STEPS]
        cut = replace(plan, path=path).cut_into(coarse_increments([s.count for s in path]))
        begin = scene.model_copy(update={"loading": scene.loading[:MAX_STEPS]})
        share = min(1.0, most / max(grid.cells))
        nx, ny = (n if share == 1 else max(FEWEST, 2 * round(share * n / 2)) for n in grid.cells)
        coarse = fineness.model_copy(update={"cells": (nx, ny)})
        try:
            return time_of_run(
                lambda: semi_analytical.solve_discretised(begin, coarse, plan=cut),
                self.errors,
                work_on_cells((nx, ny), cut.increments, plan.shear),
                work_on_cells(grid.cells, plan.increments, plan.shear),
            )
        except ContactNotResolved:
            if share == 1:
                raise
            return self._time(scene, fineness, grid, plan, 2 * most)

    def reasons(self, plan: Plan) -> Sequence[tuple[str, str, str]]:
        """Return load step, number of increments and reason of this number, as texts for a table.

        The first load steps are listed. The sequence is empty if no load step has an increment
        error.
        """
        if not any(step.path_matters for step in plan.path):
            return ()
        shown = [
            (str(number), str(step.count), step.why)
            for number, step in enumerate(plan.path[:MAX_STEPS_SHOWN], start=1)
        ]
        return shown if len(plan.path) <= MAX_STEPS_SHOWN else [*shown, ("…", "", "")]

    def layout(self, result: Result) -> Pairs:
        yield "grid", _grid_text(result.grid)


def _saving(scene: Scene, fineness: SurfaceDiscretisation, grid: SurfaceGrid, plan: Plan) -> Pairs:
    """Yield the reduction of the number of convolutions because the plan omits effects.

    The convolutions dominate the cost of a solve. The ratio is measured by two coarse solves of the
    first load steps: one with the planned effects, one with all effects. A ratio below
    `LEAST_SAVING` is not reported.

    grid  grid of the planned solve
    plan  effects and increments of the planned solve
    """
    forced = all_effects(plan)
    if not any(was.on < now.on for was, now in zip(plan.effects, forced.effects, strict=True)):
        return
    steps = plan.path[:FORCED_INCREMENTS]
    begin = scene.model_copy(update={"loading": scene.loading[:FORCED_INCREMENTS]})
    cells = tuple(min(n, MAX_CELLS) for n in grid.cells)
    coarse = fineness.model_copy(update={"cells": cells})
    counts = []
    try:
        for each in (plan, forced):
            cut = replace(each, path=steps).cut_into([1] * len(steps))
            result = semi_analytical.solve_discretised(begin, coarse, plan=cut)
            counts.append(sum(increment.convolutions for increment in result.increments))
    except SolverError:
        return
    ratio = counts[1] / counts[0]
    if ratio >= LEAST_SAVING:
        yield "saving", f"all effects on would take {ratio:.2g} times the convolutions"


def _grid_text(grid: SurfaceGrid) -> str:
    """Return the text of cells and window of a grid, such as "64 x 64 cells on 2 x 2 mm"."""
    (nx, ny), (Lx, Ly) = grid.cells, grid.window
    length = engineering_unit(max(Lx, Ly), "m")
    return f"{nx} x {ny} cells on {Lx / length.size:.4g} x {length.text(Ly)}"
