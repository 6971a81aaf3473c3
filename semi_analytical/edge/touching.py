"""Cells outside of a region that touch it, and what fits about its cells say of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.fit import Fits, Indices
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.part import WHOLE, Part

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Steps to the cells that touch one at a side, then at a corner.
STEPS = np.array([[1, -1, 0, 0, 1, 1, -1, -1], [0, 0, 1, -1, 1, -1, 1, -1]])
SIDES = 4


def _moved() -> Field:
    """Coefficients of quadratics about cells to those about the cells from which these are steps
    away (6, steps, 6)."""
    x, y = -STEPS
    moved = np.zeros((6, len(x), 6))
    moved[range(6), :, range(6)] = 1.0
    moved[0, :, 1:] = np.stack([x, y, x**2 / 2, x * y, y**2 / 2], axis=-1)
    moved[1, :, 3], moved[1, :, 4] = x, y
    moved[2, :, 4], moved[2, :, 5] = x, y
    return np.ascontiguousarray(moved.transpose(0, 2, 1)).reshape(6, -1)


MOVED = _moved()


@dataclass(frozen=True)
class Touching:
    """Cells (i, j), shape (n,), outside of a region, told by the fits about cells inside: by the
    mean of those about cells that they touch at a side, else at a corner, as a mirror image would
    have it.

    which  (steps, n) of the fits; any where there is none
    share  (6, steps, n) by how much the coefficients of each count: of images with their signs
    """

    i: Indices
    j: Indices
    which: Indices
    share: Field

    @classmethod
    def of(
        cls,
        i: Indices,
        j: Indices,
        inside: tuple[Indices, Indices],
        cells: tuple[int, ...],
        part: Part = WHOLE,
    ) -> Touching:
        """inside  the cells with fits, among them all that touch these
        cells   of the part of the window that all are on
        """
        number = np.zeros(cells, dtype=int)
        number[inside] = np.arange(1, len(inside[0]) + 1)
        beside_i, beside_j = i + STEPS[0][:, None], j + STEPS[1][:, None]
        which = part.framed(number, 1)[beside_i + 1, beside_j + 1] - 1
        share = (which >= 0).astype(float)
        share[SIDES:, np.any(share[:SIDES] > 0, axis=0)] = 0.0
        share /= np.sum(share, axis=0)
        sign_x, sign_y = np.where(beside_i < 0, -1.0, 1.0), np.where(beside_j < 0, -1.0, 1.0)
        signs = np.stack([share, sign_x, sign_y, share, sign_x * sign_y, share])
        signs[[1, 2, 4]] *= share
        return cls(i, j, which, signs)

    def joined(self, fits: Fits, safe: Mask) -> tuple[Quadratic, Mask]:
        """phi about these cells and behind them those of the fits, and whether to believe it.

        safe  whether to believe the fits
        """
        of = fits.quadratic
        inside = np.stack([of.f, of.f_x, of.f_y, of.f_xx, of.f_xy, of.f_yy])
        told = MOVED @ (inside[:, self.which] * self.share).reshape(MOVED.shape[1], -1)
        places = np.concatenate([self.i, of.x]), np.concatenate([self.j, of.y])
        believed = np.all(safe[self.which] | (self.share[0] == 0), axis=0)
        quadratic = Quadratic(*places, *np.concatenate([told, inside], axis=1))
        return quadratic, np.concatenate([believed, safe])
