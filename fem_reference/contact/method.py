"""Contact method of a scene: compliance of the bodies, contact law, and selection of the points.

Fields do not depend on the angle θ before the first tangential load, nor in uncoupled contacts
under tangential loads on one line. One point then represents its whole ring.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene.solver_errors import ContactAtZoneEdge
from contact_scene.stepping.load_path import load_changes
from contact_scene.stepping.load_stepping import IncrementPosition
from fem_reference.compliance.angular_grid import (
    AngularGrid,
    axisymmetric_grid,
)
from fem_reference.contact.augmented_lagrangian import Penalty
from fem_reference.contact.increment import advance
from fem_reference.contact.increment_report import report_increment
from fem_reference.contact.point_contact import PointContact, point_contact
from fem_reference.contact.point_state import PointState
from fem_reference.fields import Increment
from fem_reference.loads import Loads
from fem_reference.model import ContactModel
from fem_reference.plan import ANGULAR, Plan


@dataclass(frozen=True)
class ContactMethod:
    """Solver of the increments of a scene by the exact or the penalty law of contact.

    The load stepping calls this class for each increment. The class also converts contact states to
    increments of the result.

    model    the two bodies with their meshes, compliances, undeformed gap and friction
    plan     tractions that the solve computes, and numbers of increments
    penalty  parameters of the penalty law; None for the exact laws of Signorini and Coulomb
    around   angular points on a ring, counted from the direction of the load, for paths with
             angles; None for other paths
    """

    model: ContactModel
    plan: Plan
    penalty: Penalty | None = None
    around: AngularGrid | None = None

    def advance(self, before: PointState | None, loads: Loads, tolerance: float) -> PointState:
        """Solve one load increment: compute the contact state at its end from that at its start.

        The points of the surface are selected by the load: one point per ring if the fields do not
        depend on the angle, else points at several angles.

        before     state at the start of the increment; None before first contact
        loads      prescribed loads or motions at the end of the increment
        tolerance  upper limit of every residual [1]
        raises     NotConverged, SurfacesOverlap, GrossSliding, ContactAtZoneEdge,
                   ContactNotResolved
        """
        contact = self._axisymmetric_contact
        if self.plan.path in ANGULAR:
            axisymmetric = before is None or before.axisymmetric
            if loads.tangential.pushes or not axisymmetric:
                contact = self._angular_contact
                before = before and self._at_angles(before)
        state = advance(contact, before, loads, tolerance)
        self._refuse_contact_at_edge(contact, state)
        return state

    def increment(self, state: PointState, place: IncrementPosition) -> Increment:
        """Convert the contact state at the end of an increment to an increment of the result.

        The result contains the fields over rings and angles, and the loads and motions of the
        indenter.

        state  converged contact state at the points of the surface
        place  load step, and index of the increment in the load step
        """
        contact = self._axisymmetric_contact if state.axisymmetric else self._angular_contact
        return report_increment(contact, state, self.plan, place)

    def stiffness(self, before: PointState | None, state: PointState, step: int) -> dict[str, Any]:
        """Compute the contact stiffnesses at the end of a load step, by the names of the results.

        before  state at the start of the last increment; None before first contact
        state   state at its end
        step    number of the load step, from 1
        """
        from fem_reference.contact.stiffness import contact_stiffness

        contact = self._axisymmetric_contact
        if self.plan.path in ANGULAR:
            contact = self._angular_contact
            before, state = before and self._at_angles(before), self._at_angles(state)
        direction, changes = load_changes(self.model.scene.load_path(), step)
        (x, y), (a, b) = self.plan.direction, direction
        turned = x * a + y * b, x * b - y * a
        return contact_stiffness(contact, before, state, turned, changes)

    def _at_angles(self, state: PointState) -> PointState:
        """Return a contact state at the points of all angles."""
        return self._angular_contact.extend_to_points(state) if state.axisymmetric else state

    def work_on_strain(self, before: PointState | None, state: PointState) -> float:
        """Compute the work of the shear on the imposed strain of the lower body in one increment.

        The work is ½ Σ w (q₀ + q₁)·r Δε over the rings [force length], with the shear q at the
        start and at the end, the change Δε of the strain, and the areas w and radii r of the rings.

        before  contact state at the start of the increment; None before first contact
        state   contact state at the end of the increment
        """
        change = state.strain - (before.strain if before else 0.0)
        if change == 0:
            return 0.0
        compliance, shear = (
            self._axisymmetric_contact.compliance,
            state.shear + (before.shear if before else 0),
        )
        return 0.5 * change * float(np.sum(compliance.areas * compliance.stretch * shear))

    @property
    def undeformed_gap(self) -> NDArray[np.float64]:
        """Gap between the undeformed surfaces at first contact, at the rings (rings,) [length].

        The value of a ring is the weighted mean over its basis function.
        """
        return self._axisymmetric_contact.gap

    @cached_property
    def _axisymmetric_contact(self) -> PointContact:
        grid = axisymmetric_grid(self.model.around)
        return point_contact(self.model, self.plan.path, grid, self.penalty)

    @cached_property
    def _angular_contact(self) -> PointContact:
        assert self.around is not None
        return point_contact(self.model, self.plan.path, self.around, self.penalty)

    def _refuse_contact_at_edge(self, contact: PointContact, state: PointState) -> None:
        """Raise ContactAtZoneEdge, for a solve on a larger mesh,
        if the contact reaches the end of the fine elements and does not end at a rim."""
        last = contact.compliance.ring_of_point == len(contact.rings.radii) - 1
        if not self.model.ends_at_rim and np.any(state.pressure[last] > 0):
            raise ContactAtZoneEdge(
                f"the contact reaches {contact.rings.radii[-1]:.6g} m, where the zone of fine "
                f"elements ends; give a larger contact_radius"
            )
