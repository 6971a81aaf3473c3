"""What tractions are in the parts of cells."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.fit import Indices
from semi_analytical.edge.kernels import PARTS, part_centres
from semi_analytical.edge.means import Exponent, mean_of_cut, mean_of_smooth
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.operator.domain import ReducedDomain

Field = NDArray[np.float64]

# So many times its slopes above zero, a part of a cell has the mean of a power by its series.
SMOOTH = 1.5
# Cells whose parts are found at a time: as many as stay in the cache.
CHUNK = 512
X, Y = (at.ravel() for at in np.meshgrid(part_centres(), part_centres(), indexing="ij"))
MONOMIALS = np.stack([X**0, X, Y, X**2 / 2, X * Y, Y**2 / 2])
# Mean of X²/2 over the parts of a cell.
HALF_SQUARE = np.mean(X**2) / 2


def means_of_power(phi: Quadratic, exponent: Exponent) -> Field:
    """Mean of phi_+^exponent over the parts of each cell (n, PARTS, PARTS)."""
    parts = np.empty((len(phi.f), PARTS**2))
    for first in range(0, len(parts), CHUNK):
        some = slice(first, first + CHUNK)
        a = exponent[some, None] if isinstance(exponent, np.ndarray) else exponent
        parts[some] = _means_of_power(phi.chosen(some), a)
    return parts.reshape(-1, PARTS, PARTS)


def _means_of_power(phi: Quadratic, a: Exponent) -> Field:
    """The same of some cells (n, PARTS²); the exponent a number or (n, 1)."""
    bent = (phi.f_xx + phi.f_yy) / (24 * PARTS**2)
    factors = np.stack([phi.f + bent, phi.f_x, phi.f_y, phi.f_xx, phi.f_xy, phi.f_yy], axis=1)
    f = factors @ MONOMIALS
    # Over a part of a cell the slope hardly changes.
    f_x, f_y = np.abs(phi.f_x[:, None]) / PARTS, np.abs(phi.f_y[:, None]) / PARTS
    slope = f_x + f_y
    smooth = f >= SMOOTH * slope
    if np.all(smooth):
        return mean_of_smooth(f, f_x, f_y, a)
    parts = mean_of_smooth(np.where(smooth, f, slope), f_x, f_y, a)
    parts *= smooth
    cell, part = np.nonzero(~smooth & (f > -slope / 2))
    of_cell = (f_x[cell, 0], f_y[cell, 0], a[cell, 0] if isinstance(a, np.ndarray) else a)
    parts[cell, part] = mean_of_cut(f[cell, part], *of_cell)
    return parts


def by_differences(
    means: Field, i: Indices, j: Indices, fade: Field, domain: ReducedDomain
) -> Field:
    """Parts (n, PARTS, PARTS) of a traction, given by means (nx, ny), in the cells (i, j).

    fade  weight of the second differences (n,)
    """
    i, j = i + 1, j + 1
    p = domain.framed(means, 1)
    centre = p[i, j]
    lower, upper, left, right = p[i - 1, j], p[i + 1, j], p[i, j - 1], p[i, j + 1]
    corners = p[i + 1, j + 1] + p[i - 1, j - 1] - p[i + 1, j - 1] - p[i - 1, j + 1]
    f_xx, f_yy = fade * (lower + upper - 2 * centre), fade * (left + right - 2 * centre)
    f = centre - HALF_SQUARE * (f_xx + f_yy)
    slopes = (upper - lower) / 2, (right - left) / 2
    factors = np.stack([f, *slopes, f_xx, fade * corners / 4, f_yy], axis=1)
    return (factors @ MONOMIALS).reshape(-1, PARTS, PARTS)
