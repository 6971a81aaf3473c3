"""Stick and slip zones, and the derivative of the tangential problem in these zones.

Both components of the shear are free in sticking points. A slipping point has q = µp n + s t with n
along z of the natural map and t perpendicular to n. The free component s has the additional
compliance d = (|z| - µp) / (γ µp) due to the curvature of the friction disc. On free shears the
derivative is Π A Π + d with the map A from shear to displacement and the projection Π on the free
shears.
"""

from functools import cached_property

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_solver.admissible_shear import magnitude
from contact_solver.conjugate_gradients import Map
from contact_solver.slip_compliance_bins import beyond, shares

# Upper limit of d over the self-compliance, for points of very small friction limit.
STIFFEST = 1e6


class ShearZones:
    """Stick and slip zones of one iterate of the tangential problem, with slip directions.

    The zones follow from z = q + γ slip, with the shear q and a stiffness γ: points with |z| above
    the friction limit µp slip.

    stick            1 in sticking points, 0 elsewhere (n,)
    slip             slipping points (n,)
    tangent          unit vector perpendicular to the slip in slipping points, else zero (2, n)
    sliding_shear    µp n in slipping points, n the direction of slip (2, n) [force/length^2]
    slip_compliance  additional compliance d of slipping points perpendicular to the slip, due to
                     the curvature of the friction disc |q| = µp (n,) [length^3/force]
    """

    def __init__(self, z: VectorField, bound: Vector, self_compliance: float) -> None:
        length = magnitude(z)
        self._open = bound > 0
        self._self_compliance = self_compliance
        self.slip = self._open & (length > bound)
        normal = z * np.divide(1.0, length, out=np.zeros_like(length), where=self.slip)
        self.sliding_shear = bound * normal
        excess = np.where(self.slip, length - bound, 0.0)
        least = excess / STIFFEST
        self.slip_compliance = self_compliance * np.divide(
            excess, np.maximum(bound, least), out=np.zeros_like(excess), where=self.slip
        )
        self.tangent = np.stack([-normal[1], normal[0]])
        self.stick = (self._open & ~self.slip).astype(np.float64)
        self._xx = self.stick + self.tangent[0] ** 2
        self._yy = self.stick + self.tangent[1] ** 2
        self._xy = self.tangent[0] * self.tangent[1]

    def free(self, v: VectorField) -> VectorField:
        """Restrict a vector field (2, n) to the components in which the shear can change.

        These are both components in sticking points, and the component perpendicular to the slip in
        slipping points, whose magnitude is the friction limit. All other components become zero.

        v  shear or displacement (2, n)
        """
        across = self._xy * v
        free = np.empty_like(across)
        np.multiply(self._xx, v[0], out=free[0])
        np.multiply(self._yy, v[1], out=free[1])
        free += across[::-1]
        return free

    def has_same_slip(self, other: "ShearZones | None") -> bool:
        """Return True if another iterate has the same slip zone, so that the zones have settled.

        other  zones of the other iterate; None counts as different
        """
        return other is not None and np.array_equal(self.slip, other.slip)

    @cached_property
    def _bin_weights(self) -> Field:
        found = shares(self.slip_compliance / self._self_compliance) * self.slip
        found[-1] *= np.sqrt(1 - self._excess_compliance)
        return found

    @cached_property
    def _unheld(self) -> Field:
        return self._bin_weights[0] + self.stick

    @cached_property
    def _excess_compliance(self) -> Field:
        return beyond(self.slip_compliance / self._self_compliance)

    @cached_property
    def _single_point_inverse(self) -> Field:
        return self._excess_compliance / (self._self_compliance + self.slip_compliance)

    def precondition(self, v: VectorField, inverse: Map) -> VectorField:
        """Apply an approximate inverse of the derivative of the tangential problem to a field v.

        The inverse is

            M = Π χ_0 F⁻¹ χ_0 Π + Σ_j χ_j t (f + d_j)⁻¹ t χ_j,    χ_0 = 1 in sticking points

        Π is the restriction to the free components and t the unit vector perpendicular to the slip.
        F is the map from shear to displacement and f its scalar mean. χ_j are the weights of a
        point in bins of the slip compliance d (see `slip_compliance_bins`). Far beyond the last bin
        d dominates f: there M tends to t (K₀ + d)⁻¹ t, with the self-compliance K₀ of a point.

        v        displacement (2, n)
        inverse  F⁻¹ of two components, then (f + d_j)⁻¹ of one component per bin
        """
        given = np.empty((len(self._bin_weights) + 1, v.shape[1]))
        np.multiply(self._unheld, v, out=given[:2])
        along = self.tangent[0] * v[0] + self.tangent[1] * v[1]
        np.multiply(self._bin_weights[1:], along, out=given[2:])
        found = inverse(given)
        free = self.free(self._unheld * found[:2])
        turned = np.einsum("kn,kn->n", self._bin_weights[1:], found[2:])
        turned += self._single_point_inverse * along
        free += self.tangent * turned
        return free
