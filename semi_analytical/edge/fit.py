"""Weighted quadratic fits to cell means on square windows."""

from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Field, Indices
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.operator.domain import WINDOW, ReducedDomain

# Decides only what the data leave open.
RIDGE = 1e-13
# Fits made at a time: as many as stay in the cache.
CHUNK = 256
# Of weights, where there are none.
LEAST_TOTAL = 1e-30

# Part of the largest curvature, below which a direction is that of a ridge.
CURVED = 0.1


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
    domain: ReducedDomain = WINDOW,
    leaning: tuple[Field, Field] | None = None,
) -> Fits:
    """Weighted least squares about the cells (i, j), shape (n,).

    data     (nx, ny) cell means
    weight   (nx, ny) of the data, a factor of that of the stencil
    degree   1 or 2
    domain   that all fields are given on
    leaning  factor (nx, ny) and vectors (dx, dy) of shape (2, n): the data are those of the fit
             plus the factor times the fit at these places from the cells
    """
    data, weight = (domain.framed(field, stencil.reach) for field in (data, weight))
    fade, basis = fading(stencil), monomials(stencil)[: 3 * degree]
    if leaning is not None:
        factor, (x, y) = domain.framed(leaning[0], stencil.reach), leaning[1]
        foot = np.stack([x**0, x, y, x**2 / 2, x * y, y**2 / 2])
    found = np.zeros((6, len(i)))
    rms, count = np.empty(len(i)), np.empty(len(i), dtype=int)
    for some in _chunks(len(i)):
        at = i[some], j[some], stencil
        given, believed = (taken(field, *at) for field in (data, weight))
        believed *= fade
        normal = normal_matrices(stencil, believed, degree)
        fit = basis @ (believed * given).T
        if leaning is not None:
            leans, to = taken(factor, *at), foot[:, some]
            mixed = basis @ (believed * leans).T
            normal += mixed[:, None] * to + to[:, None] * mixed
            normal += np.sum(believed * leans**2, axis=1) * to[:, None] * to
            fit += to * np.sum(believed * leans * given, axis=1)
        solve(factored(normal), fit)
        found[: len(basis), some] = fit
        given -= fit.T @ basis
        if leaning is not None:
            given -= leans * np.sum(fit * to, axis=0)[:, None]
        total = np.maximum(np.sum(believed, axis=1), LEAST_TOTAL)
        rms[some] = np.sqrt(np.sum(believed * given**2, axis=1) / total)
        count[some] = np.count_nonzero(believed, axis=1)
    return Fits(Quadratic(i.astype(float), j.astype(float), *found), rms, count)


def _chunks(count: int) -> list[slice]:
    return [slice(first, first + CHUNK) for first in range(0, count, CHUNK)]


def taken(padded: Field, i: Indices, j: Indices, stencil: Stencil) -> Field:
    """What a field, padded by the reach, has in the windows about cells (n, window)."""
    dx, dy = _offsets(stencil)
    across = padded.shape[1]
    at = ((i + stencil.reach) * across + j + stencil.reach)[:, None] + (dx * across + dy)
    return np.asarray(padded.take(at))


@cache
def fading(stencil: Stencil) -> Field:
    """Weights of a window (window,)."""
    dx, dy = _offsets(stencil)
    return _kept(np.exp(-(dx**2 + dy**2) / (2 * stencil.width**2)))


@cache
def monomials(stencil: Stencil) -> Field:
    """Means over the cells of a window of 1, x, y, x²/2, xy, y²/2 (6, window)."""
    dx, dy = _offsets(stencil)
    rows = (np.ones(len(dx)), dx, dy, dx**2 / 2 + 1 / 24, dx * dy, dy**2 / 2 + 1 / 24)
    return _kept(np.stack(rows))


@cache
def _products(stencil: Stencil, degree: int) -> tuple[Indices, Indices, Field]:
    """Of two monomials each: which two, and over the window (products, window)."""
    row, column = np.triu_indices(3 * degree)
    basis = monomials(stencil)
    return row, column, _kept(basis[row] * basis[column])


