"""Contact problem on points: compliance, undeformed gap, friction, and the law of contact."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from contact_scene.array_types import Vector
from contact_scene.body_pair import contact_modulus
from contact_scene.friction import FRICTIONLESS, CoulombFriction
from contact_scene.quantities.residuals import Residuals
from contact_scene.quantities.summary import ContactStatus
from fem_reference.compliance.angular_grid import AngularGrid
from fem_reference.compliance.point_compliance import PointCompliance
from fem_reference.compliance.ring_compliance import (
    RingCompliance,
    ring_compliance,
)
from fem_reference.compliance.ring_edge import GaussEdge
from fem_reference.contact.augmented_lagrangian import Penalty
from fem_reference.contact.point_state import PointState
from fem_reference.memory import require_memory
from fem_reference.model import ContactModel
from fem_reference.plan import Path

COPIES = 4  # of the matrix between all points, during its assembly and restriction


@dataclass(frozen=True)
class PointContact:
    """Compliance, friction, and the law of contact.

    penalty   None: the exact law of Coulomb and Signorini
    """

    compliance: PointCompliance
    friction: CoulombFriction
    penalty: Penalty | None = None

    @property
    def rings(self) -> RingCompliance:
        """The rings that the points are on."""
        return self.compliance.rings

    @property
    def gap(self) -> Vector:
        """Undeformed gap, the mean over each point's function (points,) [length]."""
        return self.rings.gap[self.compliance.ring_of_point]

    @property
    def axisymmetric(self) -> bool:
        """True if points are whole rings."""
        return self.compliance.grid.highest == 0

    @property
    def at_gauss_points(self) -> bool:
        """True if the displacements cannot distinguish the pressures of all points."""
        return isinstance(self.rings.edge, GaussEdge)

    def untouched(self) -> PointState:
        """Return the state before first contact."""
        nothing = np.zeros((3, len(self.gap)))
        return PointState(
            axisymmetric=self.axisymmetric,
            pressure=nothing[2],
            shear=nothing[:2],
            displacement=nothing[:2],
            multiplier=nothing,
            edge_tractions=nothing,
            gap=self.gap,
            slip=nothing[:2],
            in_stick=np.zeros(len(self.gap), dtype=bool),
            status=ContactStatus.FULL_STICK,
            normal_force=0.0,
            approach=0.0,
            load=0.0,
            motion=0.0,
            dissipated_energy=0.0,
            residuals=Residuals(0.0, 0.0),
        )

    def lifted(self, state: PointState) -> PointState:
        """Extend an axisymmetric state to these points."""
        ring = self.compliance.ring_of_point
        lifted: dict[str, Any] = {
            k: v[..., ring] for k, v in vars(state).items() if isinstance(v, np.ndarray)
        }
        return replace(state, axisymmetric=self.axisymmetric, **lifted)


def point_contact(
    model: ContactModel, path: Path, grid: AngularGrid, penalty: Penalty | None = None
) -> PointContact:
    """Compute the contact problem of a model on the rings of its mesh and the angles of a grid.

    The penalty law acts at Gauss points, but on harmonics at nodes.
    Raises ResourceRefused where the memory does not suffice for the matrix between all points.
    """
    rings = ring_compliance(
        model, path, grid.highest, at_gauss_points=bool(penalty) and path is not Path.HARMONICS
    )
    unknowns = 3.0 * len(rings.radii) * grid.points
    require_memory(COPIES * 8 * unknowns**2)
    springs = 0.0
    if penalty:
        edge = float(model.radii[2] - model.radii[0])
        springs = 1 / penalty.stiffness(contact_modulus(model.scene), edge)
    compliance = PointCompliance(rings, grid, springs)
    friction = FRICTIONLESS if path is Path.PRESSING else model.friction
    return PointContact(compliance, friction, penalty)
