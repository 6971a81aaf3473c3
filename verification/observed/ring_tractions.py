"""Tractions of an increment anywhere on the surface, for comparison with other solutions."""

import numpy as np
from numpy.typing import NDArray

from fem_reference.compliance.angular_grid import (
    AngularGrid,
    axisymmetric_grid,
    end_grid,
    mid_grid,
)
from fem_reference.fields import Increment

Field = NDArray[np.float64]


def tractions_at(
    increment: Increment, x: Field, y: Field, direction: tuple[float, float] = (1.0, 0.0)
) -> tuple[Field, Field]:
    """Shear (2, …) along x and y, and pressure (…), at points of any shape.

    direction  of the tangential load, as the plan has it
    Linear between rings and the trigonometric polynomial through the points on a ring, as the
    solution itself; zero beyond the last ring.
    """
    r, theta = np.hypot(x, y), np.arctan2(y, x)
    load = np.arctan2(direction[1], direction[0])
    grid = _grid_of(increment)
    rings = len(increment.radii)
    parts = (increment.shear_radial, increment.shear_circumferential, increment.pressure)
    values = np.zeros((3, rings, grid.points))
    for value, part in zip(values, parts, strict=True):
        if part is not None:
            value[:] = part.reshape(rings, -1)
    amplitudes = [_between_rings(f, increment.radii, r.ravel()) for f in grid.amplitudes(values)]
    cosines, sines = grid.modes((theta - load).ravel())
    q_r, q_theta, p = (
        np.sum(f * waves.T, axis=1).reshape(r.shape)
        for f, waves in zip(amplitudes, (cosines, sines, cosines), strict=True)
    )
    q = np.stack([q_r * np.cos(theta) - q_theta * np.sin(theta),
                  q_r * np.sin(theta) + q_theta * np.cos(theta)])  # fmt: skip
    if increment.shear_along_load is not None:
        f = np.interp(r, increment.radii, increment.shear_along_load, right=0.0)
        q = q + np.multiply.outer(np.array(direction), f)
    return q, p


def _grid_of(increment: Increment) -> AngularGrid:
    if increment.angles is None:
        return axisymmetric_grid()
    points = len(increment.angles)
    return end_grid(points - 1) if increment.angles[0] == 0 else mid_grid(points)


def _between_rings(amplitudes: Field, radii: Field, r: Field) -> Field:
    """Amplitudes (points, harmonics) at radii r."""
    return np.stack([np.interp(r, radii, f, right=0.0) for f in amplitudes.T], axis=1)
