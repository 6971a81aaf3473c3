"""Tractions to displacements: linear convolution by FFT on a zero-padded grid.

Padding to twice the cells along each side makes the cyclic convolution equal to the linear one on
every cell of the grid (Liu, Wang and Liu 2000, DC-FFT): there is no periodicity error. The
coefficients are even or odd along each side, so their transforms are purely real or purely
imaginary and one real array stores each.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dct, dst, next_fast_len

from semi_analytical.influence.coefficients import InfluenceCoefficients

Field = NDArray[np.float64]
Spectrum = NDArray[np.complex128]


# Entries of a spectrum that are transformed at a time along x, or along y on the way back.
BLOCK = 1 << 20


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
    """How many offsets of influence coefficients an operator on `shape` cells needs."""
    return int(next_fast_len(shape[0])) + 1, int(next_fast_len(shape[1])) + 1


class PaddedTransform:
    """Real FFT of a zero-padded grid.

    Only the rows that are not zero are transformed along the last axis, and only the rows that
    are read are transformed back.

    components  of a field that are transformed together, as its first axis; no such axis if one
    """

    def __init__(self, shape: tuple[int, int], counter: Convolutions, components: int = 1) -> None:
        self.shape = shape
        self._count = 0.5 * components
        self._lead = (components,) if components > 1 else ()
        self.counter = counter
        nx, ny = offsets_for(shape)
        self.reach = (slice(nx), slice(ny))
        self.period = (nx - 1, ny - 1)
        self.padded = (2 * self.period[0], 2 * self.period[1])

    def spectra(self, *count: int) -> Spectrum:
        """Work space for the half spectra of a field, or of so many; see Convolutions."""
        half = (*count, *self._lead, self.padded[0], self.padded[1] // 2 + 1)
        return self.counter.spectrum(half)

    def forward(self, values: Field, out: Spectrum) -> None:
        """Transform `values` (…, nx, ny), zero beyond, into the half spectra `out`."""
        nx = self.shape[0]
        np.fft.rfft(values, n=self.padded[1], axis=-1, out=out[..., :nx, :])
        out[..., nx:, :] = 0
        self._along_x(np.fft.fft, out)
        self.counter.count += self._count

    def inverse(self, spectrum: Spectrum) -> Field:
        """Values on the grid (…, nx, ny) of half spectra, which are overwritten."""
        nx, ny = self.shape
        self._along_x(np.fft.ifft, spectrum)
        values = np.empty((*self._lead, nx, ny))
        for rows in _blocks(nx, spectrum.size // self.padded[0]):
            lines = np.fft.irfft(spectrum[..., rows, :], n=self.padded[1], axis=-1)
            values[..., rows, :] = lines[..., :ny]
        self.counter.count += self._count
        return values

    def _along_x(self, transform: Callable[..., Any], spectrum: Spectrum) -> None:
        """Transform in place, but for the copy that numpy makes of what it overwrites."""
        for columns in _blocks(spectrum.shape[-1], spectrum.size // spectrum.shape[-1]):
            part = spectrum[..., columns]
            transform(part, axis=-2, out=part)


def _blocks(lines: int, length: int) -> Iterator[slice]:
    """All lines, a block of entries at a time."""
    step = max(1, BLOCK // length)
    return (slice(first, min(first + step, lines)) for first in range(0, lines, step))


def even_transform(coefficients: Field, padded: tuple[int, int]) -> Field:
    """Real half spectrum of coefficients that are even along both sides.

    coefficients  at offsets 0 … padded/2 along each side. The last offset is never read by the
                  convolution; with its true value the periodic continuation is continuous, and
                  the spectrum of a positive kernel is positive.
    """
    return _mirror(dct(dct(coefficients, type=1, axis=0), type=1, axis=1), padded[0], sign=1)


def odd_transform(coefficients: Field, padded: tuple[int, int]) -> Field:
    """Real half spectrum of coefficients that are odd along both sides: (-i)^2 is real."""
    half = np.zeros((padded[0] // 2 + 1, padded[1] // 2 + 1))
    lines = dst(coefficients[1:-1, 1:-1], type=1, axis=0)
    half[1:-1, 1:-1] = -dst(lines, type=1, axis=1)
    return _mirror(half, padded[0], sign=-1)


def mixed_transform(coefficients: Field, padded: tuple[int, int], odd_axis: int) -> Field:
    """Real part S of the half spectrum -i S of coefficients odd along one side, even along the
    other."""
    half = np.zeros((padded[0] // 2 + 1, padded[1] // 2 + 1))
    inner = (slice(1, -1), slice(None)) if odd_axis == 0 else (slice(None), slice(1, -1))
    half[inner] = dct(dst(coefficients[inner], type=1, axis=odd_axis), type=1, axis=1 - odd_axis)
    return _mirror(half, padded[0], sign=-1 if odd_axis == 0 else 1)


def _mirror(half: Field, length: int, sign: int) -> Field:
    """Add the negative wavenumbers along x to a quarter spectrum."""
    return np.concatenate([half, sign * half[length // 2 - 1 : 0 : -1]])


class NormalOperator:
    """u_z by pressure, both (nx, ny); one call is one convolution.

    symbols  real half spectrum of the zz coefficients
    inverse  roughly that of the inverse, with the unpadded period
    """

    def __init__(
        self,
        coefficients: InfluenceCoefficients,
        shape: tuple[int, int],
        counter: Convolutions,
    ) -> None:
        self._transform = PaddedTransform(shape, counter)
        reach = self._transform.reach
        zz = even_transform(coefficients.zz[reach], self._transform.padded)
        self.symbols = (zz,)
        # A film much stiffer than its base waves beyond the period, which turns some entries
        # negative; conjugate gradients need a positive preconditioner.
        size = np.abs(zz[::2, ::2])
        self.inverse = 1 / np.maximum(size, np.finfo(float).eps * np.max(size))

    def __call__(self, pressure: Field) -> Field:
        """Normal displacement caused by a pressure."""
        spectrum = self._transform.spectra()
        self._transform.forward(pressure, spectrum)
        spectrum *= self.symbols[0]
        return self._transform.inverse(spectrum)

    def precondition(self, displacement: Field) -> Field:
        """Roughly the pressure that causes a displacement.

        Divides by the spectrum of the coefficients repeated with the unpadded period: a quarter
        of the cost of a convolution, and near the inverse for all but the longest waves.
        """
        period = self._transform.period
        spectrum = np.fft.rfft2(displacement, period)
        spectrum *= self.inverse
        nx, ny = displacement.shape
        return np.fft.irfft2(spectrum, period)[:nx, :ny]


class TangentialOperator:
    """(u_x, u_y) by shear (q_x, q_y), each (2, nx, ny); one call is two convolutions.

    symbols  real half spectra of the xx, yy and xy coefficients
    inverse  roughly those of the inverse, with the unpadded period
    mean     of the xx and yy coefficients, with that period
    """

    def __init__(
        self,
        coefficients: InfluenceCoefficients,
        shape: tuple[int, int],
        counter: Convolutions,
    ) -> None:
        self.transform = PaddedTransform(shape, counter, components=2)
        reach, padded = self.transform.reach, self.transform.padded
        xx = even_transform(coefficients.xx[reach], padded)
        yy = even_transform(coefficients.yy[reach], padded)
        xy = odd_transform(coefficients.xy[reach], padded)
        self.symbols = xx, yy, xy
        self.inverse = _inverse_2x2(*(s[::2, ::2] for s in self.symbols))
        self.mean = np.abs(0.5 * (xx + yy)[::2, ::2])

    def __call__(self, shear: Field) -> Field:
        """Tangential displacement caused by a shear traction."""
        spectra = self.transform.spectra()
        self.transform.forward(shear, spectra)
        q_x, q_y = spectra
        xx, yy, xy = self.symbols
        across = xy * q_x
        q_x *= xx
        q_x += xy * q_y
        q_y *= yy
        q_y += across
        return self.transform.inverse(spectra)

    def precondition(self, displacement: Field) -> Field:
        """Roughly the shear that causes a tangential displacement, both (2, nx, ny)."""
        period = self.transform.period
        xx, yy, xy = self.inverse
        u_x, u_y = np.fft.rfft2(displacement, period)
        spectrum = np.stack([xx * u_x + xy * u_y, xy * u_x + yy * u_y])
        _, nx, ny = displacement.shape
        return np.fft.irfft2(spectrum, period)[:, :nx, :ny]


class CouplingOperator:
    """u_z by shear and (u_x, u_y) by pressure: what dissimilar bodies add; 1.5 convolutions each.

    symbols  real parts S of the half spectra -i S of the zx and zy coefficients

    The two are each other's transpose with the opposite sign of the coefficients: xz = -zx.
    """

    def __init__(
        self,
        coefficients: InfluenceCoefficients,
        shape: tuple[int, int],
        counter: Convolutions,
    ) -> None:
        self._transform = PaddedTransform(shape, counter)
        reach, padded = self._transform.reach, self._transform.padded
        self.symbols = (
            mixed_transform(coefficients.zx[reach], padded, odd_axis=0),
            mixed_transform(coefficients.zy[reach], padded, odd_axis=1),
        )

    def normal_by_shear(self, shear: Field) -> Field:
        """u_z (nx, ny) caused by a shear (2, nx, ny)."""
        u, q = self._transform.spectra(2)
        self._transform.forward(shear[0], u)
        self._transform.forward(shear[1], q)
        u *= self.symbols[0]
        q *= self.symbols[1]
        u += q
        u *= -1j
        return self._transform.inverse(u)

    def tangential_by_pressure(self, pressure: Field) -> Field:
        """(u_x, u_y), shape (2, nx, ny), caused by a pressure (nx, ny)."""
        u, p = self._transform.spectra(2)
        self._transform.forward(pressure, p)
        p *= 1j
        displacement = np.empty((2, *pressure.shape))
        for component, spectrum in zip(displacement, self.symbols, strict=True):
            np.multiply(p, spectrum, out=u)
            component[:] = self._transform.inverse(u)
        return displacement


def _inverse_2x2(xx: Field, yy: Field, xy: Field) -> tuple[Field, Field, Field]:
    """Inverse of the symmetric matrix [[xx, xy], [xy, yy]] at every wavenumber; where one is not
    positive definite, of the matrix with the magnitudes of its eigenvalues instead: films much
    stiffer than their base wave beyond the period, and conjugate gradients need a positive
    preconditioner."""
    mean, half = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    least = np.finfo(float).eps * np.max(mean + half)
    # By how much each eigenvalue is raised: exactly zero where it is positive.
    lower, upper = (np.maximum(np.abs(e), least) - e for e in (mean - half, mean + half))
    turned = 0.5 * (upper - lower) / np.where(half > 0, half, 1.0)
    raised = 0.5 * (upper + lower) - turned * mean
    xx, yy, xy = xx + raised + turned * xx, yy + raised + turned * yy, xy + turned * xy
    determinant = xx * yy - xy * xy
    return yy / determinant, xx / determinant, -xy / determinant
