"""Means over cells of a field that is known at every point: what the tractions of cells stand for.

Next to a square-root edge the mean of a cell differs from the value at its centre by O(√h).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

Field = NDArray[np.float64]
AtPlaces = Callable[[Field, Field], Field]
Rule = tuple[Field, Field]  # places from -1 to 1, and weights that sum to 2

SMOOTH, ROUGH = leggauss(4), leggauss(64)
# Lobatto's with a point in every corner, which an edge may cut off between those of Gauss.
WITH_CORNERS = np.array([-1, -np.sqrt(0.2), np.sqrt(0.2), 1]), np.array([1, 5, 5, 1]) / 6
DIFFERING = 1e-7  # of the largest mean: where two rules differ by more an edge ends in the cell


def cell_means(exact: AtPlaces, x: Field, y: Field, sides: tuple[Field, Field]) -> Field:
    """Of a function of the place; to 2e-4 of its largest value in a cell that a square root ends
    in, along the diagonal, to 5e-5 along other lines, and to 1e-7 in other cells.

    x, y   centres of the cells [length]
    sides  of the cells along x and y, each of the shape of x [length]
    """
    means = _means(exact, x, y, sides, SMOOTH)
    with np.errstate(invalid="ignore"):
        off = np.abs(means - _means(exact, x, y, sides, WITH_CORNERS))
    rough = ~(off <= DIFFERING * np.max(np.abs(means), initial=0.0))  # or infinite in a corner
    own = sides[0][rough], sides[1][rough]
    means[rough] = _means(exact, x[rough], y[rough], own, ROUGH)
    return means


def round_means(
    exact: Callable[[Field], Field], x: Field, y: Field, sides: tuple[float, float]
) -> Field:
    """The same of a function of the distance from the axis, over cells that are all alike."""
    alike = np.full_like(x, sides[0]), np.full_like(x, sides[1])
    return cell_means(lambda x, y: exact(np.hypot(x, y)), x, y, alike)


def _means(exact: AtPlaces, x: Field, y: Field, sides: tuple[Field, Field], rule: Rule) -> Field:
    total = np.zeros_like(x)
    for along_x, weight_x in zip(*rule, strict=True):
        for along_y, weight_y in zip(*rule, strict=True):
            at = x + along_x / 2 * sides[0], y + along_y / 2 * sides[1]
            total += weight_x * weight_y / 4 * exact(*at)
    return total
