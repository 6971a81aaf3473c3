"""Contact problem at the points of the surface: compliance, gap, friction, and contact law."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from contact_scene.array_types import Vector
from contact_scene.body_pair import contact_modulus
from contact_scene.checks.axisymmetric import friction_at_radii
from contact_scene.friction import FRICTIONLESS, CoulombFriction
from contact_scene.quantities.residuals import Residuals
from contact_scene.quantities.summary import ContactStatus
from contact_scene.rig import compliances
from fem_reference.compliance.angular_grid import AngularGrid
from fem_reference.compliance.point_compliance import PointCompliance
from fem_reference.compliance.ring_compliance import (
    RingCompliance,
    ring_compliance,
)
from fem_reference.compliance.ring_edge import GaussEdge
from fem_reference.contact.augmented_lagrangian import Penalty
from fem_reference.contact.point_state import PointState
from fem_reference.memory import matrix_bytes, refuse_if_too_large
from fem_reference.mesh.element_order import ELEMENTS
from fem_reference.model import ContactModel
from fem_reference.plan import ANGULAR, Path


@dataclass(frozen=True)
class PointContact:
    """Contact problem of two bodies at the points of the surface, without loads.

    compliance  displacement of all points per traction on all points
    friction    Coulomb friction between the surfaces
    penalty     parameters of the penalty law; None for the exact laws of Signorini and Coulomb
    rig         compliances of the springs of a test rig, normal and tangential [length/force]
    """

    compliance: PointCompliance
    friction: CoulombFriction
    penalty: Penalty | None = None
    rig: tuple[float, float] = (0.0, 0.0)

    @property
    def rings(self) -> RingCompliance:
        """Rings of the surface that contain the points, with the compliance of the rings."""
        return self.compliance.rings

    @property
    def gap(self) -> Vector:
        """Gap between the undeformed surfaces at first contact, at the points (points,) [length].

        The value of a point is the weighted mean over its ring.
        """
        return self.rings.gap[self.compliance.ring_of_point]

    @property
    def axisymmetric(self) -> bool:
        """True if the contact problem has one point on each ring.

        The fields then do not depend on the angle.
        """
        return self.compliance.grid.highest == 0

    @property
    def at_gauss_points(self) -> bool:
        """True if tractions are given at Gauss points of the element edges, as for the penalty law.

        The displacements cannot distinguish the pressures of all Gauss points, so that these
        pressures may oscillate.
        """
        return isinstance(self.rings.edge, GaussEdge)

    def state_before_contact(self) -> PointState:
        """Create the contact state before first contact: no tractions and the undeformed gap.

        Used as the state at the start of the first increment.
        """
        nothing = np.zeros((3, len(self.gap)))
        return PointState(
            axisymmetric=self.axisymmetric,
            pressure=nothing[2],
            shear=nothing[:2],
            displacement=nothing[:2],
            multiplier=nothing,
            gap=self.gap,
            slip=nothing[:2],
            in_stick=np.zeros(len(self.gap), dtype=bool),
            status=ContactStatus.FULL_STICK,
            normal_force=0.0,
            approach=0.0,
            loads=(0.0, 0.0, 0.0),
            motions=(0.0, 0.0, 0.0),
            twist=0.0,
            dissipated_energy=0.0,
            residuals=Residuals(0.0, 0.0),
        )

    def extend_to_points(self, state: PointState) -> PointState:
        """Extend an axisymmetric contact state to several points on each ring of the surface.

        Used when the first tangential load on coupled bodies ends the axisymmetry. Every point
        takes the values of its ring.

        state  contact state with one point per ring
        """
        ring = self.compliance.ring_of_point
        lifted: dict[str, Any] = {
            k: v[..., ring] for k, v in vars(state).items() if isinstance(v, np.ndarray)
        }
        return replace(state, axisymmetric=self.axisymmetric, **lifted)


def point_contact(
    model: ContactModel, path: Path, grid: AngularGrid, penalty: Penalty | None = None
) -> PointContact:
    """Create the contact problem of two bodies on the rings of their mesh and the angles of a grid.

    The penalty law acts at Gauss points, except on paths with angles, where it acts at nodes. Raise
    ResourceRefused if the memory is insufficient for the compliance matrix of all points.

    model    the two bodies with their meshes, compliances, undeformed gap and friction
    path     tractions that the solve computes
    grid     angular points on each ring
    penalty  parameters of the penalty law; None for the exact laws of Signorini and Coulomb
    """
    rings = ring_compliance(
        model, path, grid.highest, at_gauss_points=bool(penalty) and path not in ANGULAR
    )
    refuse_if_too_large(matrix_bytes(len(rings.radii) * grid.points))
    springs = 0.0
    if penalty:
        edge = float(model.radii[ELEMENTS.degree] - model.radii[0])
        springs = 1 / penalty.stiffness(contact_modulus(model.scene), edge)
    compliance = PointCompliance(rings, grid, springs)
    friction = FRICTIONLESS
    if path is not Path.PRESSING:
        friction = friction_at_radii(model.friction, rings.radii[compliance.ring_of_point])
    return PointContact(compliance, friction, penalty, compliances(model.scene.rig))
