"""The largest pressure at a point, from means over cells."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.fit import Stencil, fading, monomials

Field = NDArray[np.float64]

# The cell and those about it, and further those that tell the slopes of the last.
NEXT = Stencil(1, 1.0)
ACROSS = 2
# Means over them to the coefficients of a quadratic, by least squares (6, 9).
FIT = np.linalg.pinv(monomials(NEXT).T * np.sqrt(fading(NEXT))[:, None]) * np.sqrt(fading(NEXT))

# Part of the largest curvature, below which a direction is that of a ridge.
CURVED = 0.1


class Peak(NamedTuple):
    """Largest pressure at a point [force/length^2], and whether it is a ridge there: not curved in
    both directions, so that cells leave an error of second order along it."""

    value: float
    ridge: bool


def peak_of(means: Field) -> Peak:
    """Find the largest pressure at a point from means over cells (nx, ny) with their edge inside.

    The maximum of the quadratic fitted to the means of the square over the cell with the largest
    mean and its neighbours: below a paraboloid the square is quadratic (Hertz). Means of squares
    exceed the squares of the means by a twelfth of the square of the slope. On a ridge, as below
    ring-shaped indenters, the maximum is taken across it. The largest mean where the neighbours are
    not all in contact, or the maximum is not between them.
    """
    i, j = (int(at) for at in np.unravel_index(np.argmax(means), means.shape))
    largest = Peak(float(means[i, j]), ridge=True)
    about = means[max(i - ACROSS, 0) : i + ACROSS + 1, max(j - ACROSS, 0) : j + ACROSS + 1]
    if about.shape != (2 * ACROSS + 1, 2 * ACROSS + 1) or np.any(about[1:-1, 1:-1] <= 0):
        return largest
    along_x, along_y = about[2:, 1:-1] - about[:-2, 1:-1], about[1:-1, 2:] - about[1:-1, :-2]
    squares = about[1:-1, 1:-1] ** 2 + (along_x**2 + along_y**2) / 48
    f, f_x, f_y, f_xx, f_xy, f_yy = (float(value) for value in FIT @ squares.ravel())
    curvature, axes = np.linalg.eigh([[f_xx, f_xy], [f_xy, f_yy]])
    curved = curvature < CURVED * min(curvature[0], 0.0)
    slope = [f_x, f_y] @ axes
    step = axes @ np.where(curved, -slope / np.where(curved, curvature, 1.0), 0.0)
    if not curved[0] or np.max(np.abs(step)) > NEXT.reach:
        return largest
    return Peak(float(np.sqrt(f + (f_x * step[0] + f_y * step[1]) / 2)), ridge=not curved[1])
