"""Solve a scene: plan, rings and load stepping."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from contact_scene import LoadRamp, RadialDiscretisation, Scene
from contact_scene.array_types import Array
from contact_scene.machine.blas_threads import one_thread
from contact_scene.normal_form import normal_form
from contact_scene.quantities.residuals import Residuals
from contact_scene.rig import of_contact
from contact_scene.stepping.checkpoint import (
    Checkpoint,
    CheckpointStore,
)
from contact_scene.stepping.load_stepping import (
    Reached,
    resumable_increments,
)
from radial.fields import Increment, Result
from radial.memory import refuse_if_too_large
from radial.normal.pressing import (
    Pressed,
    pressed,
)
from radial.normal.surface import (
    displacement,
    largest_pressure,
    pressure,
)
from radial.output_points import (
    largest_targets,
    refuse_no_disc,
    refuse_round_off,
    shown_radii,
    target,
    undeformed_gap,
)
from radial.plan import Plan
from radial.plan import plan as plan_of
from radial.response.bodies import Bodies

Progress = Callable[[Increment], None]


@one_thread()
def solve(
    scene: Scene,
    discretisation: RadialDiscretisation | None = None,
    progress: Progress | None = None,
    plan: Plan | None = None,
    store: CheckpointStore | None = None,
) -> Result:
    """Solve the contact of a scene of revolution for all increments of its load history.

    Parameters
    ----------
    scene
        The contact problem.
    discretisation
        Number of output rings and tolerance of every residual. Default: `RadialDiscretisation()`.
    progress
        Called with each increment after its solve.
    plan
        Result of `plan(scene)`, which is computed if absent.
    store
        Checkpoints of an earlier run of the same solve. The solve resumes after the last one.

    Raises
    ------
    UnsupportedScene
        The scene is not of revolution or has an effect that this solver lacks, or the surfaces
        separate within the contact.
    ResourceRefused
        The estimated memory exceeds the available memory.
    NotConverged
        An increment did not reach the tolerance. `last_state` is the last converged increment.
    """
    asked = discretisation or RadialDiscretisation()
    scene = normal_form(scene)
    decided = plan_of(scene) if plan is None else plan
    refuse_if_too_large(scene, decided)
    solver = _solver(scene, asked, decided)
    if asked.extrapolated and decided.circle:
        return Result(scene, asked, decided, _extrapolated(scene, solver, decided, progress, store))
    increments = []
    for increment in _marched(scene, solver, decided, store):
        increments.append(increment)
        if progress is not None:
            progress(increment)
    return Result(scene, asked, decided, tuple(increments))


def _marched(
    scene: Scene, solver: Any, plan: Plan, store: CheckpointStore | None
) -> Iterator[Increment]:
    """Yield all increments: first those of the last checkpoint, then newly solved ones."""
    last = store.last() if store else None
    increments = [*last.increments] if last else []
    yield from increments
    for increment, mark in resumable_increments(scene, plan.increments, solver, last):
        increments.append(increment)
        if store is not None:
            store.keep(Checkpoint(tuple(increments), mark, None))
        yield increment


def _extrapolated(
    scene: Scene, solver: Any, plan: Plan, progress: Progress | None, store: CheckpointStore | None
) -> tuple[Increment, ...]:
    """Return increments extrapolated to the limit of fine increments.

    The checkpoints are those of the finer history.
    """
    from radial.richardson import (
        doubled,
        extrapolated,
    )

    coarse = iter([*_marched(scene, solver, plan, None)])
    increments = []
    for fine in _marched(scene, solver, doubled(plan), store):
        if fine.index % 2 == 0:
            increments.append(extrapolated(next(coarse), fine))
            if progress is not None:
                progress(increments[-1])
    return tuple(increments)


def _solver(scene: Scene, asked: RadialDiscretisation, plan: Plan) -> Any:
    if plan.circle:
        from radial.tangential.tangential_steps import Pushing

        return Pushing.of(scene, asked, plan)
    if plan.coupled:
        from radial.frictional.frictional_indentation_steps import Rubbing

        return Rubbing.of(scene, asked, plan.fineness)
    pressing = _Solver.of(scene, asked, round(plan.fineness))
    if not plan.twists:
        return pressing
    from radial.torsion.torsion_steps import Twisting

    assert scene.friction is not None
    assert scene.friction.uniform is not None
    return Twisting(scene, pressing, scene.friction.uniform, pressing.fineness, asked.tolerance)


@dataclass(frozen=True)
class _Solver:
    """Load stepping of the frictionless contact. No increment depends on the previous one.

    fineness  multiple of the numbers of orders and points
    radii     of the rings [length]
    largest   contacts solved to place the rings
    """

    scene: Scene
    bodies: Bodies
    tolerance: float
    fineness: int
    radii: Array
    largest: tuple[Pressed, ...]
    most_spent: float = 0.0

    @classmethod
    def of(cls, scene: Scene, asked: RadialDiscretisation, fineness: int) -> _Solver:
        bodies = Bodies.of(scene)
        largest = tuple(
            pressed(bodies, scene.indenter, led, fineness) for led in largest_targets(scene)
        )
        rings = shown_radii(asked.rings, largest, scene.indenter.rim)
        return cls(scene, bodies, asked.tolerance, fineness, rings, largest)

    def spent(self) -> float:
        """Return 0: work does not limit the bisection."""
        return 0.0

    def advance(
        self, ramp: LoadRamp, start: Pressed | None, before: Pressed | None, fraction: float
    ) -> Pressed:
        """Return the contact at a fraction of the ramp."""
        reached = (start.normal_force, start.approach) if start else (0.0, 0.0)
        led = target(self.scene, *ramp.normal.led(fraction, reached))
        for found in self.largest:
            if found.target == led:
                return found
        return pressed(self.bodies, self.scene.indenter, led, self.fineness)

    def undeformed_gap(self, last: Increment, tilt: Any) -> Array:
        """Return the gap without tractions at the rings of an increment [length]."""
        return undeformed_gap(self.scene, last)

    def report(self, reached: Reached[Pressed], last: Increment | None) -> Increment:
        """Return the increment with its fields at the rings.

        Raises UnsupportedScene if the contact area is no disc, NotConverged above the tolerance.
        """
        state = reached.state
        contact, x = state.contact, self.radii / state.contact.radius
        refuse_round_off(contact, self.tolerance)
        p = pressure(contact, x)
        gap = np.zeros_like(x)
        apart = x > 1
        undeformed = self.scene.indenter.initial_gap(self.radii[apart], 0.0)
        gap[apart] = undeformed + displacement(contact, x[apart]) - contact.approach
        refuse_no_disc(self.radii, p, gap / contact.approach)
        force = state.target.force
        residuals = Residuals(
            complementarity=contact.missed,
            penetration=max(contact.missed, -float(np.min(gap)) / contact.approach),
            normal_equilibrium=None if force is None else abs(contact.load / force - 1),
        )
        residuals.require(self.tolerance, "the contact radius", state.tried)
        worked = 0.0 if last is None else last.trapezoidal_work or 0.0
        begun = (0.0, 0.0) if last is None else (last.normal_force, last.approach)
        approach = state.approach - state.target.spring * state.normal_force
        worked += 0.5 * (begun[0] + state.normal_force) * (approach - begun[1])
        increment = Increment(
            step=reached.place.step,
            index=reached.place.index,
            increments_in_step=reached.place.increments_in_step,
            residuals=residuals,
            iterations=state.tried,
            halvings=reached.halvings,
            normal_force=state.normal_force,
            approach=state.approach,
            contact_radius=contact.radius,
            peak_pressure=largest_pressure(contact, x, p),
            elastic_energy=contact.elastic_energy,
            input_work=contact.elastic_energy,
            unresolved_work=worked - contact.elastic_energy,
            radii=self.radii,
            pressure=p,
            gap=gap,
        )
        return of_contact(increment, self.scene.rig)
