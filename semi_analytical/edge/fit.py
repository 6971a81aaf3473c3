"""Weighted quadratic fits to cell means on square windows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.quadratic import Quadratic

Field = NDArray[np.float64]
Indices = NDArray[np.intp]

# Decides only what the data leave open.
RIDGE = 1e-13


@dataclass(frozen=True)
class Stencil:
    """Window of (2 reach + 1)² cells with weights exp(-r²/(2 width²)), lengths in cells."""

    reach: int
    width: float


NARROW, WIDE, WIDER = Stencil(3, 1.7), Stencil(5, 2.5), Stencil(6, 3.0)


@dataclass(frozen=True)
class Fits:
    """Fits about cells, one per cell, all of one shape.

    quadratic  about the centres of the cells
    rms        weighted root mean square of what the fit leaves of the data
    count      data that it could use
    """

    quadratic: Quadratic
    rms: Field
    count: Indices


def fit_about(
    data: Field, weight: Field, i: Indices, j: Indices, stencil: Stencil, degree: int = 2
) -> Fits:
    """Least squares about the cells (i, j), shape (n,).

    data    (nx, ny) cell means
    weight  (nx, ny) beside that of the stencil; zero where there are none
    degree  1 or 2; of 1 nothing bends
    """
    reach = stencil.reach
    shift = np.arange(-reach, reach + 1)
    dx, dy = (grid.ravel() for grid in np.meshgrid(shift, shift, indexing="ij"))
    across = data.shape[1] + 2 * reach
    at = ((i + reach) * across + j + reach)[:, None] + (dx * across + dy)
    given, believed = (np.pad(field, reach).take(at) for field in (data, weight))
    believed *= np.exp(-(dx**2 + dy**2) / (2 * stencil.width**2))
    columns = (np.ones(len(dx)), dx, dy, dx**2 / 2 + 1 / 24, dx * dy, dy**2 / 2 + 1 / 24)
    basis = np.stack(columns[: 3 * degree], axis=-1)
    count = basis.shape[1]
    row, column = np.triu_indices(count)
    normal = np.empty((len(i), count, count))
    normal[:, row, column] = believed @ (basis[:, row] * basis[:, column])
    normal[:, column, row] = normal[:, row, column]
    normal += RIDGE * np.eye(count) * (np.trace(normal, axis1=1, axis2=2)[:, None, None] + 1e-30)
    right = (believed * given) @ basis
    found = np.linalg.solve(normal, right[..., None])[..., 0]
    left = given - found @ basis.T
    total = np.maximum(np.sum(believed, axis=1), 1e-30)
    return Fits(
        Quadratic(i.astype(float), j.astype(float), *found.T, *np.zeros((6 - count, len(i)))),
        np.sqrt(np.sum(believed * left**2, axis=1) / total),
        np.count_nonzero(believed, axis=1),
    )
