"""Gauss quadrature and Legendre polynomials on 0 < t < 1."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre

from contact_scene.array_types import Array


@lru_cache(maxsize=64)
def unit_gauss(count: int) -> tuple[Array, Array]:
    """Return points and weights."""
    points, weights = legendre.leggauss(count)
    return (1 + points) / 2, weights / 2


def shifted(coefficients: Array, t: Array) -> Array:
    """Return Σ c_l P_l(2t - 1)."""
    return np.asarray(legendre.legval(2 * t - 1, coefficients))


def every_order(coefficients: Array) -> Array:
    """Return the coefficients of all P_l(t) from those of even l."""
    every = np.zeros(2 * len(coefficients) - 1)
    every[::2] = coefficients
    return every
