"""Shear that follows a corrected pressure, and the exponent of both at the edge of slip.

With n the direction of slip and d the shear missing from full slip, q = µp n - d, the correction
changes the pressure alone: d stays that of the cells, scaled so that the tangential force along it
is kept. Where bodies couple and friction slips at the edge, pressure and shear fall to zero like
s^α, s the distance from the edge and

    α = ½ + arctan(µβ q·n/|q|)/π

with n the outward normal and Dundurs' β of the outermost materials: in a wedge of slip at the edge
u_z' = -(2/E*)(H p + β q) on both sides of it, H the Hilbert transform (Comninou 1976 for the plane
problem; near its edge every smooth contact is plane).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import distance_transform_edt, gaussian_filter

from contact_scene import CoulombFriction
from contact_scene.array_types import Field, Mask, VectorField
from semi_analytical.tangential.admissible_shear import magnitude

# Layers of cells next to slipping cells to which their direction of slip is extended.
LAYERS = 12
# Of the sum of the directions of neighbours, below which they point against each other.
LEAST_COMMON = 1e-3
# Of Σ|d|, below which Σd has no direction: normal loading.
LEAST_RESULTANT = 1e-3
# Cells over which the distance from the edge is smoothed to have its normal.
SMOOTHED = 2.0


def direction_of_slip(q: VectorField, slips: Mask) -> VectorField:
    """Direction of the shear of slipping cells, extended to the others (2, nx, ny).

    The others take that of adjacent cells, layer by layer; beyond, that of the nearest cell.
    """
    nx, ny = slips.shape
    framed = np.zeros((nx + 2, ny + 2), bool)  # no neighbour of a cell lies beyond the frame
    window = framed.copy()
    window[1:-1, 1:-1] = True
    size = magnitude(q)
    framed[1:-1, 1:-1] = slips & (size > 0)
    n, known, window = np.zeros((2, framed.size)), framed.ravel(), window.ravel()
    new = np.flatnonzero(known)
    n[:, new] = q[:, framed[1:-1, 1:-1]] / size[framed[1:-1, 1:-1]]
    steps = np.array([i * (ny + 2) + j for i in (-1, 0, 1) for j in (-1, 0, 1)])
    for _ in range(LAYERS):
        touched = np.zeros_like(known)
        touched[new[:, None] + steps] = True
        next_layer = np.flatnonzero(touched & window & ~known)
        about = np.sum(n[:, next_layer[:, None] + steps], axis=-1)
        size = magnitude(about)
        agree = size > LEAST_COMMON
        new = next_layer[agree]
        n[:, new] = about[:, agree] / size[agree]
        known[new] = True
    nearest = distance_transform_edt(
        ~framed[1:-1, 1:-1], return_distances=False, return_indices=True
    )
    return np.asarray(n.reshape(2, nx + 2, ny + 2)[:, nearest[0] + 1, nearest[1] + 1])


@dataclass(frozen=True)
class FollowingShear:
    """Shear of a solved state at other pressures; fields on the whole window.

    friction  law of friction
    slip      n (2, nx, ny)
    missing   d (2, nx, ny), zero where cells slip [force/length^2]
    total     sum of the shear over the cells (2,)
    """

    friction: CoulombFriction
    slip: VectorField
    missing: VectorField
    total: Field

    @classmethod
    def of(
        cls, friction: CoulombFriction, pressure: Field, shear: VectorField, stick: Mask
    ) -> FollowingShear:
        """Of a state on cells; the direction of slip is that of the shear if no cell slips."""
        slips = (pressure > 0) & ~stick
        slip = direction_of_slip(shear, slips if np.any(slips) else magnitude(shear) > 0)
        missing = np.where(stick, friction.limit(pressure) * slip - shear, 0.0)
        return cls(friction, slip, missing, np.sum(shear, axis=(1, 2)))

    def __call__(self, pressure: Field) -> VectorField:
        """q (2, nx, ny) at a pressure, within the limit of friction."""
        limit = self.friction.limit(pressure)
        full, resultant = limit * self.slip, np.sum(self.missing, axis=(1, 2))
        scale, squared = 1.0, float(resultant @ resultant)
        if squared > (LEAST_RESULTANT * np.sum(magnitude(self.missing))) ** 2:
            scale = float((np.sum(full, axis=(1, 2)) - self.total) @ resultant) / squared
        q = full - scale * self.missing
        size = magnitude(q)
        return np.asarray(q * np.where(size > limit, limit / np.where(size > 0, size, 1.0), 1.0))

    def exponent(self, contact: Mask, beta: float) -> Field:
        """α along the nearest edge of a contact (nx, ny).

        beta  Dundurs' parameter of the outermost materials
        """
        depth = distance_transform_edt(contact) - distance_transform_edt(~contact)
        outward = -np.stack(np.gradient(gaussian_filter(depth, SMOOTHED)))
        size = magnitude(outward)
        along = np.sum(self.slip * outward, axis=0) / np.where(size > 0, size, 1.0)
        return np.asarray(0.5 + np.arctan(beta * self.friction.slope(0.0) * along) / np.pi)
