"""Shear as a function of the pressure, and exponent of both tractions at a slipping edge.

The shear is q = µp n - d with the pressure p, the coefficient of friction µ, the direction of slip
n and the deficit d from gross slip. The edge correction changes p only. The deficit d is that of
the uncorrected state times a factor, so that the tangential force along Σd remains unchanged. If
coupled bodies slip at the edge, pressure and shear fall to zero like s^α. Here s is the distance
from the edge, m its outward normal, β Dundurs' parameter of the outermost materials, and

    α = ½ + arctan(µβ q·m/|q|)/π

Near the edge the contact is plane, and u_z' = -(2/E*)(H p + β q) with the Hilbert transform H
(Comninou 1976).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene import CoulombFriction
from contact_scene.array_types import Field, Mask, VectorField
from contact_solver.admissible_shear import magnitude
from semi_analytical.edge.contact_area import near

# Layers of cells next to slipping cells to which their direction of slip is extended.
LAYERS = 12
# Magnitude of the sum of neighbouring directions below which they cancel.
LEAST_COMMON = 1e-3
# |Σd| over Σ|d| below which Σd has no direction (normal loading).
LEAST_RESULTANT = 1e-3
# Standard deviation in cells of the filter of the distance from the edge, for its normal.
SMOOTHED = 2.0


def direction_of_slip(q: VectorField, slips: Mask) -> VectorField:
    """Compute the direction of the shear of slipping cells, and extend this direction to all cells.

    The result (2, nx, ny) contains unit vectors. Other cells take the mean direction of adjacent
    cells, layer by layer. Beyond LAYERS layers they take the mean direction of all cells before, or
    zero if these directions cancel (torsion).

    q      shear of the cells (2, nx, ny)
    slips  slipping cells (nx, ny)
    """
    size = magnitude(q)
    new = np.pad(slips & (size > 0), 1)  # all neighbours of cells are in the frame
    known, n = new.copy(), np.zeros((2, *new.shape))
    n[:, known] = q[:, known[1:-1, 1:-1]] / size[known[1:-1, 1:-1]]
    flat, across = n.reshape(2, -1), new.shape[1]
    neighbours = np.add.outer([-across, 0, across], [-1, 0, 1]).reshape(-1, 1)
    for _ in range(LAYERS):
        i, j = np.nonzero(near(new) & ~known[1:-1, 1:-1])
        cells = (i + 1) * across + j + 1
        about = np.sum(flat.take(cells + neighbours, axis=1), axis=1)
        size = magnitude(about)
        agree = size > LEAST_COMMON
        cells = cells[agree]
        flat[:, cells] = about[:, agree] / size[agree]
        new[:] = False
        new.flat[cells] = True
        known |= new
    total = np.sum(n[:, known], axis=1)
    if np.hypot(*total) > LEAST_COMMON * np.count_nonzero(known):
        n[:, ~known] = (total / np.hypot(*total))[:, None]
    return n[:, 1:-1, 1:-1]


@dataclass(frozen=True)
class FollowingShear:
    """Shear of a solved state as a function of the pressure, for the edge correction.

    All fields are on the full window.

    friction  friction law
    slip      direction of slip n (2, nx, ny)
    deficit   shear of gross slip minus actual shear, zero in the slip zone (2, nx, ny)
              [force/length^2]
    total     sum of the shear over the cells (2,) [force/length^2]
    """

    friction: CoulombFriction
    slip: VectorField
    deficit: VectorField
    total: Field

    @classmethod
    def from_state(
        cls, friction: CoulombFriction, pressure: Field, shear: VectorField, stick: Mask
    ) -> FollowingShear:
        """Decompose the shear of a solved state into gross-slip shear and shear deficit.

        The shear of gross slip is the friction limit in the direction of slip. Without slipping
        cells the direction of slip is that of the shear.

        friction  friction law
        pressure  pressure of the state (nx, ny) [force/length^2]
        shear     shear of the state (2, nx, ny) [force/length^2]
        stick     sticking cells (nx, ny)
        """
        slips = (pressure > 0) & ~stick
        slip = direction_of_slip(shear, slips if np.any(slips) else magnitude(shear) > 0)
        deficit = np.where(stick, friction.limit(pressure) * slip - shear, 0.0)
        return cls(friction, slip, deficit, np.sum(shear, axis=(1, 2)))

    def __call__(self, pressure: Field) -> VectorField:
        """Compute the shear (2, nx, ny) at a given pressure, with a constant tangential force.

        The shear deficit is scaled so that the force along the sum of the deficit is unchanged. The
        magnitude of the shear is at most the friction limit.

        pressure  pressure of the cells (nx, ny) [force/length^2]
        """
        limit = self.friction.limit(pressure)
        full, resultant = limit * self.slip, np.sum(self.deficit, axis=(1, 2))
        scale, squared = 1.0, float(resultant @ resultant)
        if squared > (LEAST_RESULTANT * np.sum(magnitude(self.deficit))) ** 2:
            scale = float((np.sum(full, axis=(1, 2)) - self.total) @ resultant) / squared
        q = full - scale * self.deficit
        size = magnitude(q)
        return np.asarray(q * np.where(size > limit, limit / np.where(size > 0, size, 1.0), 1.0))

    def exponent(self, contact: Mask, beta: float) -> Field:
        """Compute the exponent α of the tractions at the edge nearest to each cell (nx, ny).

        Both tractions fall like s^α at the distance s from an edge at which coupled bodies slip.

        contact  cells in contact (nx, ny)
        beta     Dundurs' parameter β of the outermost materials
        """
        from scipy.ndimage import (  # the import takes as long as a contact
            distance_transform_edt,
            gaussian_filter,
        )

        depth = distance_transform_edt(contact) - distance_transform_edt(~contact)
        outward = -np.stack(np.gradient(gaussian_filter(depth, SMOOTHED)))
        size = magnitude(outward)
        along = np.sum(self.slip * outward, axis=0) / np.where(size > 0, size, 1.0)
        return np.asarray(0.5 + np.arctan(beta * self.friction.slope(0.0) * along) / np.pi)
