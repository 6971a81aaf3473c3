"""Fourier spectra of influence coefficients on a zero-padded grid, for convolutions.

The coefficients are even or odd along each axis. Their transforms are therefore real or imaginary,
and even or odd. One quarter of a real array represents each transform.
"""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field
from semi_analytical.operator.transforms import cosine_or_sine_sums


@dataclass(frozen=True)
class KernelSpectrum:
    """Real Fourier spectrum of influence coefficients; only non-negative wavenumbers are stored.

    quarter  values at non-negative wavenumbers along y and x (my + 1, mx + 1)
    mirror   parity of the coefficients along x: 1 even, -1 odd
    """

    quarter: Field
    mirror: int

    def __getitem__(self, columns: slice) -> Field:
        """Return the spectrum at some wavenumbers along y and at all wavenumbers along x.

        The shape is (number of columns, 2 mx), with both signs of the wavenumber along x.

        columns  slice of the wavenumbers along y
        """
        some = self.quarter[columns]
        return np.concatenate([some, self.mirror * some[:, -2:0:-1]], axis=1)


def kernel_spectrum(
    values: Field, parity: tuple[int, int], reach: tuple[slice, slice]
) -> KernelSpectrum:
    """Compute the real spectrum S of influence coefficients, even or odd along each axis.

    The Fourier spectrum is S if both parities are equal, else -i S. The convolution does not use
    the last offset; its true value makes the periodic continuation of even kernels continuous, and
    the spectrum of a positive kernel positive.

    values  influence coefficients at offsets 0 … m along each axis
    parity  parity along x and y: 1 even, -1 odd
    reach   slices of the offsets along x and y that are transformed
    """
    x, y = parity
    quarter = cosine_or_sine_sums(cosine_or_sine_sums(values[reach], y).T, x)
    return KernelSpectrum(-quarter if x == y == -1 else quarter, x)
