"""Means over cells of a field that is known at every point: what the tractions of cells stand for.

Next to a square-root edge the mean of a cell differs from the value at its centre by O(√h).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation

Field = NDArray[np.float64]

FEW, MORE, MANY = 3, 4, 64  # Gauss points along the side of a cell
ROUGH = 1e-7  # of the largest mean: where two rules differ by more an edge ends in the cell


def cell_means(
    exact: Callable[[Field], Field], x: Field, y: Field, sides: tuple[float, float]
) -> Field:
    """Of a function of the distance from the axis; to 1e-5 of its largest value in cells that a
    square root ends in, and to 1e-7 elsewhere.

    x, y   centres of the cells, each of shape (nx, ny) [length]
    sides  of every cell [length]
    """
    means = _means(exact, x, y, sides, MORE)
    rough = np.abs(means - _means(exact, x, y, sides, FEW)) > ROUGH * np.max(np.abs(means))
    # An edge may cut off a corner between the points of both rules.
    rough = binary_dilation(rough, np.ones((3, 3)))
    means[rough] = _means(exact, x[rough], y[rough], sides, MANY)
    return means


def _means(
    exact: Callable[[Field], Field], x: Field, y: Field, sides: tuple[float, float], points: int
) -> Field:
    places, weights = (half / 2 for half in np.polynomial.legendre.leggauss(points))
    total = np.zeros(x.shape)
    for dx, weight_x in zip(sides[0] * places, weights, strict=True):
        for dy, weight_y in zip(sides[1] * places, weights, strict=True):
            total += weight_x * weight_y * exact(np.hypot(x + dx, y + dy))
    return total
