"""Solve a scene: plan, mesh, model, march."""

from collections.abc import Callable, Iterator
from dataclasses import replace

from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.machine.blas_threads import one_thread
from contact_scene.normal_form import normal_form
from contact_scene.quantities.stored_fields import FieldStore
from contact_scene.solver_errors import ContactAtZoneEdge
from contact_scene.stepping.checkpoint import (
    Checkpoint,
    CheckpointStore,
    ResumePoint,
)
from fem_reference.compliance.angular_grid import end_grid
from fem_reference.contact.augmented_lagrangian import Penalty
from fem_reference.contact.method import ContactMethod
from fem_reference.contact.point_state import PointState
from fem_reference.expected_radius import meshed_radius
from fem_reference.fields import Increment, Method, Result
from fem_reference.history import marked
from fem_reference.model import ContactModel
from fem_reference.plan import Plan, plan

Progress = Callable[[Increment], None]

GROWTH = 1.2
MAX_ENLARGEMENTS = 8
# A mesh for a contact so many times as large as the one that was found spends its elements beside.
TOO_LARGE = 1.5


@one_thread()
def solve(
    scene: Scene,
    discretisation: FiniteElementDiscretisation,
    method: Method = Method.COMPLEMENTARITY,
    progress: Progress | None = None,
    store: CheckpointStore | None = None,
) -> Result:
    """Contact of a scene by axisymmetric finite elements, every increment of its load history.

    Parameters
    ----------
    scene
        What is solved.
    discretisation
        How many elements, how large the section is, and the tolerance of every residual.
    method
        How contact and friction are enforced.
    progress
        Called with each increment once it has converged; again from the first one where the
        contact does not fit the mesh and another one is taken.
    store
        Of this very solve: what it has kept is not computed again.

    Raises
    ------
    UnsupportedScene
        The scene is not axisymmetric enough, by name.
    ContactAtZoneEdge
        The contact reaches the end of the zone that `discretisation.contact_radius` asks for.
    ContactNotResolved
        A prescribed approach is so small that no ring comes into contact.
    GrossSliding
        A tangential force or torque exceeds the friction limit.
    SurfacesOverlap
        A penalty leaves more overlap than `discretisation.overlap` allows.
    NotConverged
        An increment stopped above the tolerance; `last_state` holds the last good one.
    """
    scene = normal_form(scene)
    decided = plan(scene)
    last = store.last() if store else None
    asked = discretisation.contact_radius
    radius = last.extent if last else meshed_radius(scene, asked)
    enlargements = 0
    while True:
        model = ContactModel.of(scene, discretisation, radius)
        if last:
            model.settled.update(last.settled)
        solver = _solver(model, decided, discretisation, method)
        history = marked(solver, discretisation.tolerance, last)
        try:
            increments = tuple(_told(model, radius, history, last, progress, store))
        except ContactAtZoneEdge:
            if radius == asked or enlargements == MAX_ENLARGEMENTS:
                raise
            enlargements += 1
            radius *= GROWTH
        else:
            reached = max(increment.contact_radius for increment in increments)
            if not 0 < TOO_LARGE * reached < radius:
                return Result(
                    scene, discretisation, model.sections, radius, decided, increments, method
                )
            radius = reached
        last = None


def _solver(
    model: ContactModel,
    decided: Plan,
    discretisation: FiniteElementDiscretisation,
    method: Method,
) -> ContactMethod:
    """The contact method on a model, with the law that is asked for."""
    penalty = None
    if method is Method.PENALTY:
        penalty = Penalty(
            discretisation.penalty, discretisation.augmentations, discretisation.overlap
        )
    return ContactMethod(model, decided, penalty, end_grid(discretisation.harmonics))


def _told(
    model: ContactModel,
    radius: float,
    history: Iterator[tuple[Increment, ResumePoint[PointState]]],
    since: Checkpoint | None,
    progress: Progress | None,
    store: CheckpointStore | None,
) -> Iterator[Increment]:
    """Increments, those of the past first, with the sparse factorisations that fell to them."""
    told: list[Increment] = []
    fields = FieldStore()
    for increment in since.increments if since else ():
        if progress is not None:
            progress(increment)
        told.append(increment)
        yield increment
    counted = 0
    for increment, mark in history:
        spent, counted = model.factorizations - counted, model.factorizations
        told.append(fields.kept(replace(increment, factorizations=spent)))
        if store is not None:
            store.keep(Checkpoint(tuple(told), mark, radius, tuple(sorted(model.settled))))
        if progress is not None:
            progress(told[-1])
        yield told[-1]
