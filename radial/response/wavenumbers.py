"""Gauss's rule over wavenumbers, in units of the inverse contact radius: κ = k a.

Its panels do not depend on the contact, only how many of them are taken does, so that contacts of
all radii have the transforms on them in common.
"""

from __future__ import annotations

from functools import lru_cache
from math import ceil, floor, log
from typing import NamedTuple

import numpy as np
from scipy.special import spherical_jn

from contact_scene.array_types import Array
from radial.response.array_cache import (
    MAX_KEPT,
    kept_within,
)
from radial.response.quadrature import unit_gauss

POINTS = 16
# What oscillates by so much over a panel is integrated to 1e-14 by 16 points.
PHASE = 6.0
# Width of a panel over its distance from zero, where the response varies and not the transforms.
GROWTH = 3.0
# Contacts whose radii differ by less have their panels in common.
SHARED = 1.25
# What fits into the processor's cache of a few contacts; a solve needs two of each.
KEPT = 8


class Waves(NamedTuple):
    """Which panels: the first ends at GROWTH^first, none is wider than `widest`, and there are
    `equal` of that width."""

    first: int
    widest: float
    equal: int

    @property
    def rule(self) -> tuple[Array, Array]:
        """Points (n,) and weights."""
        return _rule(self)

    def even_transforms(self, count: int) -> Array:
        """∫₀¹ P_2n(t) cos κt dt = (-1)ⁿ j_2n(κ) for n < count, shape (count, n)
        (Abramowitz and Stegun 10.1.14)."""
        return _even_transforms(self, count)

    def shifted_transform(self, coefficients: Array) -> Array:
        """∫₀¹ f(t) cos κt dt (n,) of f = Σ c_l P_l(2t - 1): Σ c_l Re iˡ exp(iκ/2) j_l(κ/2)."""
        count = 8 * ceil(len(coefficients) / 8)
        return np.asarray(coefficients @ _shifted_transforms(self, count)[: len(coefficients)])


def waves(shortest: float, longest: float, reach: float, fineness: int = 1) -> Waves:
    """Panels for all that varies between two wavenumbers, over places within `reach` radii.

    fineness  how many times as many points as it takes
    """
    widest = PHASE / (1 + reach) / fineness
    first = floor(log(min(longest, widest)) / log(GROWTH))
    return Waves(first, widest, ceil(SHARED ** ceil(log(shortest / widest, SHARED))))


@lru_cache(maxsize=KEPT)
def _rule(chosen: Waves) -> tuple[Array, Array]:
    last = floor(log(chosen.widest) / log(GROWTH))
    growing = GROWTH ** np.arange(chosen.first, last + 1.0)
    equal = growing[-1] + chosen.widest * np.arange(1.0, chosen.equal + 1)
    edges = np.concatenate([[0.0], growing, equal])
    widths = np.diff(edges)[:, None]
    points, weights = unit_gauss(POINTS)
    return (edges[:-1, None] + widths * points).ravel(), (widths * weights).ravel()


@kept_within(MAX_KEPT)
def _even_transforms(chosen: Waves, count: int) -> Array:
    places = chosen.rule[0]
    found = np.empty((count, len(places)))
    near = places < 2 * count
    for order in range(count):
        found[order, near] = spherical_jn(2 * order, places[near])
    far = places[~near]
    # Upward recurrence, which is stable as long as the order is below the argument.
    last, now = spherical_jn(0, far), spherical_jn(1, far)
    for order in range(count):
        found[order, ~near] = last
        last = (4 * order + 3) / far * now - last
        now = (4 * order + 5) / far * last - now
    found[1::2] *= -1
    return found


@kept_within(MAX_KEPT)
def _shifted_transforms(chosen: Waves, count: int) -> Array:
    half = chosen.rule[0] / 2
    found = np.empty((count, len(half)))
    for order, row in enumerate(found):
        row[:] = np.cos(order * np.pi / 2 + half) * spherical_jn(order, half)
    return found
