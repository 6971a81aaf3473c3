"""Transforms of fields on a domain: cosines and sines along axes with a mirror plane, else waves.

Cells lie at (i + ½) h on one side of a plane: an even field is a sum of cosines, an odd one of
sines at their centres (DCT-II, DST-II; Martucci 1994). Along an axis without a plane the spectrum
is that of the FFT. Padded to twice the cells of the window along each side, all of them give the
linear convolution: there is no periodicity error (Liu, Wang and Liu 2000, DC-FFT).

A spectrum is a phase times the amplitudes. Phases are chosen such that responses between amplitudes
are real. Amplitudes of waves are complex on the window; on half of it they are pairs of real
numbers.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dct, dst, idct, idst, next_fast_len

from semi_analytical.operator.domain import Pair, Parity, ReducedDomain

Array = NDArray[Any]
Dtype = np.dtype[Any]
# Amplitudes (columns, along x) of every component at some of those along y, and which ones.
Multiply = Callable[[Sequence[Array], slice], Sequence[Array]]

DOUBLE: Dtype = np.dtype(np.float64)
# Numbers of a component that are transformed along x and multiplied at a time.
BLOCK = 1 << 14
# Cells along a side up to which a product with the matrix of cosines or sines is cheaper than an
# FFT with its rearrangement.
MAX_BY_MATRIX = 96


@dataclass
class Convolutions:
    """Number of scalar convolutions: one forward and one inverse transform of a padded grid each.

    Grids of all sizes count alike; unpadded transforms (approximate inverses) do not count.
    Operators that share the counter work one after the other, in the same memory.
    """

    count: float = 0.0
    _memory: Array = field(default_factory=lambda: np.empty(0, dtype=np.complex128))

    def work_space(self, size: int, dtype: Dtype) -> Array:
        """Return memory for `size` numbers, valid until the next operator asks for it."""
        if self._memory.nbytes < size * dtype.itemsize:
            self._memory = np.empty(0, dtype=np.complex128)  # both at once would need more
            self._memory = np.empty(-(-size * dtype.itemsize // 16), dtype=np.complex128)
        return self._memory.view(dtype)[:size]


class Waves:
    """Amplitudes along an axis without a mirror plane: the spectrum of values that are zero from
    the last cell to the period.

    of_complex  values are complex, wavenumbers have both signs
    in_pairs    amplitudes are pairs of real numbers
    turned      amplitudes are i times the spectrum
    """

    def __init__(
        self, cells: int, period: int, turned: bool, *, of_complex: bool, in_pairs: bool
    ) -> None:
        self._cells, self._period, self._turned, self._in_pairs = cells, period, turned, in_pairs
        self._forward = np.fft.fft if of_complex else np.fft.rfft
        self._back = np.fft.ifft if of_complex else np.fft.irfft
        self.count = (period if of_complex else period // 2 + 1) * (1 + in_pairs)

    def forward(self, values: Array, out: Array) -> Array:
        """Transform values (…, cells) to amplitudes (…, count) in `out`."""
        spectrum = _complex(out) if self._in_pairs else out
        self._forward(values, n=self._period, axis=-1, out=spectrum)
        if self._turned:
            spectrum *= 1j
        return out

    def back(self, amplitudes: Array) -> Array:
        """Transform amplitudes (…, count) to values (…, cells)."""
        spectrum = _complex(np.ascontiguousarray(amplitudes)) if self._in_pairs else amplitudes
        if self._turned:
            spectrum = -1j * spectrum
        return np.asarray(self._back(spectrum, n=self._period, axis=-1)[..., : self._cells])


def _complex(pairs: Array) -> Array:
    return pairs.view(np.result_type(pairs.dtype, np.complex64))


class MirroredWaves:
    """Amplitudes along an axis with a mirror plane: cosines of the wavenumbers 0 … m - 1, or sines
    of m, 1 … m - 1, for values that are zero from the last cell to half the period m.

    The sine of m takes the place of 0, where there is none, so that both have equal wavenumbers.
    """

    def __init__(self, cells: int, period: int, sign: int, dtype: Dtype) -> None:
        self.count = m = period // 2
        self._cells, self._even = cells, sign > 0
        self._matrix: Array | None = None
        if cells <= MAX_BY_MATRIX:
            wave = 2 * (np.cos if self._even else np.sin)(np.pi / (2 * m) * np.arange(4 * m))
            numbers = [0 if self._even else m, *range(1, m)]
            at = np.outer(2 * np.arange(cells) + 1, numbers) % (4 * m)
            self._matrix = wave[at].astype(dtype)
            self._inverse = self._matrix.T / (2 * m)
            self._inverse[0] /= 2

    def forward(self, values: Array, out: Array) -> Array:
        """Transform values (…, cells) to amplitudes (…, count) in `out`."""
        if self._matrix is not None:
            np.matmul(values, self._matrix, out=out)
        elif self._even:
            out[...] = dct(np.ascontiguousarray(values), type=2, n=self.count, axis=-1)
        else:
            found = dst(np.ascontiguousarray(values), type=2, n=self.count, axis=-1)
            out[..., 0], out[..., 1:] = found[..., -1], found[..., :-1]
        return out

    def back(self, amplitudes: Array) -> Array:
        """Transform amplitudes (…, count) to values (…, cells)."""
        if self._matrix is not None:
            return np.asarray(amplitudes @ self._inverse)
        if self._even:
            return np.asarray(idct(amplitudes, type=2, axis=-1)[..., : self._cells])
        found = idst(np.roll(amplitudes, -1, axis=-1), type=2, axis=-1, overwrite_x=True)
        return np.asarray(found[..., : self._cells])


Side = Waves | MirroredWaves
Sides = tuple[Side, Side]  # along x and y
_mirrored = lru_cache(maxsize=64)(MirroredWaves)


def offsets_for(window: Pair) -> Pair:
    """Offsets of influence coefficients along x and y that operators on a window of cells read:
    from 0 to half the padded period, which is even."""
    x, y = (2 * int(next_fast_len((n + 1) // 2)) + 1 for n in window)
    return x, y


class Transforms:
    """Transforms of the components of fields on a box of `shape` cells of a domain.

    Components are x and y (tangential), z (scalar) and bins of slip compliance, named by digits.

    half_period  (m_x, m_y) along the window, even: fields repeat after twice as many cells, those
                 of approximate inverses after as many; equal on all domains
    """

    def __init__(self, shape: Pair, domain: ReducedDomain, counter: Convolutions) -> None:
        self.shape, self.domain, self.counter = shape, domain, counter
        x, y = offsets_for(domain.window(shape))
        self.half_period: Pair = x - 1, y - 1
        self.whole = domain.images == 1

    @property
    def reach(self) -> tuple[slice, slice]:
        """Offsets of influence coefficients that an operator needs."""
        m_x, m_y = self.half_period
        return slice(m_x + 1), slice(m_y + 1)

    def parity(self, component: str) -> Parity:
        """Signs of the images of a component."""
        x, y = self.domain.vector
        return {"x": x, "y": y, "z": self.domain.scalar}.get(component, self.domain.rotating)

    def phase(self, component: str) -> complex:
        """Spectrum over amplitude: -i for each sine, and for a turned component."""
        turned = self._turned(component)
        phase: complex = (-1j) ** (self.parity(component).count(-1) + turned)
        return phase

    def _turned(self, component: str) -> bool:
        """Whether amplitudes are i times those of the parity, which makes responses real: of
        scalars on the window, of the even component of vectors on half of it."""
        if component in "xy":
            return sorted(self.parity(component)) == [0, 1]
        return component == "z" and self.whole

    def sides(
        self, inputs: str, outputs: str, *, padded: bool = True, dtype: Dtype = DOUBLE
    ) -> tuple[list[Sides], list[Sides]]:
        """Transforms of some components to others."""
        # On the window only responses between scalars and vectors are not real by themselves.
        mixed = not (self.whole and {*inputs, *outputs} <= {"z"})
        x, y = (m * (1 + padded) for m in self.half_period)

        def of(component: str) -> Sides:
            turned = mixed and self._turned(component)
            last = turned and not self.whole
            return (
                self._side(component, 0, x, turned, dtype),
                self._side(component, 1, y, last, dtype),
            )

        return [of(one) for one in inputs], [of(one) for one in outputs]

    def _side(self, component: str, axis: int, period: int, turned: bool, dtype: Dtype) -> Side:
        sign, cells = self.parity(component)[axis], self.shape[axis]
        if sign:
            return _mirrored(cells, period, sign, dtype)
        of_complex = self.whole and axis == 0
        return Waves(cells, period, turned, of_complex=of_complex, in_pairs=not self.whole)

    def filtered(
        self, values: Array, inputs: Sequence[Sides], outputs: Sequence[Sides], multiply: Multiply
    ) -> Array:
        """Compute fields (outputs, nx, ny) of fields (inputs, nx, ny) by their amplitudes."""
        (x, y), (nx, ny), held = inputs[0], self.shape, max(len(inputs), len(outputs))
        by_matrix = not self.whole and max(nx, ny) <= MAX_BY_MATRIX
        width = y.count if by_matrix else min(y.count, max(1, BLOCK // x.count))
        size, dtype = nx * y.count, values.dtype
        if self.whole:
            dtype = np.result_type(dtype, np.complex64)
        # New memory would cost more time than the products, by its page faults.
        work = self.counter.work_space(held * (size + width * x.count), dtype)
        lines = work[: held * size].reshape(held, nx, y.count)
        blocks = work[held * size :].reshape(held, width, x.count)
        result = np.empty((len(outputs), nx, ny), dtype=values.dtype)
        if by_matrix:  # products with matrices take the transpose as it is
            each = zip(values, lines, blocks, inputs, strict=False)
            amplitudes = [x.forward(y.forward(one, a).T, b) for one, a, b, (x, y) in each]
            found = multiply(amplitudes, slice(None))
            for into, one, (x, y) in zip(result, found, outputs, strict=True):
                into[...] = y.back(x.back(one).T)
            return result
        for line, one, (_, side) in zip(lines, values, inputs, strict=False):
            side.forward(one, line)
        for columns in _blocks(y.count, width):
            block = blocks[: len(inputs), : columns.stop - columns.start]
            for into, line, (side, _) in zip(block, lines, inputs, strict=False):
                side.forward(line[:, columns].T, into)
            found = multiply(list(block), columns)
            for line, one, (side, _) in zip(lines, found, outputs, strict=False):
                line[:, columns] = side.back(one).T
        for rows in _blocks(nx, max(1, BLOCK // y.count)):
            for into, line, (_, side) in zip(result, lines, outputs, strict=False):
                into[rows] = side.back(line[rows])
        return result


def _blocks(count: int, width: int) -> Iterator[slice]:
    return (slice(first, min(first + width, count)) for first in range(0, count, width))