@cache
def _offsets(stencil: Stencil) -> tuple[Indices, Indices]:
    shift = np.arange(-stencil.reach, stencil.reach + 1)
    dx, dy = np.meshgrid(shift, shift, indexing="ij")
    return dx.ravel(), dy.ravel()


def _kept(values: Field) -> Field:
    values.flags.writeable = False
    return values


def normal_matrices(stencil: Stencil, believed: Field, degree: int = 2) -> Field:
    """Of least squares with these weights (m, m, n)."""
    row, column, products = _products(stencil, degree)
    normal = np.empty((3 * degree, 3 * degree, len(believed)))
    normal[row, column] = normal[column, row] = products @ believed.T
    return normal


def factored(normal: Field) -> Field:
    """Cholesky's factors (m, m, n) of normal matrices, in the upper triangles: of all of them
    together, as one by one they are too small. Overwrites them."""
    a, diagonal = normal, np.arange(len(normal))
    a[diagonal, diagonal] += RIDGE * (np.trace(a) + LEAST_TOTAL)
    for k in range(len(a)):
        a[k, k:] /= np.sqrt(a[k, k])
        for i in range(k + 1, len(a)):
            a[i, i:] -= a[k, i] * a[k, i:]
    return a


def solve(factors: Field, right: Field) -> None:
    """Right sides (m, n) to the coefficients of least squares, in their place."""
    a, x = factors, right
    for k in range(len(x)):
        x[k] /= a[k, k]
        x[k + 1 :] -= a[k, k + 1 :] * x[k]
    for k in reversed(range(len(x))):
        x[k] /= a[k, k]
        x[:k] -= a[:k, k] * x[k]


# The cell and those about it, and further those that tell the slopes of the last.
NEXT = Stencil(1, 1.0)
ACROSS = 2
# Means over them to the coefficients of a quadratic, by least squares (6, 9).
FIT = np.linalg.pinv(monomials(NEXT).T * np.sqrt(fading(NEXT))[:, None]) * np.sqrt(fading(NEXT))


class Peak(NamedTuple):
    """Largest pressure at a point [force/length^2], and whether it is a ridge there: not curved in
    both directions, so that cells leave an error of second order along it."""

    value: float
    ridge: bool


def peak_of(means: Field) -> Peak:
    """Find the largest pressure at a point from means over cells (nx, ny) with their edge inside.

    The maximum of the quadratic fitted to the means of the square over the cell with the largest
    mean and its neighbours: below a paraboloid the square is quadratic (Hertz). Means of squares
    exceed the squares of the means by a twelfth of the square of the slope. On a ridge, as below
    ring-shaped indenters, the maximum is taken across it. The largest mean where the neighbours are
    not all in contact, or the maximum is not between them.
    """
    i, j = (int(at) for at in np.unravel_index(np.argmax(means), means.shape))
    largest = Peak(float(means[i, j]), ridge=True)
    about = means[max(i - ACROSS, 0) : i + ACROSS + 1, max(j - ACROSS, 0) : j + ACROSS + 1]
    if about.shape != (2 * ACROSS + 1, 2 * ACROSS + 1) or np.any(about[1:-1, 1:-1] <= 0):
        return largest
    along_x, along_y = about[2:, 1:-1] - about[:-2, 1:-1], about[1:-1, 2:] - about[1:-1, :-2]
    squares = about[1:-1, 1:-1] ** 2 + (along_x**2 + along_y**2) / 48
    f, f_x, f_y, f_xx, f_xy, f_yy = (float(value) for value in FIT @ squares.ravel())
    curvature, axes = np.linalg.eigh([[f_xx, f_xy], [f_xy, f_yy]])
    curved = curvature < CURVED * min(curvature[0], 0.0)
    slope = [f_x, f_y] @ axes
    step = axes @ np.where(curved, -slope / np.where(curved, curvature, 1.0), 0.0)
    if not curved[0] or np.max(np.abs(step)) > NEXT.reach:
        return largest
    return Peak(float(np.sqrt(f + (f_x * step[0] + f_y * step[1]) / 2)), ridge=not curved[1])
