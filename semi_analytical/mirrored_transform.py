"""Linear convolution of fields that are even about x = 0 and y = 0, on a quarter of the grid.

With cells on either side of both planes, such a field is a sum of cosines at the cell centres of
the quarter x > 0, y > 0 (DCT-II), and an even kernel multiplies each by a number (Martucci 1994,
symmetric convolution). Padded to twice the cells along each side, the quarter gives what the whole
field gives padded to twice its cells: there is no periodicity error.
"""

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dct, idct, next_fast_len

from semi_analytical.padded_transform import Convolutions

Field = NDArray[np.float64]
# Amplitudes (columns, mx) of some wavenumbers along y, and which; may overwrite.
Multiply = Callable[[Field, slice], Field]

# Entries that are transformed along x and multiplied at a time.
BLOCK = 1 << 14
# Cells along a side up to which a product with the matrix of cosines is cheaper than an FFT: twice
# on 32, hardly on 64.
MOST_BY_MATRIX = 64


def mirrored_offsets(shape: tuple[int, int]) -> tuple[int, int]:
    """How many offsets of influence coefficients an operator on a quarter of `shape` cells needs;
    no fewer than one on the whole window."""
    return 2 * int(next_fast_len(shape[0])) + 1, 2 * int(next_fast_len(shape[1])) + 1


class Cosines:
    """Values at `cells` places (i + ½) h along the last axis, to the amplitudes of cos(π k x/m h),
    k < m, and back; zero from the last cell to m h."""

    def __init__(self, cells: int, m: int, forward: Field | None = None) -> None:
        self.cells, self.m = cells, m
        self._forward = forward
        if forward is None and cells <= MOST_BY_MATRIX:
            turn = 2 * np.cos(np.pi / (2 * m) * np.arange(4 * m))
            self._forward = turn[np.outer(2 * np.arange(cells) + 1, np.arange(m)) % (4 * m)]
        if self._forward is not None:
            self._back = self._forward.T / (2 * m)
            self._back[0] /= 2

    @property
    def count(self) -> int:
        """Of the amplitudes."""
        return self.m

    def unpadded(self) -> "Cosines":
        """Those of half the length m: every second one."""
        every = None if self._forward is None else np.ascontiguousarray(self._forward[:, ::2])
        return Cosines(self.cells, self.m // 2, every)

    def forward(self, values: Field) -> Field:
        """(…, cells) to (…, m)."""
        if self._forward is not None:
            return values @ self._forward
        return np.asarray(dct(np.ascontiguousarray(values), type=2, n=self.m, axis=-1))

    def back(self, amplitudes: Field) -> Field:
        """(…, m) to (…, cells)."""
        if self._forward is not None:
            return amplitudes @ self._back
        return np.asarray(idct(amplitudes, type=2, axis=-1)[..., : self.cells])


class MirroredTransform:
    """Convolutions of even fields, by their quarter of `shape` cells.

    reach   offsets of the influence coefficients that are needed
    period  of the whole field unpadded, at least twice the shape
    """

    def __init__(self, shape: tuple[int, int], counter: Convolutions) -> None:
        self.counter = counter
        nx, ny = mirrored_offsets(shape)
        self.reach = (slice(nx), slice(ny))
        self.period = (nx - 1, ny - 1)
        sides = dict(zip(shape, self.period, strict=True))  # one where both are alike
        padded = {n: Cosines(n, m) for n, m in sides.items()}
        unpadded = {n: side.unpadded() for n, side in padded.items()}
        self._padded = tuple(padded[n] for n in shape)
        self._unpadded = tuple(unpadded[n] for n in shape)

    def convolved(self, values: Field, multiply: Multiply) -> Field:
        """A field of a field, both (nx, ny)."""
        self.counter.count += 1
        return _filtered(values, self._padded, multiply)

    def filtered(self, values: Field, multiply: Multiply) -> Field:
        """The same with the unpadded period."""
        return _filtered(values, self._unpadded, multiply)


def _filtered(values: Field, sides: tuple[Cosines, ...], multiply: Multiply) -> Field:
    """A field with its amplitudes multiplied, both (nx, ny)."""
    x, y = sides
    lines = y.forward(values)
    if lines.size <= BLOCK // 2:
        return y.back(x.back(multiply(x.forward(lines.T), slice(y.m))).T)
    for columns in _blocks(y.m, max(1, BLOCK // x.m)):
        lines[:, columns] = x.back(multiply(x.forward(lines[:, columns].T), columns)).T
    result = np.empty_like(values)
    for rows in _blocks(x.cells, max(1, BLOCK // y.m)):
        result[rows] = y.back(lines[rows])
    return result


def _blocks(count: int, width: int) -> Iterator[slice]:
    """So many lines, a block at a time."""
    return (slice(first, min(first + width, count)) for first in range(0, count, width))
