"""Solution of a scene by the semi-analytical method: plan, contact model, load stepping."""

from collections.abc import Callable, Sequence

from contact_scene import Scene, SurfaceDiscretisation
from contact_scene.machine import one_thread
from contact_scene.normal_form import normal_form
from contact_scene.solver_errors import ContactAtWindowEdge
from contact_scene.stepping.checkpoint import (
    CheckpointStore,
    store_checkpoints,
)
from semi_analytical.default_grid import (
    discretise,
    enlarge_window,
    refuse_small_window,
)
from semi_analytical.fields import Increment, Result
from semi_analytical.grid import SurfaceGrid
from semi_analytical.history import solve_history
from semi_analytical.memory import refuse_if_too_large
from semi_analytical.model import ContactModel
from semi_analytical.plan import Plan
from semi_analytical.plan import plan as plan_of
from semi_analytical.resolution import refuse_unresolved

Progress = Callable[[Increment], None]

MAX_ENLARGEMENTS = 5
# Least number of increments of a history for which the largest contact is computed in advance.
FORESEEN = 4


@one_thread()
def solve(
    scene: Scene,
    grid: SurfaceGrid,
    tolerance: float,
    progress: Progress | None = None,
    plan: Plan | None = None,
    store: CheckpointStore | None = None,
) -> Result:
    """Solve a scene on a grid for every increment of its load history.

    Parameters
    ----------
    scene
        Scene to solve.
    grid
        Cells and window; all tractions are uniform in each cell.
    tolerance
        Limit of every dimensionless residual at the end of every increment.
    progress
        Called with each increment, stored ones included.
    plan
        Effects to compute; None for those that the scene requires.
    store
        Checkpoints of the same solution: stored increments are not computed again.

    Raises
    ------
    UnsupportedScene
        The scene has features that are not implemented.
    ContactAtWindowEdge
        The contact reaches the border of the window.
    ContactNotResolved
        No cell comes into contact: the cells are too large.
    GrossSliding
        A tangential force exceeds the friction limit.
    NotConverged
        A residual remains above the tolerance; `last_state` is the last converged increment.
    ResourceRefused
        The grid needs more memory than is available.
    """
    scene = normal_form(scene)
    decided = plan_of(scene) if plan is None else plan
    refuse_if_too_large(grid, decided)
    model = ContactModel.from_scene(scene, grid, decided.symmetry)
    last = store.last() if store else None
    since = last if last and last.extent == grid else None
    history = solve_history(model, decided, tolerance, since)
    increments = store_checkpoints(history, since, store, progress, grid)
    return Result(scene, grid, tolerance, decided, tuple(increments))


def solve_discretised(
    scene: Scene,
    discretisation: SurfaceDiscretisation,
    progress: Progress | None = None,
    plan: Plan | None = None,
    store: CheckpointStore | None = None,
) -> Result:
    """Solve a scene on the grid that its discretisation settings determine.

    If the window is not prescribed, it is fitted to the contact, and enlarged if the contact of an
    increment reaches its border. For a height map the window is the whole map. Raises the errors of
    `solve`, and ContactNotResolved where only a few cells carry the load.

    scene           scene to solve
    discretisation  settings of the scene file: cells, window, tolerance, edge correction
    progress        function that is called after every increment, or None
    plan            physical effects to compute; None for those that the scene requires
    store           store of checkpoints, from which an interrupted solution is resumed; None
                    without one
    """
    scene, decided = normal_form(scene), plan
    if decided is None:
        decided = plan_of(scene, discretisation.path_accuracy, discretisation.edge)
    first = discretise(scene, discretisation)
    grids = [first]
    if discretisation.window is None and scene.indenter.extent is None:
        for _ in range(MAX_ENLARGEMENTS):
            larger = enlarge_window(scene, discretisation, grids[-1])
            if larger == grids[-1]:  # the whole friction map
                break
            grids.append(larger)
    kept = store is not None and store.last() is not None
    if len(grids) == 1 and not kept and sum(decided.increments) >= FORESEEN:
        refuse_if_too_large(first, decided)
        refuse_small_window(scene, first)
    result = solve_within(scene, grids, discretisation.tolerance, progress, decided, store)
    refuse_unresolved(result)
    return result


def solve_within(
    scene: Scene,
    grids: Sequence[SurfaceGrid],
    tolerance: float,
    progress: Progress | None = None,
    plan: Plan | None = None,
    store: CheckpointStore | None = None,
) -> Result:
    """Solve a scene on the first of several grids whose window contains the contact.

    A larger window is tried if the contact of an increment reaches the border of the window. Raises
    the errors of `solve`.

    scene      scene to solve
    grids      grids of successively larger windows
    tolerance  limit of every dimensionless residual
    progress   function that is called after every increment, or None
    plan       physical effects to compute; None for those that the scene requires
    store      store of checkpoints, from which an interrupted solution is resumed; None without one
    """
    last = store.last() if store else None
    if last and last.extent in grids:  # smaller windows do not contain the contact
        grids = grids[grids.index(last.extent) :]
    for grid in grids[:-1]:
        try:
            return solve(scene, grid, tolerance, progress, plan, store)
        except ContactAtWindowEdge:
            continue
    return solve(scene, grids[-1], tolerance, progress, plan, store)
