"""Fourier spectra of influence coefficients on a zero-padded grid.

The coefficients are even or odd along each axis. Their transforms are therefore real or imaginary,
and even or odd. One quarter of a real array represents each transform.
"""

from dataclasses import dataclass

import numpy as np
from scipy.fft import dct, dst

from contact_scene.array_types import Field
from semi_analytical.influence.coefficients import InfluenceCoefficients


@dataclass(frozen=True)
class KernelSpectrum:
    """Real Fourier spectrum of influence coefficients; only non-negative wavenumbers are stored.

    quarter  (my + 1, mx + 1) values at non-negative wavenumbers along y and x
    mirror   parity along x, 1 or -1
    """

    quarter: Field
    mirror: int

    def __getitem__(self, columns: slice) -> Field:
        """Return the spectrum at some wavenumbers along y and all 2 mx wavenumbers along x.

        The shape is (number of columns, 2 mx).

        columns  slice of the wavenumbers along y
        """
        some = self.quarter[columns]
        return np.concatenate([some, self.mirror * some[:, -2:0:-1]], axis=1)


def kernel_spectrum(
    coefficients: InfluenceCoefficients, pair: str, reach: tuple[slice, slice]
) -> KernelSpectrum:
    """Compute the real Fourier spectrum S of the influence coefficients of two components.

    For the pairs xz and yz, whose coefficients are odd along one axis, the spectrum is -i S.

    pair   names of the two components in alphabetical order, e.g. "xz"
    reach  slices of the offsets along x and y that are transformed
    """
    if pair == "xy":
        return odd_transform(coefficients.xy[reach])
    if pair == "xz":
        return mixed_transform(coefficients.zx[reach], odd_axis=0)
    if pair == "yz":
        return mixed_transform(coefficients.zy[reach], odd_axis=1)
    even: Field = getattr(coefficients, pair)
    return even_transform(even[reach])


def even_transform(coefficients: Field) -> KernelSpectrum:
    """Transform influence coefficients that are even along both axes.

    coefficients  values at offsets 0 … m along each axis. The convolution does not use the last
                  offset; its true value makes the periodic continuation continuous, and the
                  spectrum of a positive kernel positive
    """
    return KernelSpectrum(dct(dct(coefficients.T, type=1, axis=1), type=1, axis=0), 1)


def odd_transform(coefficients: Field) -> KernelSpectrum:
    """Transform influence coefficients that are odd along both axes; the spectrum is real as
    (-i)^2 = -1."""
    quarter = np.zeros(coefficients.T.shape)
    lines = dst(coefficients[1:-1, 1:-1].T, type=1, axis=1)
    quarter[1:-1, 1:-1] = -dst(lines, type=1, axis=0)
    return KernelSpectrum(quarter, -1)


def mixed_transform(coefficients: Field, odd_axis: int) -> KernelSpectrum:
    """Transform influence coefficients that are odd along one axis and even along the other.

    The result is the real S; the Fourier spectrum is -i S.

    odd_axis  0 if odd along x, 1 if odd along y
    """
    quarter = np.zeros(coefficients.T.shape)
    odd, even = 1 - odd_axis, odd_axis  # transposed
    inner = (slice(1, -1), slice(None)) if odd == 0 else (slice(None), slice(1, -1))
    quarter[inner] = dct(dst(coefficients.T[inner], type=1, axis=odd), type=1, axis=even)
    return KernelSpectrum(quarter, -1 if odd_axis == 0 else 1)
