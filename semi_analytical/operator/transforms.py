"""Transforms of fields on the full window or a reduced domain, for the convolution of tractions.

Along axes with a mirror plane, even fields are sums of cosines and odd fields sums of sines
(DCT-II, DST-II; Martucci 1994). Cell centres are at (i + ½) h from the plane, with h the cell side.
Along an axis without a mirror plane the FFT is used. Padding to twice the cells of the window
yields the linear convolution without periodicity error (DC-FFT; Liu, Wang and Liu 2000).

A spectrum is a phase times the amplitudes. The phases make the responses between amplitudes real.
Amplitudes of Fourier transforms are complex on the full window and pairs of real numbers on its
half.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import count
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semi_analytical.operator.domain import Pair, Parity, ReducedDomain

Array = NDArray[Any]
# Function of the amplitudes (columns, along x) of all components at some wavenumbers along y, and
# of the slice of these wavenumbers.
Multiply = Callable[[Sequence[Array], slice], Sequence[Array]]

# Size of the blocks of a component that are transformed along x and multiplied.
BLOCK = 1 << 14
# Cells along an axis up to which a matrix of cosines or sines replaces the FFT. The matrix is
# faster up to 96 cells, and saves the import of scipy.fft up to 128.
MAX_BY_MATRIX = 128


@dataclass
class Convolutions:
    """Counter of scalar convolutions, and work space of the operators that share the counter.

    A convolution is one forward and one inverse transform of a padded grid of any size. Unpadded
    transforms (approximate inverses) do not count. The operators must not run concurrently.

    count  number of convolutions so far
    """

    count: float = 0.0
    _memory: Array = field(default_factory=lambda: np.empty(0, dtype=complex))

    def work_space(self, size: int, dtype: type[float] | type[complex]) -> Array:
        """Return scratch memory for the transforms of an operator, valid until the next call.

        size   number of array entries
        dtype  data type of the entries, float or complex
        """
        if self._memory.view(dtype).size < size:
            self._memory = np.empty(0, dtype=complex)  # release before the new allocation
            self._memory = np.empty(size if dtype is complex else (size + 1) // 2, dtype=complex)
        return self._memory.view(dtype)[:size]


class Waves:
    """Fourier transform along an axis without a mirror plane, zero-padded to the period.

    cells       number of cells along the axis
    period      period in cells
    turned      True if amplitudes are i times the spectrum
    of_complex  True if values are complex, so that wavenumbers have both signs
    in_pairs    True if amplitudes are pairs of real numbers
    """

    def __init__(
        self,
        cells: int,
        period: int,
        turned: bool,
        *,
        of_complex: bool,
        in_pairs: bool,
    ) -> None:
        self._cells, self._period, self._has_factor_i = cells, period, turned
        self._forward = np.fft.fft if of_complex else np.fft.rfft
        self._back = np.fft.ifft if of_complex else np.fft.irfft
        self.count = (period if of_complex else period // 2 + 1) * (1 + in_pairs)

    def forward(self, values: Array, out: Array) -> Array:
        """Fourier transform values of cells along one axis to amplitudes, with zero padding.

        values  field on the cells (…, cells)
        out     array for the amplitudes, which is returned (…, count)
        """
        spectrum = out.view(complex)
        self._forward(values, n=self._period, axis=-1, out=spectrum)
        if self._has_factor_i:
            spectrum *= 1j
        return out

    def back(self, amplitudes: Array) -> Array:
        """Transform Fourier amplitudes along one axis to values of the cells (…, cells).

        amplitudes  amplitudes by wavenumber (…, count); may be overwritten
        """
        spectrum = np.ascontiguousarray(amplitudes).view(complex)
        if self._has_factor_i:
            spectrum = -1j * spectrum
        out = spectrum if self._back is np.fft.ifft else None
        found = self._back(spectrum, n=self._period, axis=-1, out=out)
        return np.asarray(found[..., : self._cells])


class MirroredWaves:
    """Cosine or sine transform of a field along an axis with a mirror plane.

    Values are zero-padded to half the period m. Cosines have the wavenumbers 0 … m - 1. Sines have
    m, 1 … m - 1: the wavenumber m takes the place of 0, so that the others keep their places.

    cells   number of cells of the domain along the axis
    period  period of the window in cells
    sign    parity of the field about the plane: 1 for cosines, -1 for sines
    """

    def __init__(self, cells: int, period: int, sign: int) -> None:
        self.count = m = period // 2
        self._cells, self._even = cells, sign > 0
        self._matrix: Array | None = None
        if cells <= MAX_BY_MATRIX:
            wave = 2 * (np.cos if self._even else np.sin)(np.pi / (2 * m) * np.arange(4 * m))
            numbers = [0 if self._even else m, *range(1, m)]
            at = np.outer(2 * np.arange(cells) + 1, numbers) % (4 * m)
            self._matrix = wave[at]
            self._inverse = self._matrix.T / (2 * m)
            self._inverse[0] /= 2

    def forward(self, values: Array, out: Array) -> Array:
        """Cosine or sine transform values of cells along one axis to amplitudes.

        values  field on the cells (…, cells)
        out     array for the amplitudes, which is returned (…, count)
        """
        if self._matrix is not None:
            np.matmul(values, self._matrix, out=out)
            return out
        from scipy.fft import dct, dst  # the import takes longer than a small contact

        if self._even:
            out[...] = dct(np.ascontiguousarray(values), type=2, n=self.count, axis=-1)
        else:
            found = dst(np.ascontiguousarray(values), type=2, n=self.count, axis=-1)
            out[..., 0], out[..., 1:] = found[..., -1], found[..., :-1]
        return out

    def back(self, amplitudes: Array) -> Array:
        """Transform cosine or sine amplitudes along one axis to values of the cells (…, cells).

        amplitudes  amplitudes by wavenumber (…, count)
        """
        if self._matrix is not None:
            return np.asarray(amplitudes @ self._inverse)
        from scipy.fft import idct, idst

        if self._even:
            return np.asarray(idct(amplitudes, type=2, axis=-1)[..., : self._cells])
        found = idst(np.roll(amplitudes, -1, axis=-1), type=2, axis=-1, overwrite_x=True)
        return np.asarray(found[..., : self._cells])


Side = Waves | MirroredWaves
Sides = tuple[Side, Side]  # along x and y
mirrored_waves = lru_cache(maxsize=64)(MirroredWaves)


def offsets_for(window: Pair) -> Pair:
    """Return the number of cell offsets along x and y at which influence coefficients are required.

    The offsets are 0 to half the zero-padded period of the convolution of tractions.

    window  number of cells of the window along x and y
    """
    x, y = (2 * fast_length((n + 1) // 2, 2 * 3 * 5 * 7 * 11) + 1 for n in window)
    return x, y


def fast_length(least: int, primes: int = 2 * 3 * 5) -> int:
    """Return the smallest number of points that has only small prime factors, for a fast FFT.

    least   lower limit of the number
    primes  product of the allowed prime factors
    """
    return next(n for n in count(least) if pow(primes, n.bit_length(), n) == 0)


def cosine_or_sine_sums(values: Array, parity: int) -> Array:
    """Compute the cosine or sine transform (DCT-I, DST-I) of even or odd values over one period.

    The Hermitian transform of a real sequence is its cosine transform, that of an imaginary
    sequence its sine transform. Blocks of rows avoid page faults of new memory.

    values  values at offsets 0 … m along the last axis; also the shape of the result
    parity  1 for cosines (even), -1 for sines (odd)
    """
    sums, points = np.empty(values.shape), values.shape[-1]
    for rows in _block_slices(len(values), max(1, BLOCK // (2 * points))):
        some = values[rows] if parity > 0 else 1j * values[rows]
        sums[rows] = np.fft.hfft(some)[:, :points]
    return sums


class Transforms:
    """Transforms of scalar and vector fields on a box of cells, along x and y.

    The box is part of the full window or of a reduced domain. The components of fields are named x
    and y (tangential), z (scalar) and by digits (bins of slip compliance).

    shape        number of cells of the box along x and y
    domain       full window or reduced domain that contains the box
    counter      counter of convolutions and work space
    half_period  (m_x, m_y) in cells of the window, even, equal on all domains: period of the
                 approximate inverses and half the period of the convolutions
    whole        True without mirror planes
    """

    def __init__(self, shape: Pair, domain: ReducedDomain, counter: Convolutions) -> None:
        self.shape, self.domain, self.counter = shape, domain, counter
        x, y = offsets_for(domain.window(shape))
        self.half_period: Pair = x - 1, y - 1
        self.whole = domain.images == 1

    @property
    def reach(self) -> tuple[slice, slice]:
        """Slices of the cell offsets along x and y whose coefficients a convolution needs."""
        m_x, m_y = self.half_period
        return slice(m_x + 1), slice(m_y + 1)

    def parity(self, component: str) -> Parity:
        """Return the parity of a field component about the planes x = 0 and y = 0.

        1 is even, -1 is odd, 0 means that the plane is not a mirror plane.

        component  "x" or "y" of a tangential field, "z" for a scalar field, or a bin of slip
                   compliance
        """
        x, y = self.domain.vector
        return {"x": x, "y": y, "z": self.domain.scalar}.get(component, self.domain.binned_slip)

    def phase(self, component: str) -> complex:
        """Return the ratio of the Fourier spectrum of a field component to its amplitudes.

        The ratio has a factor -i for each sine transform, and a factor -i for a component whose
        amplitudes have the factor i.

        component  "x" or "y" of a tangential field, "z" for a scalar field, or a bin of slip
                   compliance
        """
        turned = self._has_factor_i(component)
        phase: complex = (-1j) ** (self.parity(component).count(-1) + turned)
        return phase

    def _has_factor_i(self, component: str) -> bool:
        """Return True for components whose amplitudes are multiplied by i, so that responses are
        real: scalars on the full window, and the even component of vectors on half the window."""
        if component in "xy":
            return sorted(self.parity(component)) == [0, 1]
        return component == "z" and self.whole

    def axis_transforms(
        self, inputs: str, outputs: str, *, padded: bool = True
    ) -> tuple[list[Sides], list[Sides]]:
        """Return the transforms along x and along y of each input and each output component.

        inputs, outputs  names of the components, e.g. "xyz"
        padded           True for zero padding to twice the window
        """
        # Responses between scalars need no factor i on the full window.
        mixed = not (self.whole and {*inputs, *outputs} <= {"z"})
        x, y = (m * (1 + padded) for m in self.half_period)

        def of(component: str) -> Sides:
            turned = mixed and self._has_factor_i(component)
            last = turned and not self.whole
            return (
                self._axis_transform(component, 0, x, turned),
                self._axis_transform(component, 1, y, last),
            )

        return [of(one) for one in inputs], [of(one) for one in outputs]

    def _axis_transform(self, component: str, axis: int, period: int, turned: bool) -> Side:
        """Return the transform of one component along one axis.
        `turned` means amplitudes that are i times the spectrum."""
        sign, cells = self.parity(component)[axis], self.shape[axis]
        if sign:
            return mirrored_waves(cells, period, sign)
        of_complex = self.whole and axis == 0
        in_pairs = not self.whole
        return Waves(cells, period, turned, of_complex=of_complex, in_pairs=in_pairs)

    def filter_fields(
        self, values: Array, inputs: Sequence[Sides], outputs: Sequence[Sides], multiply: Multiply
    ) -> Array:
        """Transform fields, multiply their amplitudes by a filter, and transform them back.

        With the spectra of influence coefficients as factors, the filter is a convolution.

        values           input fields (inputs, nx, ny)
        inputs, outputs  transforms along x and y of each component, from `axis_transforms`
        multiply         function from amplitudes of the inputs to amplitudes of the outputs
        returns          output fields (outputs, nx, ny)
        """
        (x, y), (nx, ny), most = inputs[0], self.shape, max(len(inputs), len(outputs))
        by_matrix = not self.whole and max(nx, ny) <= MAX_BY_MATRIX
        width = y.count if by_matrix else min(y.count, max(1, BLOCK // x.count))
        size, dtype = nx * y.count, complex if self.whole else float
        # Page faults of new memory would take longer than the products.
        work = self.counter.work_space(most * (size + width * x.count), dtype)
        lines = work[: most * size].reshape(most, nx, y.count)
        blocks = work[most * size :].reshape(most, width, x.count)
        result = np.empty((len(outputs), nx, ny))
        if by_matrix:  # matrix products need no copy of the transpose
            each = zip(values, lines, blocks, inputs, strict=False)
            amplitudes = [x.forward(y.forward(one, a).T, b) for one, a, b, (x, y) in each]
            found = multiply(amplitudes, slice(None))
            for into, one, (x, y) in zip(result, found, outputs, strict=True):
                into[...] = y.back(x.back(one).T)
            return result
        for line, one, (_, side) in zip(lines, values, inputs, strict=False):
            side.forward(one, line)
        for columns in _block_slices(y.count, width):
            block = blocks[: len(inputs), : columns.stop - columns.start]
            for into, line, (side, _) in zip(block, lines, inputs, strict=False):
                side.forward(line[:, columns].T, into)
            found = multiply(list(block), columns)
            for line, one, (side, _) in zip(lines, found, outputs, strict=False):
                line[:, columns] = side.back(one).T
        for rows in _block_slices(nx, max(1, BLOCK // y.count)):
            for into, line, (_, side) in zip(result, lines, outputs, strict=False):
                into[rows] = side.back(line[rows])
        return result


@lru_cache(maxsize=64)
def _block_slices(count: int, width: int) -> tuple[slice, ...]:
    return tuple(slice(first, min(first + width, count)) for first in range(0, count, width))
