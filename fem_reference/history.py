"""Load stepping of the finite-element solver.

A contact method solves each increment from the state at the end of the previous increment. Each
state is then converted to an increment of the result.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from contact_scene import LoadRamp, Scene
from contact_scene.array_types import Field
from contact_scene.bulk_strain import UNSTRAINED
from contact_scene.checks.line_contact import lacks_reference
from contact_scene.quantities.per_length import OF_REFERENCE
from contact_scene.quantities.ring_increment import add_work
from contact_scene.rig import add_contact_displacements
from contact_scene.stepping.checkpoint import (
    Checkpoint,
    ResumePoint,
)
from contact_scene.stepping.load_path import ScalarControl
from contact_scene.stepping.load_stepping import (
    ConvergedIncrement,
    Solver,
    resumable_increments,
)
from fem_reference.contact.method import ContactMethod
from fem_reference.contact.point_state import PointState
from fem_reference.fields import Increment
from fem_reference.loads import (
    ACROSS,
    ALONG,
    STILL,
    TWIST,
    Loads,
    NormalTarget,
    TangentialTarget,
)
from fem_reference.plan import TWISTED, Path

# Shifts of the indenter that are possible on the paths with a tangential load.
PUSHED = {
    Path.SHEARING: (ALONG,),
    Path.HARMONICS: (ALONG,),
    Path.WHOLE_CIRCLE: (ALONG, ACROSS),
}


def solved_increments(method: ContactMethod, tolerance: float) -> Iterator[Increment]:
    """Solve the load history of a scene and yield its increments in order.

    method     contact method of the scene
    tolerance  upper limit of every residual [1]
    raises     NotConverged and GrossSliding, with the last converged increment as `last_state`
    """
    return (increment for increment, _ in resumable_solve(method, tolerance))


def resumable_solve(
    method: ContactMethod, tolerance: float, since: Checkpoint | None = None
) -> Iterator[tuple[Increment, ResumePoint[PointState]]]:
    """Solve the load history of a scene and yield each increment with its resume point.

    A resume point contains the contact state from which an interrupted solve continues.

    method     contact method of the scene
    tolerance  upper limit of every residual [1]
    since      checkpoint after which the solve resumes; None for the whole history
    raises     NotConverged and GrossSliding, with the last converged increment as `last_state`
    """
    scene, counts = method.model.scene, method.plan.increments
    return resumable_increments(scene, counts, _IncrementSolver(scene, method, tolerance), since)


@dataclass(frozen=True)
class _IncrementSolver(Solver[PointState, Increment]):
    """Finite-element solver of single increments, called by the load stepping of `contact_scene`.

    scene      contact problem
    method     contact method of the scene
    tolerance  upper limit of every residual [1]
    """

    scene: Scene
    method: ContactMethod
    tolerance: float

    def advance(
        self,
        ramp: LoadRamp,
        start: PointState | None,
        before: PointState | None,
        fraction: float,
    ) -> PointState:
        """Solve for the contact state at a given fraction of a load ramp.

        ramp      loads at the start and the end of the load step, linear in between
        start     contact state at the start of the ramp; None at the start of the history
        before    contact state at the end of the previous increment; None at the start of the
                  history
        fraction  part of the ramp at the end of the increment, from 0 to 1
        """
        normal = (start.normal_force, start.approach) if start else (0.0, 0.0)
        loads = Loads(
            NormalTarget(*ramp.normal.prescribed(fraction, normal)),
            self._tangential_target(ramp, start, fraction),
            (ramp.strain(fraction) or UNSTRAINED)[0],
        )
        return self.method.advance(before, loads, self.tolerance)

    def undeformed_gap(self, last: Increment, tilt: Any) -> Field:
        """Return the gap between the undeformed surfaces at the rings of an increment [length].

        Used for increments in which the bodies are separated. The array has the shape of the gap of
        the increment `last`: (rings,) or (rings, angles).

        last  increment whose rings are used
        tilt  not used, since this solver does not tilt the indenter
        """
        return np.array(np.broadcast_to(self.method.undeformed_gap, last.gap.T.shape).T)

    def report(self, reached: ConvergedIncrement[PointState], last: Increment | None) -> Increment:
        """Convert a solved contact state to an increment of the result.

        The increment includes the energies and the displacements of the springs of the test rig.

        reached  solved state with its predecessor and its place in the load history
        last     previous increment of the result, whose energies are continued; None for the first
                 one
        """
        increment = self.method.increment(reached.state, reached.place)
        increment = replace(increment, halvings=reached.halvings)
        if self.method.plan.stiffness and reached.place.index == reached.place.increments_in_step:
            found = self.method.stiffness(reached.before, reached.state, reached.place.step)
            increment = replace(increment, **found)
        if lacks_reference(self.scene.indenter, self.scene.body):
            unknown: dict[str, Any] = dict.fromkeys(OF_REFERENCE)
            increment = replace(increment, **unknown)
        else:
            increment = add_contact_displacements(increment, self.scene.rig)
            resisted = self.method.work_on_strain(reached.before, reached.state)
            increment = add_work(last, increment, resisted)
        if increment.dissipated_energy is None:
            return increment
        uncertain = (last.dissipation_uncertainty if last else None) or 0.0
        if self.method.plan.path_matters[increment.step - 1]:
            uncertain += reached.state.friction_changed
        return replace(increment, dissipation_uncertainty=uncertain)

    def _tangential_target(
        self, ramp: LoadRamp, start: PointState | None, fraction: float
    ) -> TangentialTarget:
        """Return the prescribed tangential loads or motions;
        motions that the path excludes are zero."""
        loads, motions = list(STILL.loads), list(STILL.motions)
        for motion, control in self._controls(ramp).items():
            reached: tuple[float, float | None] = (0.0, 0.0)
            if start is not None:
                reached = start.loads[motion], start.motions and start.motions[motion]
            loads[motion], motions[motion] = control.prescribed(fraction, reached)
        return TangentialTarget(tuple(loads), tuple(motions))

    def _controls(self, ramp: LoadRamp) -> dict[int, ScalarControl]:
        """Return the prescribed load or value of each tangential motion of the path.

        Tangential force and shift are resolved along and across the direction of the load.

        ramp  linear change of the loads in the load step
        """
        plan, tangential, controls = self.method.plan, ramp.tangential, {}
        x, y = plan.direction
        axes = {ALONG: (x, y), ACROSS: (-y, x)}
        for shift in PUSHED.get(plan.path, ()):
            a, b = axes[shift]
            start = tangential.start
            controls[shift] = ScalarControl(
                tangential.kind,
                None if start is None else start[0] * a + start[1] * b,
                tangential.end[0] * a + tangential.end[1] * b,
            )
        if plan.path in TWISTED:
            controls[TWIST] = ramp.twisting
        return controls
