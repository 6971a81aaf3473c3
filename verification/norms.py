"""Errors of a field against the exact one; every denominator is named where it is used.

Fields are compared at cell centres with exact point values. The mean of a smooth field over a cell
differs from its centre value by O(h^2) only; next to the square-root edge of a contact by O(√h),
which is part of the error that is measured.
"""

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]


def relative_l1(field: Field, exact: Field) -> float:
    """Σ|field - exact| / Σ|exact| over all cells of the window [1]."""
    return float(np.sum(np.abs(field - exact)) / np.sum(np.abs(exact)))


def relative_l2(field: Field, exact: Field) -> float:
    """√Σ(field - exact)² / √Σ exact² over all cells of the window [1]."""
    return float(np.sqrt(np.sum((field - exact) ** 2) / np.sum(exact**2)))


def shear_error(shear: Field, exact: Field, limit: Field) -> float:
    """Σ|q - q_exact| / Σµp, with |.| the length of the vector difference [1].

    shear  (2, nx, ny) as computed
    exact  (nx, ny) along x, or (2, nx, ny)
    limit  computed friction limit µp (nx, ny): the denominator is the largest force it carries
    """
    along_x, along_y = (exact, np.zeros_like(exact)) if exact.ndim == 2 else exact
    difference = np.hypot(shear[0] - along_x, shear[1] - along_y)
    return float(np.sum(difference) / np.sum(limit))
