"""Two bodies on points (r, θ), before any load."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from contact_scene.friction import CoulombFriction
from contact_scene.residuals import Residuals
from fem_reference.contact.harmonics.angular_grid import AngularGrid
from fem_reference.contact.harmonics.point_compliance import PointCompliance
from fem_reference.contact.harmonics.point_state import PointState
from fem_reference.contact.harmonics.ring_compliance import ring_compliance
from fem_reference.memory import require_memory
from fem_reference.model import ContactModel

Vector = NDArray[np.float64]

COPIES = 4  # of the matrix between all points, while it is put together or parts are cut out


@dataclass(frozen=True)
class PointContact:
    """Compliance, undeformed gap as a mean over each hat (points,) [length], and µ."""

    compliance: PointCompliance
    gap: Vector
    friction: CoulombFriction

    def untouched(self) -> PointState:
        """The state before first touch."""
        nothing = np.zeros_like(self.gap)
        vectors = np.zeros((2, len(nothing)))
        return PointState(
            compliance=self.compliance,
            pressure=nothing,
            shear=vectors,
            displacement=vectors,
            gap=self.gap,
            slip=vectors,
            in_stick=np.zeros(len(nothing), dtype=bool),
            limit=0.0,
            normal_force=0.0,
            approach=0.0,
            tangential_force=0.0,
            tangential_shift=0.0,
            dissipated_energy=0.0,
            residuals=Residuals(0.0, 0.0),
            carried=np.zeros((3, len(nothing))),
            turns=0,
            solves=0,
        )

    def lifted(self, state: PointState) -> PointState:
        """An axisymmetric state on these points."""
        ring = self.compliance.ring_of_point
        return replace(
            state,
            compliance=self.compliance,
            pressure=state.pressure[ring],
            shear=state.shear[:, ring],
            displacement=state.displacement[:, ring],
            gap=state.gap[ring],
            slip=state.slip[:, ring],
            in_stick=state.in_stick[ring],
            carried=state.carried[:, ring],
        )


def point_contact(
    model: ContactModel, grid: AngularGrid, springs: tuple[float, float]
) -> PointContact:
    """The bodies of a model on the rings of its mesh and the angles of a grid.

    Raises ResourceRefused where the memory does not suffice for the matrix between all points.
    """
    hats = model.hats
    unknowns = 3.0 * len(hats.radii) * grid.points
    require_memory(COPIES * 8 * unknowns**2)
    compliance = PointCompliance(ring_compliance(model, grid.highest), grid, springs)
    gap = (hats.of(model.gap) / hats.weights)[compliance.ring_of_point]
    return PointContact(compliance, gap, model.friction)
