"""The largest pressure at a point, from means over cells."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.fit import Stencil, fading, monomials

Field = NDArray[np.float64]

# The cell and those about it, and further those that tell the slopes of the last.
NEXT = Stencil(1, 1.0)
ACROSS = 2
# Means over them to the coefficients of a quadratic, by least squares (6, 9).
FIT = np.linalg.pinv(monomials(NEXT).T * np.sqrt(fading(NEXT))[:, None]) * np.sqrt(fading(NEXT))


def peak_of(means: Field) -> float:
    """The largest pressure at a point, from means over cells (nx, ny) with their edge inside.

    That of the quadratic fitted to the means of the square over its cell and those about it (below
    a paraboloid the square is quadratic: Hertz), which exceed the squares of the means by a twelfth
    of the square of the slope; the largest mean where these are not all in contact, or have no peak
    between them.
    """
    i, j = (int(at) for at in np.unravel_index(np.argmax(means), means.shape))
    largest = float(means[i, j])
    about = means[max(i - ACROSS, 0) : i + ACROSS + 1, max(j - ACROSS, 0) : j + ACROSS + 1]
    if about.shape != (2 * ACROSS + 1, 2 * ACROSS + 1) or np.any(about[1:-1, 1:-1] <= 0):
        return largest
    along_x, along_y = about[2:, 1:-1] - about[:-2, 1:-1], about[1:-1, 2:] - about[1:-1, :-2]
    squares = about[1:-1, 1:-1] ** 2 + (along_x**2 + along_y**2) / 48
    f, f_x, f_y, f_xx, f_xy, f_yy = (float(value) for value in FIT @ squares.ravel())
    determinant = f_xx * f_yy - f_xy**2
    if f_xx >= 0 or determinant <= 0:
        return largest
    dx = (f_xy * f_y - f_yy * f_x) / determinant
    dy = (f_xy * f_x - f_xx * f_y) / determinant
    if max(abs(dx), abs(dy)) > NEXT.reach:
        return largest
    return float(np.sqrt(f + (f_x * dx + f_y * dy) / 2))
