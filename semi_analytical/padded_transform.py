"""Linear convolution by FFT on a zero-padded grid.

Padding to twice the cells along each side makes the cyclic convolution equal to the linear one on
every cell of the grid (Liu, Wang and Liu 2000, DC-FFT): there is no periodicity error.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from math import prod

import numpy as np
from numpy.typing import NDArray
from scipy.fft import next_fast_len

Field = NDArray[np.float64]
Spectrum = NDArray[np.complex128]
# Spectra (inputs, columns, 2 mx) and their columns, to those of the outputs; may overwrite.
Multiply = Callable[[Spectrum, slice], Spectrum]

# Entries of the spectra that are padded along x and multiplied at a time.
BLOCK = 1 << 14


@dataclass
class Convolutions:
    """Counts scalar convolutions: one forward and one inverse transform of a padded grid each.

    Grids of all sizes count alike; transforms of the unpadded grid (preconditioners) do not count.
    Operators that are counted together work one after the other, and in the same memory.
    """

    count: float = 0.0
    _memory: Spectrum = field(default_factory=lambda: np.empty(0, dtype=np.complex128))

    def spectrum(self, shape: tuple[int, ...]) -> Spectrum:
        """Work space, until the next operator asks for it; as much as any has needed is held."""
        size = prod(shape)
        if self._memory.size < size:
            self._memory = np.empty(0, dtype=np.complex128)  # both at once would be more
            self._memory = np.empty(size, dtype=np.complex128)
        return self._memory[:size].reshape(shape)


def offsets_for(shape: tuple[int, int]) -> tuple[int, int]:
    """How many offsets of influence coefficients an operator on `shape` cells needs; as many as one
    on a quarter of them, that both may take the same steps."""
    nx, ny = (2 * next_fast_len(n // 2) if n % 2 == 0 else next_fast_len(n) for n in shape)
    return int(nx) + 1, int(ny) + 1


class PaddedTransform:
    """Convolutions of fields on `shape` cells.

    Fields are padded along y, and only some columns at a time along x: no more is ever held than
    half of the padded spectra.

    reach   offsets of the influence coefficients that are needed
    period  (mx, my), at least the shape; padded are 2 mx by 2 my
    """

    def __init__(self, shape: tuple[int, int], counter: Convolutions) -> None:
        self.shape = shape
        self.counter = counter
        nx, ny = offsets_for(shape)
        self.reach = (slice(nx), slice(ny))
        self.period = (nx - 1, ny - 1)

    def convolved(self, values: Field, outputs: int, multiply: Multiply) -> Field:
        """Fields (outputs, nx, ny) of fields (inputs, nx, ny)."""
        inputs, (nx, ny), (mx, my) = len(values), self.shape, self.period
        held = max(inputs, outputs)
        width = min(my + 1, max(1, BLOCK // (2 * mx * held)))
        size = held * nx * (my + 1)
        work = self.counter.spectrum((size + inputs * width * 2 * mx,))
        lines = work[:size].reshape(held, nx, my + 1)
        np.fft.rfft(values, n=2 * my, axis=-1, out=lines[:inputs])
        for columns in _blocks(my + 1, width):
            block = work[size : size + inputs * (columns.stop - columns.start) * 2 * mx]
            block = block.reshape(inputs, -1, 2 * mx)
            block[:, :, :nx] = lines[:inputs, :, columns].swapaxes(1, 2)
            block[:, :, nx:] = 0
            np.fft.fft(block, axis=-1, out=block)
            block = multiply(block, columns)
            np.fft.ifft(block, axis=-1, out=block)
            lines[:outputs, :, columns] = block[:, :, :nx].swapaxes(1, 2)
        result = np.empty((outputs, nx, ny))
        for rows in _blocks(nx, max(1, BLOCK // (2 * my * outputs))):
            whole = np.fft.irfft(lines[:outputs, rows], n=2 * my, axis=-1)
            result[:, rows] = whole[..., :ny]
        self.counter.count += 0.5 * (inputs + outputs)
        return result


def _blocks(count: int, width: int) -> Iterator[slice]:
    """So many lines, a block at a time."""
    return (slice(first, min(first + width, count)) for first in range(0, count, width))
