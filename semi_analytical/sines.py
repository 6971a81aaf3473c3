"""Fields that are odd about the planes x = 0 and y = 0, by their sines on one side of each.

Such a field is a sum of sines at the cell centres (DST-II; Martucci 1994), as an even one is of
cosines: see `mirrored_transform`. Sines have the wavenumbers 1 … m, cosines 0 … m - 1. For both to
be multiplied alike, that of m is kept in the place of 0, where no odd field has any.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dst, idst

from semi_analytical.mirrored_transform import Cosines

Field = NDArray[np.float64]

# Cells along a side up to which products with the matrices of sines and cosines are cheaper than
# FFTs and their rearrangement, of vectors and what turns them.
MOST_BY_MATRIX = 96
DOUBLE = np.dtype(np.float64)


class Sines:
    """Values at `cells` places (i + ½) h along the last axis, to the amplitudes of sin(π k x/m h),
    k = m, 1 … m - 1, and back; zero from the last cell to m h."""

    def __init__(self, cells: int, m: int, precision: np.dtype[Any] = DOUBLE) -> None:
        self.cells, self.m = cells, m
        self._forward: Field | None = None
        if cells <= MOST_BY_MATRIX:
            self._forward = _waves(np.sin, cells, m, [m, *range(1, m)]).astype(precision)
            self._back = self._forward.T / (2 * m)
            self._back[0] /= 2

    @property
    def count(self) -> int:
        """Of the amplitudes."""
        return self.m

    def forward(self, values: Field) -> Field:
        """(…, cells) to (…, m)."""
        if self._forward is not None:
            return values @ self._forward
        found = dst(np.ascontiguousarray(values), type=2, n=self.m, axis=-1)
        return np.roll(found, 1, axis=-1)

    def back(self, amplitudes: Field) -> Field:
        """(…, m) to (…, cells)."""
        if self._forward is not None:
            return amplitudes @ self._back
        found = idst(np.roll(amplitudes, -1, axis=-1), type=2, axis=-1, overwrite_x=True)
        return np.asarray(found[..., : self.cells])


def cosines(cells: int, m: int, precision: np.dtype[Any] = DOUBLE) -> Cosines:
    """Those beside the sines, by a matrix where these are."""
    if cells > MOST_BY_MATRIX:
        return Cosines(cells, m)
    return Cosines(cells, m, _waves(np.cos, cells, m, range(m)).astype(precision))


def _waves(wave: np.ufunc, cells: int, m: int, wavenumbers: Sequence[int]) -> Field:
    """Twice the waves at the places of the cells (cells, wavenumbers)."""
    turn = 2 * wave(np.pi / (2 * m) * np.arange(4 * m))
    return np.asarray(turn[np.outer(2 * np.arange(cells) + 1, wavenumbers) % (4 * m)])
