"""Shear tractions that friction allows: |q| <= bound in every cell, with a given sum or without.

The exact projection on {discs, and Σq = total} is what makes the shear problem robust: every
iterate carries the load and obeys Coulomb's bound, and the multiplier of the sum is the rigid
shift. The projection is q = P(y + λ) with P the projection on the discs; the two components of λ
minimise a convex function (the dual), found by a damped Newton method.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
Vector = NDArray[np.float64]

MOST_SWEEPS = 100
# What rounding leaves of a sum of shears, relative to the sum of their magnitudes.
ROUND_OFF = 1e-14
# What rounding leaves of the multiplier, relative to it; all cells that stick move with it.
MULTIPLIER_ROUND_OFF = 5e-16


@dataclass(frozen=True)
class ShearSum:
    """Force control: the sum Σq of all cell shears, T / cell area, shape (2,)."""

    total: Vector


@dataclass(frozen=True)
class FixedShift:
    """Displacement control: the tangential shift of the indenter, shape (2,) [length]."""

    shift: Vector


TangentialLoad = ShearSum | FixedShift


def magnitude(v: VectorField) -> Field:
    """Length of the vectors (2, ...), shape (...)."""
    return np.sqrt(v[0] * v[0] + v[1] * v[1])


def everywhere(v: Vector) -> VectorField:
    """A vector (2,) as a field that broadcasts with (2, nx, ny)."""
    return v[:, None, None]


def project_on_discs(y: VectorField, bound: Field) -> VectorField:
    """The nearest shear with |q| <= bound, cell by cell."""
    length = magnitude(y)
    return np.asarray(y * np.where(length > bound, bound / np.where(length > 0, length, 1.0), 1.0))


def project(
    y: VectorField, bound: Field, total: Vector, guess: Vector | None = None
) -> tuple[VectorField, Vector]:
    """The nearest shear with |q| <= bound and Σq = total, and the multiplier λ of the sum.

    y      any shear (2, nx, ny)
    bound  friction limit µp (nx, ny); |total| must be less than its sum
    guess  where to start the search for λ
    """
    capacity = np.sum(bound)
    cells = np.count_nonzero(bound)
    open_cells = bound > 0
    if guess is None:
        guess = (total - np.sum(y, axis=(1, 2), where=open_cells)) / cells
    multiplier = guess
    z, length, outside, dual = _dual(y, bound, total, multiplier)
    for _ in range(MOST_SWEEPS):
        scale = np.where(outside, bound / np.where(outside, length, 1.0), 1.0) * open_cells
        q = z * scale
        defect = np.sum(q, axis=(1, 2)) - total
        error = np.sum(np.abs(defect)) / capacity
        blur = MULTIPLIER_ROUND_OFF * np.sum(scale) * np.sum(np.abs(multiplier))
        if np.sum(np.abs(defect)) <= ROUND_OFF * np.sum(length * scale) + blur:
            break
        # A cell on its disc answers only across its own direction; the small multiple of the
        # identity keeps the step finite while all cells are on theirs and vanishes with the error.
        w = np.where(outside, scale / np.where(outside, length * length, 1.0), 0.0)
        xx, yy = np.sum(scale - w * z[0] ** 2), np.sum(scale - w * z[1] ** 2)
        xy = -np.sum(w * z[0] * z[1])
        damping = 1e-4 * error * cells
        step = -np.linalg.solve(np.array([[xx + damping, xy], [xy, yy + damping]]), defect)
        slope = float(np.sum(defect * step))
        part = 1.0
        while True:
            trial = _dual(y, bound, total, multiplier + part * step)
            if trial[3] <= dual + 1e-4 * part * slope + ROUND_OFF * abs(dual) or part < 1e-9:
                break
            part *= 0.5
        multiplier = multiplier + part * step
        z, length, outside, dual = trial
    return q, multiplier


def _dual(
    y: VectorField, bound: Field, total: Vector, multiplier: Vector
) -> tuple[VectorField, Field, NDArray[np.bool_], float]:
    """y + λ, its length, where that is outside the discs, and the dual function of λ."""
    z = y + everywhere(multiplier)
    length = magnitude(z)
    outside = length > bound
    moreau = np.where(outside, bound * (length - 0.5 * bound), 0.5 * length * length)
    return z, length, outside, float(np.sum(moreau) - np.sum(multiplier * total))
