"""The 3x3 surface FRF in the axes of the scene."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from semi_analytical.frf.stack import Stack
from semi_analytical.frf.surface import SurfaceScalars, scalars


def frf_matrix(stack: Stack, m: ArrayLike, n: ArrayLike) -> NDArray[np.complex128]:
    """FRF of one body whose z axis points into it, fields varying as exp(+i(m x + n y)).

    m, n     wavenumbers along x and y [1/length], broadcast together, not both zero
    returns  (..., 3, 3): row = displacement (x, y, z), column = traction (q_x, q_y, p)
             [length^3/force]; Hermitian, positive definite
    """
    m, n = _wave_vector(m, n)
    return rotated(scalars(stack, np.hypot(m, n)), m, n)


def composite_frf_matrix(
    lower: Stack, upper: Stack, m: ArrayLike, n: ArrayLike
) -> NDArray[np.complex128]:
    """FRF of the relative displacement of two bodies, F1 + J F2 J with J = diag(1, 1, -1).

    Tractions are those on the lower body; see `frf_matrix` for the rest.
    """
    m, n = _wave_vector(m, n)
    alpha = np.hypot(m, n)
    return rotated(combined(scalars(lower, alpha), scalars(upper, alpha)), m, n)


def combined(lower: SurfaceScalars, upper: SurfaceScalars) -> SurfaceScalars:
    """Scalars of the relative displacement of two bodies: coupling subtracts, the rest adds."""
    signs = (1, -1, 1, 1)
    return SurfaceScalars(*(a + sign * b for a, sign, b in zip(lower, signs, upper, strict=True)))


def rotated(
    response: SurfaceScalars, m: NDArray[np.float64], n: NDArray[np.float64]
) -> NDArray[np.complex128]:
    """Scalars of the frame along the wave vector, turned into the axes of the scene."""
    alpha = np.hypot(m, n)
    mm, nn = m / alpha, n / alpha
    c11, c12, c22, csh = response
    F = np.empty((*alpha.shape, 3, 3), dtype=np.complex128)
    F[..., 0, 0] = mm * mm * c11 + nn * nn * csh
    F[..., 1, 1] = nn * nn * c11 + mm * mm * csh
    F[..., 0, 1] = F[..., 1, 0] = mm * nn * (c11 - csh)
    F[..., 2, 2] = c22
    F[..., 0, 2] = 1j * mm * c12
    F[..., 1, 2] = 1j * nn * c12
    F[..., 2, 0] = -F[..., 0, 2]
    F[..., 2, 1] = -F[..., 1, 2]
    return F


def _wave_vector(m: ArrayLike, n: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Both components, of one shape."""
    m, n = np.broadcast_arrays(np.asarray(m, np.float64), np.asarray(n, np.float64))
    return m, n
