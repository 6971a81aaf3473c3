"""Weighted least-squares fits of quadratics to cell means on square windows of cells.

The edge correction fits φ = p^(1/α) near the contact edge, with the pressure p ~ s^α at the
distance s from the edge. Fits to p² yield the peak pressure.
"""

from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Field, Indices
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.operator.domain import WINDOW, ReducedDomain

# Relative regularisation of coefficients that the data do not determine.
RIDGE = 1e-13
# Number of fits at a time, whose arrays stay in the processor cache.
CHUNK = 128
# Sum of the weights used in place of zero.
LEAST_TOTAL = 1e-30

# Curvature over the largest one below which a direction is that of a ridge.
CURVED = 0.1


@dataclass(frozen=True)
class Stencil:
    """Square window of (2 reach + 1)² cells for a local least-squares fit, with weights.

    reach  number of cells from the centre of the window to its sides
    width  decay length of the Gaussian weights exp(-r²/(2 width²)) at the distance r from the
           centre, in cells
    """

    reach: int
    width: float


NARROW = Stencil(3, 1.7)
WIDE = Stencil(5, 2.5)
WIDER = Stencil(6, 3.0)


@dataclass(frozen=True)
class Fits:
    """Quadratics fitted to cell means about n cells, one fit per cell; all arrays are (n,).

    quadratic  fitted quadratics, expanded about the cell centres
    rms        weighted root mean square of the differences between data and fit
    mean       weighted mean of the data in the window of the fit
    count      number of cells with a positive weight in the window
    """

    quadratic: Quadratic
    rms: Field
    mean: Field
    count: Indices


def fit_about(
    data: Field,
    weight: Field,
    i: Indices,
    j: Indices,
    stencil: Stencil,
    degree: int = 2,
    domain: ReducedDomain = WINDOW,
    sensitivity: tuple[Field, Field] | None = None,
) -> Fits:
    """Fit a polynomial to the cell means about each of n cells by weighted least squares.

    data         cell means (nx, ny)
    weight       weights of the cells (nx, ny), multiplied by those of the stencil
    i, j         indices of the central cells of the fits (n,)
    stencil      window and weights of the fits
    degree       degree of the polynomials, 1 or 2
    domain       domain of all fields: full window or reduced domain
    sensitivity  factor (nx, ny), and vectors (2, n) from the central cells to other points, in
                 cells. The model of the data is then the polynomial, of degree 2, plus the factor
                 times its value at the other point. None: the model is the polynomial alone
    """
    data, weight = (domain.add_frame(field, stencil.reach) for field in (data, weight))
    fade, basis = stencil_weights(stencil), monomials(stencil)[: 3 * degree]
    products = _monomial_products(stencil, degree)
    if sensitivity is not None:
        factor, (x, y) = domain.add_frame(sensitivity[0], stencil.reach), sensitivity[1]
        foot = np.stack([x**0, x, y, x**2 / 2, x * y, y**2 / 2], axis=-1)
    found = np.zeros((6, len(i)))
    rms, mean, count = np.empty(len(i)), np.empty(len(i)), np.empty(len(i), dtype=int)
    for first in range(0, len(i), CHUNK):
        some = slice(first, first + CHUNK)
        at = window_indices(i[some], j[some], stencil, data.shape[1])
        given, w = data.take(at), weight.take(at)
        w *= fade
        normal = (w @ products.T).reshape(len(w), *2 * basis.shape[:1])
        weighted = w * given
        fit = weighted @ basis.T
        total = np.maximum(normal[:, 0, 0], LEAST_TOTAL)
        mean[some] = fit[:, 0] / total
        if sensitivity is not None:
            c, to = factor.take(at), foot[some]
            mixed = (w * c) @ basis.T
            normal += mixed[:, None] * to[:, :, None] + to[:, None] * mixed[:, :, None]
            normal += np.sum(w * c**2, axis=1)[:, None, None] * to[:, None] * to[:, :, None]
            fit += to * np.sum(w * c * given, axis=1)[:, None]
        fit = solution(normal, fit)
        found[: len(basis), some] = fit.T
        given -= np.matmul(fit, basis, out=weighted)
        if sensitivity is not None:
            given -= c * np.sum(fit * to, axis=1)[:, None]
        given *= given
        given *= w
        rms[some] = np.sqrt(np.sum(given, axis=1) / total)
        count[some] = np.sum(w > 0, axis=1, dtype=np.int16)
    return Fits(Quadratic(i.astype(float), j.astype(float), *found), rms, mean, count)


