"""Fields of an axisymmetric contact at given distances from its axis."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from semi_analytical.grid import SurfaceGrid

Field = NDArray[np.float64]

DIRECTIONS = 16


def outward(shear: Field, grid: SurfaceGrid) -> Field:
    """Component away from the axis (nx, ny) of a shear (2, nx, ny)."""
    x, y = grid.coordinates()
    r = np.hypot(x, y)
    return np.asarray((shear[0] * x + shear[1] * y) / np.where(r > 0, r, 1.0))


def along_radii(field: Field, grid: SurfaceGrid, r: Field) -> Field:
    """Values (distances, directions) at distances r from the axis, in 16 directions.

    field  (nx, ny), not negative, falling like a square root towards the edge of the contact

    The square of such a field is nearly linear at the edge, so that is interpolated.
    """
    angle = (np.arange(DIRECTIONS) + 0.5) * 2 * np.pi / DIRECTIONS
    x, y = r[:, None] * np.cos(angle), r[:, None] * np.sin(angle)
    at = [(x - grid.x[0]) / grid.spacing[0], (y - grid.y[0]) / grid.spacing[1]]
    return np.asarray(np.sqrt(map_coordinates(np.maximum(field, 0.0) ** 2, at, order=1)))
