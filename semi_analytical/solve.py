"""Solve a scene: plan, model, march."""

from collections.abc import Callable, Sequence

from contact_scene import Scene, SurfaceDiscretisation
from contact_scene.machine.blas_threads import one_thread
from contact_scene.normal_form import normal_form
from contact_scene.quantities.stored_fields import FieldStore
from contact_scene.solver_errors import ContactAtWindowEdge
from contact_scene.stepping.checkpoint import (
    Checkpoint,
    CheckpointStore,
)
from semi_analytical.default_grid import (
    discretise,
    enlarged,
    refuse_small_window,
)
from semi_analytical.fields import Increment, Result
from semi_analytical.grid import SurfaceGrid
from semi_analytical.history import marked
from semi_analytical.memory import refuse_if_too_large
from semi_analytical.model import ContactModel
from semi_analytical.plan import Plan
from semi_analytical.plan import plan as plan_of
from semi_analytical.resolution import refuse_unresolved

Progress = Callable[[Increment], None]

MAX_ENLARGEMENTS = 5
# Increments of a history from which on the largest contact is computed first.
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
        Called with each increment once it has converged, or is known to have.
    plan
        Which effects are computed; those that the scene calls for if absent.
    store
        Of this very solve: what it has kept is not computed again.

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
    scene = normal_form(scene)
    decided = plan_of(scene) if plan is None else plan
    refuse_if_too_large(grid, decided)
    model = ContactModel.of(scene, grid, decided.symmetry)
    last = store.last() if store else None
    since = last if last and last.extent == grid else None
    increments, fields = [*since.increments] if since else [], FieldStore()
    if progress is not None:
        for increment in increments:
            progress(increment)
    for increment, mark in marked(model, decided, tolerance, since):
        increments.append(fields.kept(increment))
        if store is not None:
            store.keep(Checkpoint(tuple(increments), mark, grid))
        if progress is not None:
            progress(increment)
    return Result(scene, grid, tolerance, decided, tuple(increments))


def solve_discretised(
    scene: Scene,
    discretisation: SurfaceDiscretisation,
    progress: Progress | None = None,
    plan: Plan | None = None,
    store: CheckpointStore | None = None,
) -> Result:
    """Solve a scene on the grid that its file asks for.

    A window that is not given is fitted to the contact, and enlarged if the contact of some
    increment reaches its edge after all; the window of a height map is all of it. Raises what
    `solve` raises, and ContactNotResolved where only a few cells carry the load.
    """
    scene, decided = normal_form(scene), plan
    if decided is None:
        decided = plan_of(scene, discretisation.path_accuracy, discretisation.edge)
    first = discretise(scene, discretisation)
    grids = [first]
    if discretisation.window is None and scene.indenter.extent is None:
        for _ in range(MAX_ENLARGEMENTS):
            larger = enlarged(scene, discretisation, grids[-1])
            if larger == grids[-1]:  # all that a map of friction covers
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

    Raises what `solve` raises.
    """
    last = store.last() if store else None
    if last and last.extent in grids:  # the smaller ones have been outgrown
        grids = grids[grids.index(last.extent) :]
    for grid in grids[:-1]:
        try:
            return solve(scene, grid, tolerance, progress, plan, store)
        except ContactAtWindowEdge:
            continue
    return solve(scene, grids[-1], tolerance, progress, plan, store)
