"""Shear tractions that friction allows: |q| <= bound in every cell, with a given sum or without.

The exact projection on {discs, and Σq = total} is what makes the shear problem robust: every
iterate carries the load and obeys Coulomb's bound, and the multiplier of the sum is the rigid
shift. The projection is q = P(y + λ) with P the projection on the discs; the two components of λ
minimise a convex function (the dual), found by a damped Newton method. It works on the gradient of
that function, Σq - total: its values are differences of large numbers near the friction limit.
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
# Relative distance from the friction limit at which force control loses the shift.
AT_LIMIT = 1e-9
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
    if guess is None:
        open_cells = bound > 0
        excess = np.sum(y, axis=(1, 2), where=open_cells) - total
        guess = -excess / np.count_nonzero(open_cells)
    multiplier = guess
    shifted = _Shifted.by(multiplier, y, bound, total)
    for _ in range(MOST_SWEEPS):
        blur = MULTIPLIER_ROUND_OFF * np.sum(shifted.scale) * np.sum(np.abs(multiplier))
        if np.sum(np.abs(shifted.defect)) <= ROUND_OFF * shifted.strength + blur:
            break
        step = shifted.newton_step()
        steepest = -float(np.sum(shifted.defect * step))
        part = 1.0
        while True:
            trial = _Shifted.by(multiplier + part * step, y, bound, total)
            # The defect is the slope of the dual: the step may pass the minimum only a little.
            if np.sum(trial.defect * step) <= 0.5 * steepest or part < 1e-9:
                break
            part *= 0.5
        multiplier = multiplier + part * step
        shifted = trial
    return shifted.q, multiplier


@dataclass(frozen=True)
class _Shifted:
    """y + λ cut off at the discs.

    z, length  y + λ (2, nx, ny) and its length (nx, ny)
    outside    where that is longer than the bound
    scale, q   factor of the cut (nx, ny), and q = scale z
    defect     Σq - total (2,), the gradient of the dual function of λ
    capacity   sum of the bound
    """

    z: VectorField
    length: Field
    outside: NDArray[np.bool_]
    scale: Field
    q: VectorField
    defect: Vector
    capacity: float

    @classmethod
    def by(cls, multiplier: Vector, y: VectorField, bound: Field, total: Vector) -> "_Shifted":
        """Shift `y` by a multiplier and cut it off."""
        z = y + everywhere(multiplier)
        length = magnitude(z)
        outside = length > bound
        scale = np.where(outside, bound / np.where(outside, length, 1.0), 1.0) * (bound > 0)
        q = z * scale
        defect = np.sum(q, axis=(1, 2)) - total
        return cls(z, length, outside, scale, q, defect, float(np.sum(bound)))

    @property
    def strength(self) -> float:
        """Σ|q|."""
        return float(np.sum(self.length * self.scale))

    def newton_step(self) -> Vector:
        """Change of λ that removes the defect to first order.

        A cell on its disc answers only across its own direction; a small multiple of the
        identity keeps the step finite while all cells are on theirs and vanishes with the defect.
        """
        w = np.where(self.outside, self.scale / np.where(self.outside, self.length**2, 1.0), 0.0)
        x, y = self.z
        xx, yy = np.sum(self.scale - w * x * x), np.sum(self.scale - w * y * y)
        xy = -np.sum(w * x * y)
        damping = 1e-3 * (xx + yy) * np.sum(np.abs(self.defect)) / self.capacity
        matrix = np.array([[xx + damping, xy], [xy, yy + damping]])
        return -np.linalg.solve(matrix, self.defect)