def window_indices(i: Indices, j: Indices, stencil: Stencil, across: int) -> Indices:
    """Return the flat indices of the cells in the square window about each of n cells.

    The indices (n, (2 reach + 1)²) select from a field with a margin of `stencil.reach` cells on
    each side.

    i, j     indices of the central cells in the field without margin (n,)
    stencil  size of the windows
    across   number of cells of the field with margin along y
    """
    dx, dy = _window_offsets(stencil)
    centre = (i + stencil.reach) * across + j + stencil.reach
    return np.asarray(centre[:, None] + (dx * across + dy))


@cache
def stencil_weights(stencil: Stencil) -> Field:
    """Return the Gaussian weights of the cells in the window of a stencil, for local fits.

    The shape is ((2 reach + 1)²,). The central cell has the weight 1.

    stencil  window, and decay length of the weights
    """
    dx, dy = _window_offsets(stencil)
    return _read_only(np.exp(-(dx**2 + dy**2) / (2 * stencil.width**2)))


@cache
def monomials(stencil: Stencil) -> Field:
    """Compute the means of the monomials 1, x, y, x²/2, xy, y²/2 over each cell of a fit window.

    The shape is (6, (2 reach + 1)²). The coordinates x, y are in cells from the centre of the
    window.

    stencil  square window of cells
    """
    dx, dy = _window_offsets(stencil)
    rows = (np.ones(len(dx)), dx, dy, dx**2 / 2 + 1 / 24, dx * dy, dy**2 / 2 + 1 / 24)
    return _read_only(np.stack(rows))


@cache
def _monomial_products(stencil: Stencil, degree: int) -> Field:
    """Compute the products of all pairs of monomials in each cell of a fit
    window (9 degree², (2 reach + 1)²), for the matrices of least-squares fits."""
    basis = monomials(stencil)[: 3 * degree]
    return _read_only((basis[:, None] * basis).reshape(len(basis) ** 2, -1))


@cache
def _window_offsets(stencil: Stencil) -> tuple[Indices, Indices]:
    shift = np.arange(-stencil.reach, stencil.reach + 1)
    dx, dy = np.meshgrid(shift, shift, indexing="ij")
    return dx.ravel(), dy.ravel()


def _read_only(values: Field) -> Field:
    values.flags.writeable = False
    return values


def solution(normal: Field, right: Field) -> Field:
    """Solve the normal equations of n least-squares fits for the m coefficients of each fit (n, m).

    A small multiple of the trace is added to the diagonals, so that coefficients that the data do
    not determine stay finite.

    normal  matrices of the normal equations (n, m, m); their diagonals are changed in place
    right   right-hand sides (n, m)
    """
    diagonal = np.einsum("nkk->nk", normal)
    diagonal += RIDGE * (np.sum(diagonal, axis=1, keepdims=True) + LEAST_TOTAL)
    return np.asarray(np.linalg.solve(normal, right[..., None])[..., 0])


# A cell and its neighbours. Their slopes require the next cells: ACROSS cells in each direction.
NEXT = Stencil(1, 1.0)
ACROSS = 2
_ROOTS = np.sqrt(stencil_weights(NEXT))
# Least-squares matrix from the nine means to the coefficients of a quadratic (6, 9).
FIT = np.linalg.pinv(monomials(NEXT).T * _ROOTS[:, None]) * _ROOTS


class Peak(NamedTuple):
    """Largest pressure at a point of the contact, from a fit to cell means.

    value  largest pressure [force/length^2]
    ridge  True if the pressure is curved in at most one direction at this point, as along the ridge
           of a ring-shaped contact. Along a ridge the error of the value is of second order in the
           cell size
    """

    value: float
    ridge: bool


def peak_of(means: Field) -> Peak:
    """Determine the largest pressure at a point from the cell means of the pressure.

    A quadratic is fitted to the cell means of p² in the cell with the largest mean and its
    neighbours. In a Hertz contact p² is quadratic. The cell mean of p² is the square of the mean
    plus 1/12 of the square of the slope. On a ridge (ring-shaped contacts) the maximum is taken
    across the ridge. The largest mean is returned if a neighbour is out of contact or the maximum
    is not between the neighbours.

    means  cell means of the pressure after the edge correction (nx, ny) [force/length^2]
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
