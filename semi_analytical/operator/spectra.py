"""Spectra of influence coefficients on a zero-padded grid.

The coefficients are even or odd along each side, so their transforms are purely real or purely
imaginary, and even or odd themselves: a quarter of one real array stores each.
"""

from dataclasses import dataclass

import numpy as np
from scipy.fft import dct, dst

from contact_scene.array_types import Field
from semi_analytical.influence.coefficients import InfluenceCoefficients


@dataclass(frozen=True)
class KernelSpectrum:
    """Real half spectrum of coefficients; its columns are wavenumbers along y, none negative.

    quarter  (my + 1, mx + 1) at the wavenumbers along y and x that are not negative
    mirror   1 or -1, by how much it changes with the sign of that along x
    """

    quarter: Field
    mirror: int

    def __getitem__(self, columns: slice) -> Field:
        """At some wavenumbers along y and all 2 mx along x, (columns, 2 mx)."""
        some = self.quarter[columns]
        return np.concatenate([some, self.mirror * some[:, -2:0:-1]], axis=1)


def kernel_spectrum(
    coefficients: InfluenceCoefficients, pair: str, reach: tuple[slice, slice]
) -> KernelSpectrum:
    """Transform the coefficients of two components, in alphabetical order, at the offsets in reach:
    S, where the spectrum of zx and zy is -i S."""
    if pair == "xy":
        return odd_transform(coefficients.xy[reach])
    if pair == "xz":
        return mixed_transform(coefficients.zx[reach], odd_axis=0)
    if pair == "yz":
        return mixed_transform(coefficients.zy[reach], odd_axis=1)
    even: Field = getattr(coefficients, pair)
    return even_transform(even[reach])


def even_transform(coefficients: Field) -> KernelSpectrum:
    """Of coefficients that are even along both sides.

    coefficients  at offsets 0 … m along each side. The last offset is never read by the
                  convolution; with its true value the periodic continuation is continuous, and
                  the spectrum of a positive kernel is positive.
    """
    return KernelSpectrum(dct(dct(coefficients.T, type=1, axis=1), type=1, axis=0), 1)


def odd_transform(coefficients: Field) -> KernelSpectrum:
    """Of coefficients that are odd along both sides: (-i)^2 is real."""
    quarter = np.zeros(coefficients.T.shape)
    lines = dst(coefficients[1:-1, 1:-1].T, type=1, axis=1)
    quarter[1:-1, 1:-1] = -dst(lines, type=1, axis=0)
    return KernelSpectrum(quarter, -1)


def mixed_transform(coefficients: Field, odd_axis: int) -> KernelSpectrum:
    """S, of coefficients odd along one side, even along the other, whose spectrum is -i S."""
    quarter = np.zeros(coefficients.T.shape)
    odd, even = 1 - odd_axis, odd_axis  # transposed
    inner = (slice(1, -1), slice(None)) if odd == 0 else (slice(None), slice(1, -1))
    quarter[inner] = dct(dst(coefficients.T[inner], type=1, axis=odd), type=1, axis=even)
    return KernelSpectrum(quarter, -1 if odd_axis == 0 else 1)
