"""The penalty model's law at a point: overlap in, pressure and shear out, with the tangent.

Arrays are those of `penalty_surface`: component first, then the point.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from contact_scene.friction import CoulombFriction
from fem_reference.contact.penalty.coulomb_return import coulomb_return
from fem_reference.contact.penalty.law import penalty_pressure

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Response:
    """Tractions (c, n), their tangent ∂t/∂v (c, c, n), points in contact and in slip (n,)."""

    traction: Field
    tangent: Field
    in_contact: Mask
    in_slip: Mask


@dataclass(frozen=True)
class PenaltyLaw:
    """Traction by overlap, with what the surfaces remember.

    stiffness    ε, the same along the normal and along the surface [force/length^3]
    friction     between the surfaces
    multiplier   λ: pressure and shear that need no overlap (c, n) [force/length^2]
    reference    overlap along the surface at the end of the last increment (c − 1, n) [length]
    """

    stiffness: float
    friction: CoulombFriction
    multiplier: Field
    reference: Field

    def trial_shear(self, overlap: Field) -> Field:
        """q_trial (c − 1, n): overlap grows where slip is negative, hence the plus."""
        return self.multiplier[1:] + self.stiffness * (overlap - self.reference)

    def normal_springs(self, overlap: Field) -> Response:
        """Pressure (1, n) at v_z (1, n)."""
        p = penalty_pressure(-overlap, self.stiffness, self.multiplier[:1])
        touching = p[0] > 0
        tangent = np.where(touching, self.stiffness, 0.0)
        return Response(p, tangent[None, None], touching, np.zeros_like(touching))

    def tangential_springs(self, overlap: Field, pressure: Field) -> Response:
        """Shear (c − 1, n) at overlaps along the surface (c − 1, n), under a pressure (n,)."""
        returned = coulomb_return(self.trial_shear(overlap), self.friction.limit(pressure))
        touching = pressure > 0
        tangent = self.stiffness * returned.by_trial * touching
        return Response(returned.shear, tangent, touching, returned.in_slip & touching)

    def response(self, overlap: Field) -> Response:
        """Pressure and shear (c, n) at overlaps (c, n), with the consistent tangent."""
        normal = self.normal_springs(overlap[:1])
        p = normal.traction[0]
        returned = coulomb_return(self.trial_shear(overlap[1:]), self.friction.limit(p))
        tangent = np.zeros((len(overlap), *overlap.shape))
        tangent[:1, :1] = normal.tangent
        tangent[1:, 1:] = self.stiffness * returned.by_trial * normal.in_contact
        # In slip the limit follows the pressure: here the tangent loses its symmetry.
        tangent[1:, 0] = self.friction.slope() * returned.by_limit * normal.tangent[0]
        traction = np.concatenate([normal.traction, returned.shear])
        return Response(traction, tangent, normal.in_contact, returned.in_slip & normal.in_contact)

    def carrying(self, traction: Field) -> Self:
        """The law after an Uzawa update: these tractions need no overlap any more."""
        return replace(self, multiplier=traction)
