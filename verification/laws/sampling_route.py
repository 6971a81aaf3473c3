"""Errors of influence coefficients of a coated body that are computed from samples of its FRF.

The usual method multiplies the FRF by the transform of one loaded cell, samples the product and
transforms back. It has two parameters: samples per cell side, against aliasing of short waves, and
the period over the window, against images of the load. The result is compared with the exact
coefficients, which have no parameter.
"""

from dataclasses import dataclass
from math import asinh

import numpy as np
from numpy.typing import NDArray

from semi_analytical.frf.stack import Stack
from semi_analytical.frf.surface import SurfaceScalars, scalars
from semi_analytical.influence.layered import LayeredCoefficients

Field = NDArray[np.float64]
Coefficients = tuple[Field, Field]


@dataclass(frozen=True)
class SamplingErrors:
    """Errors of sampled coefficients, signed and relative to the exact coefficient.

    own         normal displacement of the loaded cell
    neighbour   of the next cell along x
    far         of the last cell of the window along x
    far_shape   of the last cell, after subtraction of the difference at half that distance as a
                constant, like a free rigid approach
    coupling    normal displacement by shear: largest error over largest coefficient; zero without
                coupling
    """

    own: float
    neighbour: float
    far: float
    far_shape: float
    coupling: float


def sampling_errors(
    stack: Stack, spacing: float, cells: int, refinement: int, extension: int
) -> SamplingErrors:
    """Compute the errors of sampled coefficients for a square window of square cells.

    spacing     cell side [length]
    cells       cells along each side of the window
    refinement  samples per cell side, >= 1
    extension   period over window, >= 2 to keep the images out of the window
    """
    exact = LayeredCoefficients(stack, (spacing, spacing), (cells, cells))
    sampled = sampled_coefficients(stack, spacing, cells, refinement, extension)
    return errors_between(sampled, (exact.zz, exact.zx))


def errors_between(sampled: Coefficients, exact: Coefficients) -> SamplingErrors:
    """Compute the errors of the coefficients (zz, zx) at offsets (i, j) of a square window."""
    (zz, zx), (exact_zz, exact_zx) = sampled, exact
    error, coefficient = (zz - exact_zz)[:, 0], exact_zz[:, 0]
    relative = error / coefficient
    largest = np.abs(exact_zx).max()
    return SamplingErrors(
        own=float(relative[0]),
        neighbour=float(relative[1]),
        far=float(relative[-1]),
        far_shape=float((error[-1] - error[len(error) // 2]) / coefficient[-1]),
        coupling=float(np.abs(zx - exact_zx).max() / largest) if largest > 0 else 0.0,
    )


def sampled_coefficients(
    stack: Stack, spacing: float, cells: int, refinement: int, extension: int
) -> tuple[Field, Field]:
    """Compute the coefficients (zz, zx) at offsets (i, j) < cells by an inverse FFT of the
    sampled FRF."""
    step = spacing / refinement
    count = cells * extension * refinement
    m = 2 * np.pi * np.fft.fftfreq(count, step)[:, None]
    n = 2 * np.pi * np.fft.rfftfreq(count, step)[None, :]
    alpha = np.hypot(m, n)
    alpha[0, 0] = 1.0  # has no response: replaced below
    response = scalars(stack, alpha)
    normal = response.c22
    normal[0, 0] = _mean_about_zero(stack, 2 * np.pi / (count * step)).c22
    # f_zx = -i (m / alpha) C12; the shortest wave along x has no partner of the other sign.
    coupling = -1j * m / alpha * response.c12
    if count % 2 == 0:
        coupling[count // 2] = 0
    load = np.sinc(m * spacing / (2 * np.pi)) * np.sinc(n * spacing / (2 * np.pi))
    chosen = slice(0, cells * refinement, refinement)
    shape = (count, count)
    zz, zx = (
        np.fft.irfft2(frf * load, shape)[chosen, chosen] * refinement**2
        for frf in (normal, coupling)
    )
    return zz, zx


def _mean_about_zero(stack: Stack, width: float) -> SurfaceScalars:
    """Compute the mean of the FRF over the square of one sample about alpha = 0.

    For long waves the FRF is a constant over alpha; the mean is 4 asinh(1) / width of the constant.
    """
    alpha = 1e-6 * width
    return SurfaceScalars(*(4 * asinh(1) / width * alpha * c for c in scalars(stack, alpha)))
