"""Companions of a semi-analytical result: its scene on cells twice as wide."""

from __future__ import annotations

from collections.abc import Callable

from contact_scene.solver_errors import ContactAtWindowEdge, ResourceRefused, SolverError
from contact_scene.stated_error import Companion
from semi_analytical import Increment, Plan, Result, SurfaceGrid, solve

Progress = Callable[[Increment], None]

# Room that the contact on wide cells may need beside the window of the run.
WIDER = 1.25
# Convolutions of a companion, on a quarter of the cells, over those of the run: as dear as the run;
# and those that it may take however few the run took.
MOST_CONVOLUTIONS, FEW_CONVOLUTIONS = 4, 200


def on_wide_cells(
    result: Result, plan: Plan, differs: str, progress: Progress | None
) -> tuple[Result | None, Companion]:
    """The scene of a result on cells twice as wide, None if that has no answer, and what it took.

    plan     of the companion
    differs  from the run
    """
    most = max(MOST_CONVOLUTIONS * sum(i.convolutions for i in result.increments), FEW_CONVOLUTIONS)
    spent = 0

    def observe(increment: Increment) -> None:
        nonlocal spent
        spent += increment.convolutions
        if spent > most:
            raise ResourceRefused(f"it would take more than the run itself, {most} convolutions")
        if progress is not None:
            progress(increment)

    grids = [_widened(result.grid, 1.0)]
    if result.scene.indenter.extent is None:
        grids.append(_widened(result.grid, WIDER))
    refused = None
    for grid in grids:
        asked = Companion(differs=differs, cells=grid.cells, increments=plan.increments)
        try:
            coarse = solve(result.scene, grid, result.tolerance, observe, plan)
        except SolverError as error:
            refused = asked.model_copy(update={"refused": str(error)})
            if not isinstance(error, ContactAtWindowEdge):
                break
        else:
            counts = {
                "iterations": sum(i.iterations for i in coarse.increments),
                "convolutions": sum(i.convolutions for i in coarse.increments),
            }
            return coarse, asked.model_copy(update=counts)
    assert refused is not None
    return None, refused


def _widened(grid: SurfaceGrid, room: float) -> SurfaceGrid:
    """Cells twice as wide on a window with this much more room."""
    nx, ny = (max(2, round(room * n / 2)) for n in grid.cells)
    if room == 1:
        return SurfaceGrid((nx, ny), grid.window)
    hx, hy = grid.spacing
    return SurfaceGrid((nx, ny), (2 * hx * nx, 2 * hy * ny))
