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
    basis = monomials(stencil)[:, : 3 * degree]
    given, believed = (taken(field, i, j, stencil) for field in (data, weight))
    believed *= fading(stencil)
    normal = normal_matrices(basis, believed)
    right = basis.T @ (believed * given).T
    found = solved(normal, right).T
    left = given - found @ basis.T
    return found, *what_is_left(left, believed)


def taken(padded: Field, i: Indices, j: Indices, stencil: Stencil) -> Field:
    """What a field, padded by the reach, has in the windows about cells (n, window)."""
    dx, dy = _offsets(stencil)
    across = padded.shape[1]
    at = ((i + stencil.reach) * across + j + stencil.reach)[:, None] + (dx * across + dy)
    return np.asarray(padded.take(at))


def fading(stencil: Stencil) -> Field:
    """Weights of a window (window,)."""
    dx, dy = _offsets(stencil)
    return np.asarray(np.exp(-(dx**2 + dy**2) / (2 * stencil.width**2)))


def monomials(stencil: Stencil) -> Field:
    """Means over the cells of a window of 1, x, y, x²/2, xy, y²/2 (window, 6)."""
    dx, dy = _offsets(stencil)
    columns = (np.ones(len(dx)), dx, dy, dx**2 / 2 + 1 / 24, dx * dy, dy**2 / 2 + 1 / 24)
    return np.stack(columns, axis=-1)


def _offsets(stencil: Stencil) -> tuple[Indices, Indices]:
    shift = np.arange(-stencil.reach, stencil.reach + 1)
    dx, dy = (grid.ravel() for grid in np.meshgrid(shift, shift, indexing="ij"))
    return dx, dy


def normal_matrices(basis: Field, believed: Field) -> Field:
    """Of least squares (m, m, n)."""
    count = basis.shape[1]
    row, column = np.triu_indices(count)
    normal = np.empty((count, count, len(believed)))
    normal[row, column] = (basis[:, row] * basis[:, column]).T @ believed.T
    normal[column, row] = normal[row, column]
    return normal


def what_is_left(left: Field, believed: Field) -> tuple[Field, Indices]:
    """Weighted root mean square of what fits leave of their data (n, window), and their count."""
    total = np.maximum(np.sum(believed, axis=1), 1e-30)
    rms = np.sqrt(np.sum(believed * left**2, axis=1) / total)
    return rms, np.count_nonzero(believed, axis=1)


def solved(normal: Field, right: Field) -> Field:
    """The coefficients (m, n) of least squares (m, m, n) and (m, n). Overwrites both."""
    diagonal = np.arange(len(right))
    normal[diagonal, diagonal] += RIDGE * (np.trace(normal) + 1e-30)
    return _solved(normal, right)


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
