"""The method for coupled bodies under a tangential load: pressure and shear on points (r, θ).

Until there is a tangential load nothing depends on θ, and one point stands for its whole ring.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.march import Place
from fem_reference.contact.augmentation import Penalty
from fem_reference.contact.harmonics.angular_grid import AngularGrid, axisymmetric_grid, end_grid
from fem_reference.contact.harmonics.point_contact import PointContact, point_contact
from fem_reference.contact.harmonics.point_increment import SPRINGS_ALONE, advance
from fem_reference.contact.harmonics.point_state import PointState
from fem_reference.contact.harmonics.reported import reported
from fem_reference.contact.zone_edge import refuse_contact_at_edge
from fem_reference.fields import Increment
from fem_reference.loads import Loads, TangentialTarget
from fem_reference.model import ContactModel
from fem_reference.plan import Plan

HIGHEST = 8
STILL = TangentialTarget(shift=0.0)


def harmonic_method(
    model: ContactModel,
    plan: Plan,
    around: AngularGrid | None = None,
    springs: tuple[float, float] = (0.0, 0.0),
    penalty: Penalty = SPRINGS_ALONE,
) -> "HarmonicMethod":
    """The method for a scene whose plan says Path.HARMONICS.

    around   points on the half circle, from the direction of the load on; None: end_grid(8)
    springs  normal and tangential, 1/penalty [length^3/force]; zero: the law of contact itself
    penalty  how often springs are corrected, where there are any
    """
    return HarmonicMethod(model, plan.direction, around or end_grid(HIGHEST), springs, penalty)


@dataclass(frozen=True)
class HarmonicMethod:
    """Solves increments of a model's scene, and reports them; see `harmonic_method`.

    direction  of the tangential load, unit vector
    """

    model: ContactModel
    direction: tuple[float, float]
    around: AngularGrid
    springs: tuple[float, float]
    penalty: Penalty

    def advance(self, before: PointState | None, loads: Loads, tolerance: float) -> PointState:
        """The state at the end of an increment.

        raises  NotConverged, SurfacesOverlap, GrossSliding, ContactAtZoneEdge
        """
        tangential = loads.tangential or STILL
        is_lifted = before is not None and before.compliance.grid.highest > 0
        if is_lifted or tangential.force or tangential.shift:
            contact = self._on_points
            if before is not None and not is_lifted:
                before = contact.lifted(before)
        else:
            contact, tangential = self._on_rings, STILL
        state = advance(contact, before, loads.normal, tangential, tolerance, self.penalty)
        self._refuse_contact_at_edge(state)
        return state

    def increment(self, state: PointState, place: Place) -> Increment:
        """The state as it is reported."""
        return reported(state, self.model.friction, self.direction, place)

    @cached_property
    def _on_rings(self) -> PointContact:
        return point_contact(self.model, axisymmetric_grid(), self.springs)

    @cached_property
    def _on_points(self) -> PointContact:
        return point_contact(self.model, self.around, self.springs)

    def _refuse_contact_at_edge(self, state: PointState) -> None:
        compliance = state.compliance
        last = compliance.ring_of_point == len(compliance.rings.radii) - 1
        touching = not self.model.ends_at_rim and bool(np.any(state.pressure[last] > 0))
        refuse_contact_at_edge(touching, compliance.rings.radii[-1])
