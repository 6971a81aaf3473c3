"""Solve a scene by finite elements: plan, mesh, compliances and load stepping."""

from collections.abc import Callable, Iterator
from dataclasses import replace

from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.machine import one_thread
from contact_scene.normal_form import normal_form
from contact_scene.solver_errors import ContactAtZoneEdge
from contact_scene.stepping.checkpoint import (
    CheckpointStore,
    ResumePoint,
    store_checkpoints,
)
from fem_reference.compliance.angular_grid import end_grid, whole_grid
from fem_reference.contact.augmented_lagrangian import Penalty
from fem_reference.contact.method import ContactMethod
from fem_reference.contact.point_state import PointState
from fem_reference.expected_radius import meshed_radius
from fem_reference.fields import Increment, Method, Result
from fem_reference.history import resumable_solve
from fem_reference.model import ContactModel
from fem_reference.plan import Path, Plan, plan

Progress = Callable[[Increment], None]

GROWTH = 1.2
MAX_ENLARGEMENTS = 8
# Largest ratio of the radius of the mesh to the computed contact radius. Above this ratio most fine
# elements are outside of the contact, and the scene is solved again on another mesh.
TOO_LARGE = 1.5


@one_thread()
def solve(
    scene: Scene,
    discretisation: FiniteElementDiscretisation,
    method: Method = Method.COMPLEMENTARITY,
    progress: Progress | None = None,
    store: CheckpointStore | None = None,
) -> Result:
    """Solve the contact of a scene by axisymmetric finite elements for all increments.

    Parameters
    ----------
    scene
        The contact problem.
    discretisation
        Number of elements, size of the section, and tolerance of every residual.
    method
        Enforcement of the contact and friction laws.
    progress
        Called with each increment after its solve. If the contact does not fit the mesh, the
        history restarts on another mesh, and the calls start again from the first increment.
    store
        Storage of checkpoints. If it contains checkpoints of an earlier run of the same solve, the
        solve resumes after the last one.

    Raises
    ------
    UnsupportedScene
        The scene is not axisymmetric or has an effect that this solver lacks.
    ContactAtZoneEdge
        The contact exceeds the radius `discretisation.contact_radius`.
    ContactNotResolved
        A prescribed approach is so small that no ring comes into contact.
    GrossSliding
        A tangential force or torque exceeds the friction limit.
    SurfacesOverlap
        The overlap of the penalty method exceeds `discretisation.overlap`.
    NotConverged
        An increment did not reach the tolerance. `last_state` is the last converged increment.
    """
    scene = normal_form(scene)
    chosen_plan = plan(scene, penalty=method is Method.PENALTY)
    last = store.last() if store else None
    requested_radius = discretisation.contact_radius
    radius = last.extent if last else meshed_radius(scene, requested_radius)
    enlargements = 0
    while True:
        model = ContactModel.of(scene, discretisation, radius)
        if last:
            model.settled.update(last.settled)
        solver = _create_method(model, chosen_plan, discretisation, method)
        history = resumable_solve(solver, discretisation.tolerance, last)
        try:
            increments = tuple(
                store_checkpoints(
                    _count_factorisations(model, history),
                    last,
                    store,
                    progress,
                    radius,
                    model.settled,
                )
            )
        except ContactAtZoneEdge:
            if radius == requested_radius or enlargements == MAX_ENLARGEMENTS:
                raise
            enlargements += 1
            radius *= GROWTH
        else:
            reached = max(increment.edge_radius for increment in increments)
            # A contact that reached the end of a smaller zone of fine elements extends beyond
            # `reached`, the radius of a circle of its area.
            if enlargements or not 0 < TOO_LARGE * reached < radius:
                return Result(
                    scene, discretisation, model.sections, radius, chosen_plan, increments, method
                )
            radius = reached
        last = None


def _create_method(
    model: ContactModel,
    chosen_plan: Plan,
    discretisation: FiniteElementDiscretisation,
    method: Method,
) -> ContactMethod:
    penalty = None
    if method is Method.PENALTY:
        penalty = Penalty(
            discretisation.penalty, discretisation.augmentations, discretisation.overlap
        )
    grid = whole_grid if chosen_plan.path is Path.WHOLE_CIRCLE else end_grid
    return ContactMethod(model, chosen_plan, penalty, grid(discretisation.harmonics))


def _count_factorisations(
    model: ContactModel, history: Iterator[tuple[Increment, ResumePoint[PointState]]]
) -> Iterator[tuple[Increment, ResumePoint[PointState]]]:
    """Add to each increment the number of sparse factorisations since the previous one."""
    counted = 0
    for increment, point in history:
        spent, counted = model.factorizations - counted, model.factorizations
        yield replace(increment, factorizations=spent), point
