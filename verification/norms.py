"""Error norms of a field against the exact one, and exact means over cells.

Fields are compared at cell centres with exact point values. The mean of a smooth field over a cell
differs from its centre value by O(h²) only. Next to the square-root edge of a contact it differs by
O(√h), which is part of the measured error.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike

from contact_scene.array_types import Field


def max_norm(values: ArrayLike) -> float:
    """Return the maximum norm of an array, its largest magnitude."""
    return float(np.max(np.abs(values)))


def relative_l1(field: Field, exact: Field) -> float:
    """Compute the relative L1 error Σ|field - exact| / Σ|exact| of a field over all cells [1]."""
    return float(np.sum(np.abs(field - exact)) / np.sum(np.abs(exact)))


def relative_l2(field: Field, exact: Field) -> float:
    """Compute the relative L2 error √Σ(field - exact)² / √Σ exact² of a field over all
    cells [1].
    """
    return float(np.sqrt(np.sum((field - exact) ** 2) / np.sum(exact**2)))


def shear_error(shear: Field, exact: Field, limit: Field) -> float:
    """Compute the error of the shear tractions over the friction limit, Σ|q - q_exact| / Σµp [1].

    The sums extend over all cells, and |.| is the length of a vector.

    shear  computed shear (2, nx, ny) [stress]
    exact  exact shear along x (nx, ny), or as vectors (2, nx, ny) [stress]
    limit  computed friction limit µp (nx, ny) [stress], whose sum is the largest friction force
    """
    along_x, along_y = (exact, np.zeros_like(exact)) if exact.ndim == 2 else exact
    difference = np.hypot(shear[0] - along_x, shear[1] - along_y)
    return float(np.sum(difference) / np.sum(limit))


AtPlaces = Callable[[Field, Field], Field]
Rule = tuple[Field, Field]  # places from -1 to 1, and weights that sum to 2

SMOOTH = leggauss(4)
ROUGH = leggauss(64)
# Lobatto rule with a point in every corner of a cell; the contact edge may cut off a corner between
# Gauss points.
WITH_CORNERS = np.array([-1, -np.sqrt(0.2), np.sqrt(0.2), 1]), np.array([1, 5, 5, 1]) / 6
DIFFERING = 1e-7  # relative to the largest mean; a larger difference of two rules shows an edge


def cell_means(exact: AtPlaces, x: Field, y: Field, sides: tuple[Field, Field]) -> Field:
    """Compute the means over cells of a function of x and y, such as an exact pressure.

    Computed tractions with edge correction are means, and are compared with these. The error is
    below 2e-4 of the largest value in a cell with a square-root edge along its diagonal, 5e-5 along
    other lines, and 1e-7 in other cells.

    exact  function of x and y
    x, y   centres of the cells [length]
    sides  sides of the cells along x and y, each with the shape of x [length]
    """
    means = _means(exact, x, y, sides, SMOOTH)
    with np.errstate(invalid="ignore"):
        off = np.abs(means - _means(exact, x, y, sides, WITH_CORNERS))
    rough = ~(off <= DIFFERING * np.max(np.abs(means), initial=0.0))  # or infinite in a corner
    own = sides[0][rough], sides[1][rough]
    means[rough] = _means(exact, x[rough], y[rough], own, ROUGH)
    return means


def _means(exact: AtPlaces, x: Field, y: Field, sides: tuple[Field, Field], rule: Rule) -> Field:
    total = np.zeros_like(x)
    for along_x, weight_x in zip(*rule, strict=True):
        for along_y, weight_y in zip(*rule, strict=True):
            at = x + along_x / 2 * sides[0], y + along_y / 2 * sides[1]
            total += weight_x * weight_y / 4 * exact(*at)
    return total
