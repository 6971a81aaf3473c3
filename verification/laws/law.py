"""Mechanical laws that every surface frequency response function (FRF) of layered bodies satisfies.

The FRF is the surface displacement per unit traction in Fourier space. The module has the
definition of a law, its evaluation for random bodies, and the distributions of these bodies.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator
from numpy.typing import ArrayLike, NDArray

from semi_analytical.frf.stack import Film, HalfSpace, Stack
from semi_analytical.frf.surface import SurfaceScalars, scalars

SEED = 20_240_511
DRAWS = 200
# Accepted rounding error of one evaluation, relative to the largest entry. The FRFs have errors of
# about 1e-15.
ROUNDING = 1e-14


@dataclass(frozen=True)
class Law:
    """Law of the surface FRF and the function that measures its violation.

    name       name of the verdict on the law
    number     number in the list of properties, P1 to P20
    statement  law in words
    violation  function from a random generator to the relative violation of one random body
    allowed    accepted violation, due to rounding or to the next order of the law
    draws      number of random bodies
    """

    name: str
    number: str
    statement: str
    violation: Callable[[Generator], float]
    allowed: float = ROUNDING
    draws: int = DRAWS


def worst_violation(law: Law) -> float:
    """Compute the largest violation of a law of the FRF over its random bodies; NaN if any is NaN.

    The random bodies are equal in every call.
    """
    rng = np.random.default_rng([SEED, *law.name.encode()])
    return float(np.max([law.violation(rng) for _ in range(law.draws)]))


def apart(F: NDArray[np.complex128], expected: NDArray[np.complex128]) -> float:
    """Compute the largest difference of two FRF matrices, over the largest entry of the second
    [1]."""
    return float(np.abs(F - expected).max() / np.abs(expected).max())


def deficit(larger: NDArray[np.complex128], smaller: NDArray[np.complex128]) -> float:
    """Compute the relative violation of the matrix inequality larger - smaller >= 0 (Loewner
    order).

    The result is the magnitude of the most negative eigenvalue of the difference, over the largest
    entry; 0 if the inequality holds.
    """
    least = float(np.linalg.eigvalsh(larger - smaller).min())
    return max(0.0, -least / float(np.abs(larger).max()))


def frf_matrix(stack: Stack, m: ArrayLike, n: ArrayLike) -> NDArray[np.complex128]:
    """Compute the FRF matrix of the surface of one body, for fields exp(+i(m x + n y)).

    The z axis points into the body. The result has the shape (..., 3, 3): row = displacement (x, y,
    z), column = traction (q_x, q_y, p) [length^3/force]. It is Hermitian and positive definite.

    m, n  wavenumbers along x and y [1/length], broadcast together, not both zero
    """
    m, n = _wave_vector(m, n)
    return rotated(scalars(stack, np.hypot(m, n)), m, n)


def composite_frf_matrix(
    lower: Stack, upper: Stack, m: ArrayLike, n: ArrayLike
) -> NDArray[np.complex128]:
    """Compute the FRF matrix of the relative displacement of two bodies, F1 + J F2 J, J = diag(1,
    1, -1).

    Tractions act on the lower body. Arguments and result are those of `frf_matrix`.
    """
    m, n = _wave_vector(m, n)
    alpha = np.hypot(m, n)
    return rotated(combined(scalars(lower, alpha), scalars(upper, alpha)), m, n)


def combined(lower: SurfaceScalars, upper: SurfaceScalars) -> SurfaceScalars:
    """Combine the FRF scalars of two bodies: the coupling scalar is subtracted, the others are
    added."""
    signs = (1, -1, 1, 1)
    return SurfaceScalars(*(a + sign * b for a, sign, b in zip(lower, signs, upper, strict=True)))


def rotated(
    response: SurfaceScalars, m: NDArray[np.float64], n: NDArray[np.float64]
) -> NDArray[np.complex128]:
    """Convert FRF scalars to the matrix (..., 3, 3) for displacements and tractions along x, y and
    z.

    response  scalars in the frame of the wave vector
    m, n      wavenumbers along x and y [1/length]
    """
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
    """Broadcast the wavenumbers along x and y to arrays of one shape."""
    m, n = np.broadcast_arrays(np.asarray(m, np.float64), np.asarray(n, np.float64))
    return m, n


SPECIAL_RATIOS = (0.0, 0.3, 0.5)


def decades(rng: Generator, low: float, high: float) -> float:
    """Draw a random number between 10^low and 10^high, whose logarithm is uniformly distributed."""
    return float(10 ** rng.uniform(low, high))


def half_space(rng: Generator) -> HalfSpace:
    """Draw a random material: shear modulus between 1e-3 and 1e3, ν between -0.95 and exactly
    1/2."""
    ratio = rng.choice(SPECIAL_RATIOS) if rng.random() < 0.3 else rng.uniform(-0.95, 0.5)
    return HalfSpace(decades(rng, -3, 3), float(ratio))


def film(rng: Generator) -> Film:
    """Draw a random layer with a thickness between 1e-2 and 1e2."""
    return Film(*half_space(rng), decades(rng, -2, 2))


def stack(rng: Generator, most_layers: int = 5) -> Stack:
    """Draw a random layered body: one to five layers on a half-space or, in 1/4 of the draws, a
    rigid base."""
    films = [film(rng) for _ in range(rng.integers(1, most_layers, endpoint=True))]
    return Stack(films, None if rng.random() < 0.25 else half_space(rng))


def wave_vector(rng: Generator) -> tuple[float, float]:
    """Draw a random wave vector of any direction, with a wavenumber between 1e-4 and 1e4."""
    alpha, angle = decades(rng, -4, 4), rng.uniform(-np.pi, np.pi)
    return float(alpha * np.cos(angle)), float(alpha * np.sin(angle))
