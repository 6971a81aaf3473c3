"""The largest pressure at a point, from means over cells."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.fit import Stencil, fit_about

Field = NDArray[np.float64]

NEXT = Stencil(1, 1.0)


def peak_of(means: Field) -> float:
    """The largest pressure at a point, from means over cells (nx, ny) with their edge inside.

    That of the quadratic fitted to the means of the square over its cell and those about it (below
    a paraboloid the square is quadratic: Hertz), which exceed the squares of the means by a twelfth
    of the square of the slope; the largest mean where these are not all in contact, or have no peak
    between them.
    """
    i, j = (int(at) for at in np.unravel_index(np.argmax(means), means.shape))
    # Beyond the neighbours those that tell their slopes.
    across = NEXT.reach + 1
    about = np.pad(means, across)[i : i + 2 * across + 1, j : j + 2 * across + 1]
    squares = about**2 + sum(np.gradient(about, axis=axis) ** 2 for axis in (0, 1)) / 12
    middle = np.array([across])
    fit = fit_about(squares, (about > 0).astype(float), middle, middle, NEXT)
    q = fit.quadratic
    determinant = q.f_xx * q.f_yy - q.f_xy**2
    if fit.count[0] < (2 * NEXT.reach + 1) ** 2 or q.f_xx[0] >= 0 or determinant[0] <= 0:
        return float(means[i, j])
    dx = (q.f_xy * q.f_y - q.f_yy * q.f_x) / determinant
    dy = (q.f_xy * q.f_x - q.f_xx * q.f_y) / determinant
    beyond = max(abs(dx[0]), abs(dy[0])) > NEXT.reach
    return float(means[i, j] if beyond else np.sqrt(q.at(dx, dy)[0]))
