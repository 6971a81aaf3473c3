"""Weighted quadratic fits to cell means on square windows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.part import WHOLE, Part

Field = NDArray[np.float64]
Indices = NDArray[np.intp]

# Decides only what the data leave open.
RIDGE = 1e-13
# Fits made at a time: as many as stay in the cache.
CHUNK = 256


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
    data: Field,
    weight: Field,
    i: Indices,
    j: Indices,
    stencil: Stencil,
    degree: int = 2,
    part: Part = WHOLE,
) -> Fits:
    """Least squares about the cells (i, j), shape (n,).

    data    (nx, ny) cell means
    weight  (nx, ny) beside that of the stencil; zero where there are none
    degree  1 or 2; of 1 nothing bends
    part    of the window that they are given on
    """
    data, weight = (part.framed(field, stencil.reach) for field in (data, weight))
    found, rms = np.zeros((6, len(i))), np.empty(len(i))
    number = np.empty(len(i), dtype=int)
    for first in range(0, len(i), CHUNK):
        some = slice(first, first + CHUNK)
        fit, rms[some], number[some] = _some_fits(data, weight, i[some], j[some], stencil, degree)
        found[: fit.shape[1], some] = fit.T
    return Fits(Quadratic(i.astype(float), j.astype(float), *found), rms, number)


def _some_fits(
    data: Field, weight: Field, i: Indices, j: Indices, stencil: Stencil, degree: int
) -> tuple[Field, Field, Indices]:
    """Coefficients (n, 3 degree), rms and count of fits to padded data."""
    shift = np.arange(-stencil.reach, stencil.reach + 1)
    dx, dy = (grid.ravel() for grid in np.meshgrid(shift, shift, indexing="ij"))
    across = data.shape[1]
    at = ((i + stencil.reach) * across + j + stencil.reach)[:, None] + (dx * across + dy)
    given, believed = data.take(at), weight.take(at)
    believed *= np.exp(-(dx**2 + dy**2) / (2 * stencil.width**2))
    columns = (np.ones(len(dx)), dx, dy, dx**2 / 2 + 1 / 24, dx * dy, dy**2 / 2 + 1 / 24)
    basis = np.stack(columns[: 3 * degree], axis=-1)
    count = basis.shape[1]
    row, column = np.triu_indices(count)
    normal = np.empty((count, count, len(i)))
    normal[row, column] = (basis[:, row] * basis[:, column]).T @ believed.T
    normal[column, row] = normal[row, column]
    diagonal = np.arange(count)
    normal[diagonal, diagonal] += RIDGE * (np.trace(normal) + 1e-30)
    right = basis.T @ (believed * given).T
    found = _solved(normal, right).T
    left = given - found @ basis.T
    total = np.maximum(np.sum(believed, axis=1), 1e-30)
    rms = np.sqrt(np.sum(believed * left**2, axis=1) / total)
    return found, rms, np.count_nonzero(believed, axis=1)


def _solved(matrices: Field, right: Field) -> Field:
    """The x (m, n) of positive definite systems (m, m, n) and (m, n), by Cholesky's method on all
    of them together: one by one they are too small. Overwrites both."""
    a, x = matrices, right
    for k in range(len(x)):
        a[k, k] = np.sqrt(a[k, k])
        a[k, k + 1 :] /= a[k, k]
        x[k] /= a[k, k]
        for i in range(k + 1, len(x)):
            a[i, i:] -= a[k, i] * a[k, i:]
            x[i] -= a[k, i] * x[k]
    for k in reversed(range(len(x))):
        x[k] = (x[k] - np.sum(a[k, k + 1 :] * x[k + 1 :], axis=0)) / a[k, k]
    return x
