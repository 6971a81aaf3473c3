"""Gauss quadrature over dimensionless wavenumbers κ = k a, with the contact radius a.

A panel is an interval of κ with `POINTS` Gauss points. The positions of the panels do not depend on
the contact, only their number does. Contacts of different radii therefore share cached transforms.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil, floor, log
from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Array
from radial.response.array_cache import (
    MAX_CACHED,
    cache_within_bytes,
)
from radial.response.bessel_functions import spherical_bessel_functions
from radial.response.quadrature import unit_gauss

POINTS = 16
# Change of the phase of a wave over a panel: 16 Gauss points integrate the wave to 1e-14.
PHASE = 6.0
# Ratio of the ends of a panel near κ = 0, where only the response of the layers varies.
GROWTH = 3.0
# Contacts whose radii differ by less than this ratio share their panels.
SHARED = 1.25
MAX_AT_ONCE = 1 << 20  # numbers in a block of functions of the wavenumbers: 8 MiB


class Waves(NamedTuple):
    """Gauss quadrature over dimensionless wavenumbers κ = k a, with the contact radius a.

    The effect of layers on a contact is an integral over κ. The integration range is divided into
    intervals with Gauss points: first intervals that grow by a factor of 3, then intervals of equal
    width.

    first   exponent n of the end 3ⁿ of the first interval, which begins at 0
    widest  width of the equal intervals
    equal   number of the equal intervals
    """

    first: int
    widest: float
    equal: int

    @property
    @cache_within_bytes(MAX_CACHED)
    def rule(self) -> tuple[Array, Array]:
        """Gauss points κ and the weights of the quadrature over wavenumbers, each (n,).

        κ = k a is the wavenumber k times the contact radius a. Integrals over κ give the
        contributions of layers to displacement and pressure.
        """
        last = floor(log(self.widest) / log(GROWTH))
        growing = GROWTH ** np.arange(self.first, last + 1.0)
        equal = growing[-1] + self.widest * np.arange(1.0, self.equal + 1)
        edges = np.concatenate([[0.0], growing, equal])
        widths = np.diff(edges)[:, None]
        points, weights = unit_gauss(POINTS)
        return (edges[:-1, None] + widths * points).ravel(), (widths * weights).ravel()

    @cache_within_bytes(MAX_CACHED)
    def even_transforms(self, count: int) -> Array:
        """Compute the cosine transforms of even Legendre polynomials at all wavenumbers (count, κ).

            ∫₀¹ P_2n(t) cos κt dt = (-1)ⁿ j_2n(κ),    n < count

        j is the spherical Bessel function (Abramowitz and Stegun 10.1.14). The contribution of
        layers to the pressure is a series of these polynomials. The results are cached.

        count  number of polynomials
        """
        places = self.rule[0]
        found = np.empty((count, len(places)))
        for some in wave_blocks(len(places), 2 * count):
            found[:, some] = spherical_bessel_functions(2 * count - 1, places[some])[::2]
        found[1::2] *= -1
        return found

    def legendre_transform(self, coefficients: Array) -> Array:
        """Compute the cosine transform of a Legendre series f on 0 < t < 1 at all wavenumbers κ.

            ∫₀¹ f(t) cos κt dt = Σ c_l Re iˡ exp(iκ/2) j_l(κ/2),    f = Σ c_l P_l(2t - 1)

        j_l is the spherical Bessel function. The shape is (κ,). Used for the Abel transform of the
        undeformed gap.

        coefficients  coefficients c_0, c_1, … of f
        """
        count = 8 * ceil(len(coefficients) / 8)
        return np.asarray(coefficients @ self._legendre_transforms(count)[: len(coefficients)])

    @cache_within_bytes(MAX_CACHED)
    def _legendre_transforms(self, count: int) -> Array:
        """Compute ∫₀¹ P_l(2t - 1) cos κt dt = Re iˡ exp(iκ/2) j_l(κ/2),
        l < count, with the spherical Bessel function j (count, κ)."""
        half = self.rule[0] / 2
        turns = np.arange(count)[:, None] * np.pi / 2
        found = np.empty((count, len(half)))
        for some in wave_blocks(len(half), 2 * count):
            part = half[some]
            found[:, some] = np.cos(turns + part) * spherical_bessel_functions(count, part)
        return found


def waves(shortest: float, longest: float, reach: float, fineness: int = 1) -> Waves:
    """Choose the quadrature over wavenumbers that resolves all waves between two wavenumbers.

    Wavenumbers κ are multiplied by the contact radius. The quadrature consists of intervals with
    Gauss points. Similar wavenumbers give equal quadratures, which share cached transforms.

    shortest  κ of the shortest wave, at which the intervals end
    longest   κ of the longest wave, near which the first interval ends
    reach     largest distance of the points of evaluation from the axis, over the contact radius; a
              larger distance requires narrower intervals
    fineness  factor on the number of points, 1 by default
    """
    widest = PHASE / (1 + reach) / fineness
    first = floor(log(min(longest, widest)) / log(GROWTH))
    return Waves(first, widest, ceil(SHARED ** ceil(log(shortest / widest, SHARED))))


def wave_blocks(count: int, size: int) -> Iterator[slice]:
    """Yield slices of an array of wavenumbers, to evaluate large functions of them in blocks.

    The values of the functions on one slice take about 8 MiB.

    count  number of wavenumbers
    size   number of values of the functions for each wavenumber
    """
    step = max(MAX_AT_ONCE // size, 1)
    for start in range(0, count, step):
        yield slice(start, start + step)
