"""Tractions to displacements, by convolution, and roughly back."""

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from semi_analytical.influence.coefficients import InfluenceCoefficients
from semi_analytical.kernel_spectrum import (
    KernelSpectrum,
    even_transform,
    mixed_transform,
    odd_transform,
)
from semi_analytical.padded_transform import Convolutions, PaddedTransform, Spectrum

Field = NDArray[np.float64]


class NormalOperator:
    """u_z by pressure, both (nx, ny); one call is one convolution.

    symbols  spectrum of the zz coefficients
    """

    def __init__(
        self,
        coefficients: InfluenceCoefficients,
        shape: tuple[int, int],
        counter: Convolutions,
    ) -> None:
        self._transform = PaddedTransform(shape, counter)
        self.symbols = normal_spectra(coefficients, self._transform.reach)

    @cached_property
    def inverse(self) -> Field:
        """Roughly the spectrum of the inverse, with the unpadded period."""
        return positive_inverse(self.symbols[0].unpadded())

    def __call__(self, pressure: Field) -> Field:
        """Normal displacement caused by a pressure."""
        return self._transform.convolved(pressure[None], 1, self._multiplied)[0]

    def _multiplied(self, spectra: Spectrum, columns: slice) -> Spectrum:
        spectra *= self.symbols[0][columns]
        return spectra

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

    symbols  spectra of the xx, yy and xy coefficients
    """

    def __init__(
        self,
        coefficients: InfluenceCoefficients,
        shape: tuple[int, int],
        counter: Convolutions,
    ) -> None:
        self.transform = PaddedTransform(shape, counter)
        self.symbols = tangential_spectra(coefficients, self.transform.reach)

    @property
    def inverse(self) -> tuple[Field, Field, Field]:
        """Roughly the spectra of the inverse, xx, yy and xy, with the unpadded period."""
        xx, yy, xy = (symbol.unpadded() for symbol in self.symbols)
        return inverse_2x2(xx, yy, xy)

    def mean(self) -> Field:
        """Of the spectra of the xx and yy coefficients, with the unpadded period."""
        xx, yy, _ = self.symbols
        return np.abs(0.5 * (xx.unpadded() + yy.unpadded()))

    def __call__(self, shear: Field) -> Field:
        """Tangential displacement caused by a shear traction."""
        return self.transform.convolved(shear, 2, self._multiplied)

    def _multiplied(self, spectra: Spectrum, columns: slice) -> Spectrum:
        q_x, q_y = spectra
        xx, yy, xy = (symbol[columns] for symbol in self.symbols)
        across = xy * q_x
        q_x *= xx
        q_x += xy * q_y
        q_y *= yy
        q_y += across
        return spectra


class CouplingOperator:
    """u_z by shear and (u_x, u_y) by pressure: what dissimilar bodies add; 1.5 convolutions each.

    symbols  S of the spectra -i S of the zx and zy coefficients

    The two are each other's transpose with the opposite sign of the coefficients: xz = -zx.
    """

    def __init__(
        self,
        coefficients: InfluenceCoefficients,
        shape: tuple[int, int],
        counter: Convolutions,
    ) -> None:
        self._transform = PaddedTransform(shape, counter)
        self.symbols = coupling_spectra(coefficients, self._transform.reach)

    def normal_by_shear(self, shear: Field) -> Field:
        """u_z (nx, ny) caused by a shear (2, nx, ny)."""
        return self._transform.convolved(shear, 1, self._by_shear)[0]

    def tangential_by_pressure(self, pressure: Field) -> Field:
        """(u_x, u_y), shape (2, nx, ny), caused by a pressure (nx, ny)."""
        return self._transform.convolved(pressure[None], 2, self._by_pressure)

    def _by_shear(self, spectra: Spectrum, columns: slice) -> Spectrum:
        u, q = spectra
        u *= self.symbols[0][columns]
        q *= self.symbols[1][columns]
        u += q
        u *= -1j
        return spectra[:1]

    def _by_pressure(self, spectra: Spectrum, columns: slice) -> Spectrum:
        p = 1j * spectra[0]
        return np.stack([p * symbol[columns] for symbol in self.symbols])


def normal_spectra(
    coefficients: InfluenceCoefficients, reach: tuple[slice, slice]
) -> tuple[KernelSpectrum, ...]:
    """Of the zz coefficients, at so many offsets."""
    return (even_transform(coefficients.zz[reach]),)


def tangential_spectra(
    coefficients: InfluenceCoefficients, reach: tuple[slice, slice]
) -> tuple[KernelSpectrum, ...]:
    """Of the xx, yy and xy coefficients."""
    return (
        even_transform(coefficients.xx[reach]),
        even_transform(coefficients.yy[reach]),
        odd_transform(coefficients.xy[reach]),
    )


def coupling_spectra(
    coefficients: InfluenceCoefficients, reach: tuple[slice, slice]
) -> tuple[KernelSpectrum, ...]:
    """S of those of the zx and zy coefficients, -i S."""
    return (
        mixed_transform(coefficients.zx[reach], odd_axis=0),
        mixed_transform(coefficients.zy[reach], odd_axis=1),
    )


def positive_inverse(spectrum: Field) -> Field:
    """Roughly the inverse of a spectrum. A film much stiffer than its base waves beyond the period,
    which turns some entries negative; conjugate gradients need a positive preconditioner."""
    size = np.abs(spectrum)
    return np.asarray(1 / np.maximum(size, np.finfo(float).eps * np.max(size)))


def inverse_2x2(xx: Field, yy: Field, xy: Field) -> tuple[Field, Field, Field]:
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
