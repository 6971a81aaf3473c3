"""Solve a scene: plan, model, march."""

from collections.abc import Callable

from contact_scene import HeightMap, Scene, SurfaceDiscretisation
from semi_analytical.discretise import GROWTH, discretise
from semi_analytical.errors import ContactAtWindowEdge
from semi_analytical.fields import Increment, Result
from semi_analytical.grid import SurfaceGrid
from semi_analytical.history import march
from semi_analytical.memory import refuse_if_too_large
from semi_analytical.model import ContactModel
from semi_analytical.plan import plan

Progress = Callable[[Increment], None]

MOST_ENLARGEMENTS = 5


def solve(
    scene: Scene, grid: SurfaceGrid, tolerance: float, progress: Progress | None = None
) -> Result:
    """Contact of a scene on a grid, every increment of its load history.

    Parameters
    ----------
    scene
        What is solved.
    grid
        Cells and window; all tractions are constant on a cell.
    tolerance
        Bound of every dimensionless residual at the end of every increment.
    progress
        Called with each increment once it has converged.

    Raises
    ------
    UnsupportedScene
        The scene asks for physics that is not here.
    ContactAtWindowEdge
        The contact reaches the border of the window.
    ContactNotResolved
        The cells are so large that none touches.
    GrossSliding
        A tangential force exceeds the friction limit.
    NotConverged
        An increment stopped above the tolerance; `last_state` holds the last good one.
    ResourceRefused
        The grid needs more memory than there is.
    """
    decided = plan(scene)
    refuse_if_too_large(grid, decided)
    model = ContactModel.of(scene, grid)
    increments = []
    for increment in march(model, decided, tolerance):
        increments.append(increment)
        if progress is not None:
            progress(increment)
    return Result(scene, grid, tolerance, decided, tuple(increments))


def solve_discretised(
    scene: Scene, discretisation: SurfaceDiscretisation, progress: Progress | None = None
) -> Result:
    """Solve a scene on the grid that its file asks for.

    A window that is not given is fitted to the contact, and enlarged if the contact of some
    increment reaches its edge after all; the window of a height map is all of it. Raises what
    `solve` raises.
    """
    grid = discretise(scene, discretisation)
    for _ in range(MOST_ENLARGEMENTS):
        try:
            return solve(scene, grid, discretisation.tolerance, progress)
        except ContactAtWindowEdge:
            if discretisation.window is not None or isinstance(scene.indenter, HeightMap):
                raise
            grid = SurfaceGrid(grid.cells, (GROWTH * grid.window[0], GROWTH * grid.window[1]))
    return solve(scene, grid, discretisation.tolerance, progress)
