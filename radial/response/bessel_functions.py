"""Bessel functions of many orders at the same arguments, by recurrence over the orders.

Upward recurrence is stable for orders below the argument. Beyond, the functions fall: their ratios
follow from the downward recurrence, which forgets its start (Gautschi 1967).
"""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil

import numpy as np
from scipy.special import j0, j1

from contact_scene.array_types import Array

# The downward recurrence of Bessel functions starts at this number of orders above the highest one,
# where J is negligible.
BEYOND = 32
# The ratio of spherical Bessel functions at d orders above the argument x is exp(-√(2d / x)), and
# each order reduces the error of the start by its square: by exp(-37) = 1e-16 over 7.3 x^(1/3)
# orders.
FORGOTTEN = 7.3


def bessel_functions(highest: int, at: Array) -> Iterator[Array]:
    """Yield the Bessel functions J_0, J_1, … J_M at given arguments, one array for each order.

    highest  highest order M
    at       arguments, at least 0 (any shape)
    """
    last, now = j0(at), j1(at)
    yield last
    if highest:
        yield now
    near = at < highest
    small, safe = at[near], np.maximum(at, 1.0)
    ratio, ratios = np.zeros_like(small), {}
    for m in range(highest + BEYOND, 1, -1):
        ratio = small / (2 * m - small * ratio)
        if m <= highest:
            ratios[m] = ratio
    for m in range(2, highest + 1):
        last, now = now, 2 * (m - 1) / safe * now - last
        now[near] = np.where(small < m, ratios[m] * last[near], now[near])
        yield now


def spherical_bessel_functions(count: int, places: Array) -> Array:
    """Compute the spherical Bessel functions j_n(x) of all orders n < count: (count, x).

        j_n+1 = (2n + 1) / x j_n - j_n-1    (Abramowitz and Stegun 10.1.19)

    count   number of orders
    places  arguments x > 0, (x,)
    """
    found = np.empty((count, len(places)))
    ratio = np.zeros(len(places))
    for order in range(count + ceil(FORGOTTEN * count ** (1 / 3)), 0, -1):
        ratio = np.where(places < order, places / (2 * order + 1 - places * ratio), 0.0)
        if order < count:
            found[order] = ratio
    found[0] = np.sin(places) / places
    if count > 1:
        first = (found[0] - np.cos(places)) / places
        found[1] = np.where(places < 1, found[1] * found[0], first)
    for order in range(2, count):
        upwards = (2 * order - 1) / places * found[order - 1] - found[order - 2]
        found[order] = np.where(places < order, found[order] * found[order - 1], upwards)
    return found
