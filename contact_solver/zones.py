"""Zones of contact, stick and slip, and the free unknowns of a contact problem in them.

With z of the natural map, points in contact with |z| above the friction limit b slip along n = z /
|z|. A slipping point has the shear b n + s t, with t perpendicular to n. The free component s has
the additional compliance d = (|z| - b) / (γ b) due to the curvature of the friction disc |q| = b.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field, Indices, Mask, Matrix, Vector, VectorField
from contact_solver.admissible_shear import magnitude

# Largest slip compliance d over the self-compliance, for points of very small friction limit.
MAX_SLIP_COMPLIANCE = 1e6


@dataclass(frozen=True)
class Zones:
    """Zones of contact, stick and slip of an iterate, and the free unknowns in these zones.

    Free unknowns and the rows of the derivative are vectors: q_x, then q_y of the stick zone, the
    shear s perpendicular to the slip direction n in the slip zone, p of the contact. At a given
    pressure, p is not free, and fields have the components x and y alone.

    contact, stick   points in contact and sticking points (n,)
    slip             flat indices of slipping points (points,)
    normal           direction n of the slip in slipping points (2, points)
    slip_compliance  compliance d of slipping points perpendicular to the slip (points,)
                     [length^3/force]
    friction_slope   µ n in slipping points (2, points), µ the derivative of the friction limit with
                     respect to the pressure; None at a given pressure
    """

    contact: Mask
    stick: Mask
    slip: Indices
    normal: Field
    slip_compliance: Vector
    friction_slope: Field | None = None

    @cached_property
    def tangent(self) -> Field:
        """Unit vector t perpendicular to the slip in slipping points (2, points)."""
        return np.stack([-self.normal[1], self.normal[0]])

    @cached_property
    def stick_points(self) -> Indices:
        return np.flatnonzero(self.stick)

    @cached_property
    def contact_points(self) -> Indices:
        """Points whose pressure is free."""
        return np.flatnonzero(self.contact & (self.friction_slope is not None))

    @cached_property
    def _open_points(self) -> Indices:
        return np.flatnonzero(~self.contact)

    @property
    def size(self) -> int:
        """Number of free unknowns of the linear system of a Newton step.

        They are both components of the shear in the stick zone, the shear across the slip direction
        in the slip zone, and the pressure in contact.
        """
        return 2 * len(self.stick_points) + len(self.slip) + len(self.contact_points)

    def split_unknowns(self, vector: Vector) -> tuple[Vector, Vector, Vector]:
        """Split a vector of the free unknowns of a Newton step into views of its three parts.

        The parts are the shear in the stick zone (2, points), the shear across the slip direction
        in the slip zone (points,) and the pressure in contact (points,).

        vector  free unknowns, or rows of the linear system (size,)
        """
        stuck, slip = 2 * len(self.stick_points), len(self.slip)
        return vector[:stuck].reshape(2, -1), vector[stuck : stuck + slip], vector[stuck + slip :]

    def free(self, v: NDArray[Any]) -> Vector:
        """Restrict a traction or displacement field to the free unknowns of a step.

        Newton's method solves for these unknowns: both tangential components in the stick zone, the
        component across the slip direction in the slip zone, and the normal component in contact.
        The result is a vector (size,).

        v  tractions (q_x, q_y, p) or displacements (u_x, u_y, u_z) (3, n), or x and y alone (2, n)
        """
        # NumPy is many times slower with indices after a slice, so components are separate.
        x, y, *z = v
        free = np.empty(self.size)
        (stuck_x, stuck_y), along, pressed = self.split_unknowns(free)
        stuck_x[:], stuck_y[:] = x[self.stick_points], y[self.stick_points]
        along[:] = self.tangent[0] * x[self.slip] + self.tangent[1] * y[self.slip]
        for normal in z:
            pressed[:] = normal[self.contact_points]
        return free

    def field(self, vector: Vector) -> Field:
        """Convert a vector of the free unknowns of a Newton step to a traction field.

        The shape is (3, n), at a given pressure (2, n). All other components of the field are
        zero.

        vector  free unknowns: shear of sticking points, shear across the slip direction of slipping
                points, pressure of points in contact
        """
        v = np.zeros((2 if self.friction_slope is None else 3, self.contact.size))
        stuck, along, pressed = self.split_unknowns(vector)
        for one, at_stick, tangent in zip(v[:2], stuck, self.tangent, strict=True):
            one[self.stick_points], one[self.slip] = at_stick, tangent * along
        for normal in v[2:]:
            normal[self.contact_points] = pressed
        return v

    def transfer(self, vectors: Matrix, zones: Zones) -> Matrix:
        """Convert vectors of the free unknowns (k, size) to those of other zones.

        zones  zones of another iterate
        """
        transferred = [zones.free(self.field(vector)) for vector in vectors]
        return np.array(transferred).reshape(len(vectors), zones.size)

    def restrict_to_fixed(self, v: Field) -> Vector:
        """Restrict a field (3, n) to the components that the linear system does not solve for.

        These are the components along the slip direction in slipping points and all components
        outside the contact. The result is a vector. Together with the free components it determines
        the field.

        v  displacements (u_x, u_y, u_z) or tractions
        """
        across = self.normal[0] * v[0][self.slip] + self.normal[1] * v[1][self.slip]
        return np.concatenate([across, *(one[self._open_points] for one in v)])

    def assemble_field(self, free: Vector, fixed: Vector) -> Field:
        """Assemble a field (3, n) from its free and its fixed components in the zones.

        The operation is the inverse of `free` and `restrict_to_fixed` together. Used for the
        displacement of a Newton step.

        free   free components: vector as from `free`
        fixed  components along the slip direction in slipping points, and all components outside
               the contact: vector as from `restrict_to_fixed`
        """
        v = self._add_slip_components(self.field(free), fixed[: len(self.slip)])
        for one, apart in zip(v, fixed[len(self.slip) :].reshape(3, -1), strict=True):
            one[self._open_points] = apart
        return v

    def _add_slip_components(self, v: Field, along: Vector) -> Field:
        """Add components along n in slipping points to the tractions (3, n), in place."""
        for one, normal in zip(v[:2], self.normal, strict=True):
            one[self.slip] += normal * along
        return v

    def tractions(self, free: Vector) -> Field:
        """Compute the change of the tractions (3, n) by changes of the free unknowns.

        The free unknowns do not contain the shear along the slip direction in slipping points. This
        shear is the friction limit b, which changes with the pressure.

        free  changes of the free unknowns (size,)
        """
        t = self.field(free)
        if self.friction_slope is None:
            return t
        pressure = t[2][self.slip]
        for one, slope in zip(t[:2], self.friction_slope, strict=True):
            one[self.slip] += slope * pressure
        return t

    def admissible_tractions(self, tractions: Field, bound: Field) -> Field:
        """Change tractions so that they match the zones of contact, stick and slip.

        Tractions become zero outside the contact. The shear of slipping points along the slip
        direction becomes the friction limit.

        tractions  (q_x, q_y, p), shape (3, n)
        bound      friction limit b (n,)
        """
        return self._add_slip_components(self.field(self.free(tractions)), bound[self.slip])

    def slip_terms(self, free: Vector) -> Vector:
        """Compute the contribution of the slip compliance to the rows of the linear system (size,).

        The rows of slipping points are d s, with the shear s across the slip direction and the slip
        compliance d [length^3/force]. Other rows are zero.

        free  free unknowns (size,)
        """
        rows = np.zeros_like(free)
        self.split_unknowns(rows)[1][:] = self.slip_compliance * self.split_unknowns(free)[1]
        return rows

    def changes(self, other: Zones | None) -> int:
        """Return the number of points that are in another zone than in another iterate.

        Zones are contact, stick and slip. Few changes indicate that Newton's method is near the
        solution.

        other  zones of the other iterate; None counts all points
        """
        if other is None:
            return self.contact.size
        same = (self.contact == other.contact) & (self.stick == other.stick)
        return int(same.size - np.count_nonzero(same))


def zones_at(
    contact: Mask, z: VectorField, bound: Vector, gamma: float, self_compliance: float
) -> Zones:
    """Determine the zones of an iterate at a given pressure.

    contact          points in contact (n,)
    z                q + γ slip (2, n), with the shear q
    bound            friction limit b (n,)
    gamma            stiffness γ [force/length^3]
    self_compliance  displacement of a point by its own unit shear [length^3/force]
    """
    length = magnitude(z)
    slips = contact & (length > bound)
    slip = np.flatnonzero(slips)
    length, limit = length[slip], bound[slip]
    excess = length - limit
    least = excess / (MAX_SLIP_COMPLIANCE * self_compliance)
    compliance = excess / np.maximum(gamma * limit, least)
    return Zones(contact, contact & ~slips, slip, z[:, slip] / length, compliance)
