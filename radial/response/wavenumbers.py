"""Gauss quadrature over wavenumbers κ = k a, in units of the inverse contact radius.

The positions of the panels do not depend on the contact, only their number does. Contacts of
different radii therefore share cached transforms.
"""

from __future__ import annotations

from functools import lru_cache
from math import ceil, floor, log
from typing import NamedTuple

import numpy as np
from scipy.special import spherical_jn

from contact_scene.array_types import Array
from radial.response.array_cache import (
    MAX_CACHED,
    cached_within,
)
from radial.response.quadrature import unit_gauss

POINTS = 16
# Change of phase over a panel: 16 points integrate it to 1e-14.
PHASE = 6.0
# Ratio of the ends of a panel near zero, where only the response varies.
GROWTH = 3.0
# Contacts with radii within this ratio share their panels.
SHARED = 1.25
# Number of cached quadratures. A solve needs two; more than a few contacts exceed the processor
# cache.
CACHED = 8


class Waves(NamedTuple):
    """Panels: the first ends at GROWTH^first, `equal` panels have the largest width `widest`."""

    first: int
    widest: float
    equal: int

    @property
    def rule(self) -> tuple[Array, Array]:
        """Return points (n,) and weights."""
        return _rule(self)

    def even_transforms(self, count: int) -> Array:
        """Return ∫₀¹ P_2n(t) cos κt dt = (-1)ⁿ j_2n(κ) for n < count, shape (count, n) (Abramowitz
        and Stegun 10.1.14)."""
        return _even_transforms(self, count)

    def shifted_transform(self, coefficients: Array) -> Array:
        """Return ∫₀¹ f(t) cos κt dt = Σ c_l Re iˡ exp(iκ/2) j_l(κ/2) of f = Σ c_l P_l(2t - 1),
        shape (n,)."""
        count = 8 * ceil(len(coefficients) / 8)
        return np.asarray(coefficients @ _shifted_transforms(self, count)[: len(coefficients)])


def waves(shortest: float, longest: float, reach: float, fineness: int = 1) -> Waves:
    """Return panels between two wavenumbers, for positions within `reach` radii.

    shortest, longest  κ of the shortest and the longest wave
    fineness           multiple of the number of points
    """
    widest = PHASE / (1 + reach) / fineness
    first = floor(log(min(longest, widest)) / log(GROWTH))
    return Waves(first, widest, ceil(SHARED ** ceil(log(shortest / widest, SHARED))))


@lru_cache(maxsize=CACHED)
def _rule(chosen: Waves) -> tuple[Array, Array]:
    last = floor(log(chosen.widest) / log(GROWTH))
    growing = GROWTH ** np.arange(chosen.first, last + 1.0)
    equal = growing[-1] + chosen.widest * np.arange(1.0, chosen.equal + 1)
    edges = np.concatenate([[0.0], growing, equal])
    widths = np.diff(edges)[:, None]
    points, weights = unit_gauss(POINTS)
    return (edges[:-1, None] + widths * points).ravel(), (widths * weights).ravel()


@cached_within(MAX_CACHED)
def _even_transforms(chosen: Waves, count: int) -> Array:
    places = chosen.rule[0]
    found = np.empty((count, len(places)))
    near = places < 2 * count
    for order in range(count):
        found[order, near] = spherical_jn(2 * order, places[near])
    far = places[~near]
    # The upward recurrence is stable for orders below the argument.
    last, now = spherical_jn(0, far), spherical_jn(1, far)
    for order in range(count):
        found[order, ~near] = last
        last = (4 * order + 3) / far * now - last
        now = (4 * order + 5) / far * last - now
    found[1::2] *= -1
    return found


@cached_within(MAX_CACHED)
def _shifted_transforms(chosen: Waves, count: int) -> Array:
    half = chosen.rule[0] / 2
    found = np.empty((count, len(half)))
    for order, row in enumerate(found):
        row[:] = np.cos(order * np.pi / 2 + half) * spherical_jn(order, half)
    return found
