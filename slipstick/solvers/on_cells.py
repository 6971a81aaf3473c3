"""Adapter of the semi-analytical solver to the solver interface of the commands."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import semi_analytical
from contact_scene import Scene, SurfaceDiscretisation
from contact_scene.reading.engineering_units import engineering_unit
from contact_scene.stepping.checkpoint import CheckpointStore
from semi_analytical import Plan, Result, SurfaceGrid
from semi_analytical.increment_counts import WITHOUT_SLIP
from semi_analytical.memory import estimated_bytes
from slipstick.solvers.solver import (
    MAX_STEPS_SHOWN,
    Pairs,
    Progress,
    Solver,
    increments_text,
)

if TYPE_CHECKING:
    from contact_errors.on_cells import CellSolver


class OnCells(Solver):
    """Semi-analytical solver on a grid of surface cells, with the interface `solver.Solver`."""

    table = "semi_analytical"
    discretisation = SurfaceDiscretisation

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

    @property
    def refinable(self) -> type[CellSolver]:
        from contact_errors.on_cells import CellSolver

        return CellSolver

    def refined(self, scene: Scene, fineness: Any, stress: bool = False) -> CellSolver:
        return self.refinable(scene, fineness, stress=stress)

    def work(self, scene: Scene, fineness: SurfaceDiscretisation, plan: Plan) -> Pairs:
        """Yield names and texts of grid, tolerance, increments, time and memory of a planned solve.

        The text marks a grid that the program has chosen.
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
        yield self.time(scene, fineness)
        yield "memory", f"about {estimated_bytes(grid, plan) / 2**20:.0f} MiB"

    def reasons(self, plan: Plan) -> Sequence[tuple[str, str, str]]:
        """Return load step, number of increments and reason of this number, as texts for a table.

        The first load steps are listed. The sequence is empty if no load step has an increment
        error or grows without slip.
        """
        if not any(step.path_matters or step.why == WITHOUT_SLIP for step in plan.path):
            return ()
        shown = [
            (str(number), str(step.count), step.why)
            for number, step in enumerate(plan.path[:MAX_STEPS_SHOWN], start=1)
        ]
        return shown if len(plan.path) <= MAX_STEPS_SHOWN else [*shown, ("…", "", "")]

    def layout(self, result: Result) -> Pairs:
        yield "grid", _grid_text(result.grid)


def _grid_text(grid: SurfaceGrid) -> str:
    """Return the text of cells and window of a grid, such as "64 x 64 cells on 2 x 2 mm"."""
    (nx, ny), (Lx, Ly) = grid.cells, grid.window
    if grid.of_strips:
        return f"{nx} strips on {engineering_unit(Lx, 'm').text(Lx)}"
    length = engineering_unit(max(Lx, Ly), "m")
    return f"{nx} x {ny} cells on {Lx / length.size:.4g} x {length.text(Ly)}"
