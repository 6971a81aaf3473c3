"""What two elastic bodies answer to tractions at Gauss points, and what drives the indenter.

The first index of an array is the component: pressure first, then one or two of shear. The overlap
v of a point is how far the rigid motion of the indenter would carry it past the body's particle:
v_z = ω_z − h − u_z, and along the surface v = ω − u, whose growth is opposite to slip.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]
Vector = NDArray[np.float64]


@dataclass(frozen=True)
class ElasticSurface:
    """What the bodies answer to tractions at n Gauss points, in c components.

    weights     w_g r_g (n,) [length^2]
    compliance  displacement at the points per unit force (c, n, c, n) [length/force], symmetric;
                the force of a traction t is weights · t
    motion      displacement of the indenter's points per unit of the component's rigid
                coordinate (c, n): 1 along z and x, r about the axis, 0 in the radial direction
    gap         initial overlap with its sign turned (c, n) [length]: h_i, and 0 for shear
    """

    weights: Field
    compliance: Field
    motion: Field
    gap: Field

    def displacement(self, traction: Field) -> Field:
        """u (c, n) [length]."""
        c, n = traction.shape
        force = (traction * self.weights).ravel()
        return (self.compliance.reshape(c * n, c * n) @ force).reshape(c, n)

    def overlap(self, traction: Field, coordinates: Vector) -> Field:
        """v (c, n) [length] at rigid coordinates (c,)."""
        moved = self.motion * coordinates[:, None]
        return moved - self.displacement(traction) - self.gap

    @property
    def lever(self) -> Vector:
        """Largest displacement per unit of each rigid coordinate (c,); 1 where there is none."""
        largest = np.max(np.abs(self.motion), axis=1)
        return np.where(largest > 0, largest, 1.0)

    def resultant(self, traction: Field) -> Vector:
        """What loads the rigid coordinates, over 2π (c,): W, T_x or M_z."""
        return np.sum(self.weights * self.motion * traction, axis=1)

    def part(self, components: slice, traction: Field) -> Self:
        """These components alone; the others' tractions have become part of the gap."""
        held = traction.copy()
        held[components] = 0.0
        return replace(
            self,
            compliance=self.compliance[components][:, :, components],
            motion=self.motion[components],
            gap=(self.gap + self.displacement(held))[components],
        )


@dataclass(frozen=True)
class Target:
    """What is prescribed for each rigid coordinate (c,).

    free   whether the load is prescribed and the coordinate is an unknown
    value  the load over 2π where it is free; else the coordinate, 0 where there is none
    """

    free: Mask
    value: Vector

    def part(self, components: slice) -> Self:
        """These components alone."""
        return replace(self, free=self.free[components], value=self.value[components])
