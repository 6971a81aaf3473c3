"""Prescribed loads of an increment of a contact at points on rings, and the state at its end."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from contact_scene.array_types import Array
from radial.tangential.ring_points import ContactPoints

# Indices of rigid motions and of their conjugate loads: tangential force along and across θ = 0,
# torque about the axis, normal force.
ALONG, ACROSS, TORSION, NORMAL = range(4)
Prescribed = tuple[float | None, ...]


@dataclass(frozen=True)
class Loads:
    """Prescribed loads and rigid motions of the indenter at the end of an increment.

    Either a load or its conjugate motion is prescribed. The other one is None. θ = 0 is the
    direction of the first tangential load.

    forces   tangential force along θ = 0 and across it, torque, normal force (4,) [force, force
             length]
    motions  shifts along θ = 0 and across it, twist, approach (4,) [length, radian]
    """

    forces: Prescribed
    motions: Prescribed


@dataclass(frozen=True)
class PointState:
    """Contact with friction at N points on rings, solved at the end of an increment.

    tractions       radial shear, circumferential shear and pressure: q_r, q_θ, p (3 N,)
                    [force/length²]
    moved           tangential displacements u_r, u_θ times the area of each point (2 N,) [length³]
    slip_increment  slip Δs of the increment times the area of each point (2 N,) [length³]
    motion          rigid motion: shifts along θ = 0 and across it, twist, approach (4,)
                    [length, radian]
    changed         change of tractions and rigid motion in the increment (3 N + 4,)
    share           trial shear |q - Δs/d| over the friction limit, with the compliance d of the
                    point (N,) [1]; at most 1 at sticking points, infinite outside the contact
    energy          elastic energy ½ ∫ (p u_z + q·u) dA of the bodies and the rig's springs
                    [force length]
    gap             gap of the points; negative where the bodies overlap (N,) [length]
    steps           number of Newton steps of the solve
    slides          true at the friction limit under force control: shifts and slip are undefined
    """

    tractions: Array
    moved: Array
    slip_increment: Array
    motion: Array
    changed: Array
    share: Array
    energy: float
    gap: Array
    steps: int
    slides: bool = False

    @property
    def pressure(self) -> Array:
        """Pressure p at all N points on the rings (N,) [force/length²]."""
        return self.tractions[2 * len(self.share) :]

    @property
    def shear(self) -> Array:
        """Shear q at all N points on the rings (2, N) [force/length²].

        The components are the radial shear q_r and the circumferential shear q_θ on the lower body.
        """
        return self.tractions[: 2 * len(self.share)].reshape(2, -1)

    @property
    def approach(self) -> float:
        """Approach of the indenter to the lower body since first contact [length]."""
        return float(self.motion[NORMAL])

    def repeat_angles(self, points: ContactPoints) -> PointState:
        """Extend an axisymmetric state from one angle per ring to all angles of given points.

        Used when a tangential load begins to act on an axisymmetric contact.

        points  points of the contact with tangential load (rings × angles)
        """

        def repeat_components(field: Array, count: int) -> Array:
            """Repeat the components of an axisymmetric field of rings at all angles of each ring.

            The shape is (count × N,) for N points.

            field  components at the rings (count × rings,)
            count  number of components: 1 for a scalar, 2 for a shear, 3 for tractions
            """
            return points.repeat_angles(field.reshape(count, -1)).ravel()

        return replace(
            self,
            tractions=repeat_components(self.tractions, 3),
            changed=np.append(repeat_components(self.changed[:-4], 3), self.changed[-4:]),
            moved=repeat_components(self.moved, 2) / points.count,
            slip_increment=repeat_components(self.slip_increment, 2) / points.count,
            share=repeat_components(self.share, 1),
            gap=repeat_components(self.gap, 1),
        )


def resultant_loads(points: ContactPoints, tractions: Array) -> Array:
    """Compute the resultant forces and torque of the tractions on a contact (4,).

    The results are the tangential force along θ = 0 and across it [force], the torque
    [force length] and the normal force [force].

    points     points of the contact, with their areas
    tractions  radial shear, circumferential shear and pressure of N points (3 N,) [force/length²]
    """
    q, p = np.split(tractions, [2 * len(points.areas)])
    return np.append(points.rigid_motions @ q, points.areas @ p)
