"""Load stepping: state, increment, state; the contact method solves the increments."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from contact_scene import LoadRamp, Scene
from contact_scene.array_types import Field
from contact_scene.bulk_strain import UNSTRAINED
from contact_scene.rig import of_contact
from contact_scene.stepping.checkpoint import (
    Checkpoint,
    ResumePoint,
)
from contact_scene.stepping.load_path import ScalarControl
from contact_scene.stepping.load_stepping import (
    Reached,
    resumable_increments,
)
from fem_reference.contact.method import ContactMethod
from fem_reference.contact.point_state import PointState
from fem_reference.energy import accounted
from fem_reference.fields import Increment
from fem_reference.loads import STILL, Loads, NormalTarget, TangentialTarget
from fem_reference.plan import Path


def solved_increments(method: ContactMethod, tolerance: float) -> Iterator[Increment]:
    """Yield the increments of the scene's load path; raises the errors of `resumable_solve`."""
    return (increment for increment, _ in resumable_solve(method, tolerance))


def resumable_solve(
    method: ContactMethod, tolerance: float, since: Checkpoint | None = None
) -> Iterator[tuple[Increment, ResumePoint[PointState]]]:
    """Yield the increments of the scene's load path, each with its resume point.

    since   checkpoint after which the solve resumes
    raises  NotConverged and GrossSliding, with the last converged increment as `last_state`
    """
    scene, counts = method.model.scene, method.plan.increments
    return resumable_increments(scene, counts, _Solver(scene, method, tolerance), since)


@dataclass(frozen=True)
class _Solver:
    """Adapter from a contact method to load stepping. Work does not limit the bisection."""

    scene: Scene
    method: ContactMethod
    tolerance: float
    most_spent: float = 0.0

    def spent(self) -> float:
        """Return 0: work does not limit the bisection."""
        return 0.0

    def advance(
        self,
        ramp: LoadRamp,
        start: PointState | None,
        before: PointState | None,
        fraction: float,
    ) -> PointState:
        """Return the state at a fraction of the ramp."""
        normal = (start.normal_force, start.approach) if start else (0.0, 0.0)
        tangential = (start.load, start.motion) if start else (0.0, 0.0)
        loads = Loads(NormalTarget(*ramp.normal.prescribed(fraction, normal)), STILL)
        along = self._along(ramp)
        if along is not None:
            loads = replace(
                loads, tangential=TangentialTarget(*along.prescribed(fraction, tangential))
            )
        loads = replace(loads, strain=(ramp.strain(fraction) or UNSTRAINED)[0])
        return self.method.advance(before, loads, self.tolerance)

    def undeformed_gap(self, last: Increment, tilt: Any) -> Field:
        """Return the gap without tractions at the rings of an increment [length]."""
        return np.array(np.broadcast_to(self.method.undeformed_gap, last.gap.T.shape).T)

    def report(self, reached: Reached[PointState], last: Increment | None) -> Increment:
        """Return the increment with its energies and the displacements of the rig."""
        increment = self.method.increment(reached.state, reached.place)
        increment = replace(increment, halvings=reached.halvings)
        increment = of_contact(increment, self.scene.rig)
        resisted = self.method.work_on_strain(reached.before, reached.state)
        return accounted(self.scene, self.method.plan, last, increment, resisted)

    def _along(self, ramp: LoadRamp) -> ScalarControl | None:
        """Return the control of the twist, or of the tangential motion along the plan's
        direction."""
        path, control = self.method.plan.path, ramp.tangential
        if path is Path.TWISTING:
            return ramp.twisting
        if path not in (Path.SHEARING, Path.HARMONICS):
            return None
        x, y = self.method.plan.direction
        return ScalarControl(
            control.kind,
            None if control.start is None else control.start[0] * x + control.start[1] * y,
            control.end[0] * x + control.end[1] * y,
        )
