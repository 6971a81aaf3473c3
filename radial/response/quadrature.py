"""Gauss-Legendre quadrature and Legendre series on the interval 0 < t < 1."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre

from contact_scene.array_types import Array


@lru_cache(maxsize=64)
def unit_gauss(count: int) -> tuple[Array, Array]:
    """Return points and weights of Gauss-Legendre quadrature on the interval 0 < t < 1.

    The results are cached.

    count  number of points
    """
    points, weights = legendre.leggauss(count)
    return (1 + points) / 2, weights / 2


def evaluate_legendre(coefficients: Array, t: Array) -> Array:
    """Evaluate the Legendre series Σ c_l P_l(2t - 1) at points 0 ≤ t ≤ 1.

    coefficients  coefficients c_0, c_1, … of the Legendre polynomials P_l
    t             points (any shape)
    """
    return np.asarray(legendre.legval(2 * t - 1, coefficients))


def all_order_coefficients(coefficients: Array, first: int = 0) -> Array:
    """Return the coefficients of a Legendre series of all orders from those of even or odd orders.

    The other coefficients are 0. The result is evaluated with numpy's Legendre functions.

    coefficients  c_0, c_2, c_4, … or c_1, c_3, c_5, …
    first         0 for even orders, 1 for odd orders
    """
    every = np.zeros(2 * len(coefficients) - 1 + first)
    every[first::2] = coefficients
    return every
