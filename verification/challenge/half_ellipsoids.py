"""A traction that anybody can evaluate: half-ellipsoids times Chebyshev series.

    q(x, y) = Σ coef √(1 - s²) Σ c_k T_k(2 s² - 1),   s² = (x / b_x)² + (y / b_y)²

A Hertz pressure is one term, Cattaneo and Mindlin's shear two, a fretting loop two per branch, the
pressure on a coating one with a series.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

Field = NDArray[np.float64]

NODES = 64


@dataclass(frozen=True)
class Half:
    """One term.

    semi_axes    b_x, b_y [length]
    coefficient  of the traction [force/length²]
    series       c_0, c_1, …
    """

    semi_axes: tuple[float, float]
    coefficient: float
    series: tuple[float, ...] = (1.0,)

    def __call__(self, x: Field, y: Field) -> Field:
        """At positions [length]."""
        b_x, b_y = self.semi_axes
        s = np.minimum((x / b_x) ** 2 + (y / b_y) ** 2, 1.0)
        shape = np.sqrt(1 - s) * chebyshev.chebval(2 * s - 1, self.series)
        return np.asarray(self.coefficient * shape)

    @property
    def total(self) -> float:
        """Its integral [force]."""
        return self._integral(0)

    @property
    def spread(self) -> float:
        """Its integral times x² + y² [force*length²]."""
        return 0.5 * (self.semi_axes[0] ** 2 + self.semi_axes[1] ** 2) * self._integral(1)

    def _integral(self, power: int) -> float:
        """π b_x b_y ∫ s^(2 power) √(1 - s²) Σ c_k T_k ds²."""
        nodes, weights = np.polynomial.legendre.leggauss(NODES)
        root = 0.5 * (nodes + 1)  # √(1 - s²): smooth in it
        shape = 2 * root**2 * chebyshev.chebval(1 - 2 * root**2, self.series)
        shape *= (1 - root**2) ** power
        b_x, b_y = self.semi_axes
        return float(np.pi * b_x * b_y * self.coefficient * np.sum(0.5 * weights * shape))


@dataclass(frozen=True)
class HalfEllipsoids:
    """The sum of terms."""

    terms: tuple[Half, ...]

    def at(self, x: Field, y: Field) -> Field:
        """At positions [length]."""
        return np.asarray(sum(term(x, y) for term in self.terms))

    @property
    def total(self) -> float:
        """The force carried."""
        return sum(term.total for term in self.terms)

    @property
    def spread(self) -> float:
        """The force carried, times the square of its distance from the axis [force*length²]."""
        return sum(term.spread for term in self.terms)

    @property
    def semi_axes(self) -> tuple[float, float]:
        """Of the largest term, in which the others lie [length]."""
        return max(term.semi_axes for term in self.terms)

    def document(self) -> dict[str, Any]:
        """As it is written for others."""
        terms = [
            {"b": list(t.semi_axes), "coef": t.coefficient, "cheb": list(t.series)}
            for t in self.terms
        ]
        return {"halves": terms}


def round_halves(*terms: tuple[float, float]) -> HalfEllipsoids:
    """From radii and coefficients."""
    return HalfEllipsoids(tuple(Half((b, b), coefficient) for b, coefficient in terms))


def fitted(pressure: Callable[[Field], Field], radius: float, terms: int) -> HalfEllipsoids:
    """A round pressure with a square-root edge as one term with a series, by interpolation.

    pressure  at distances from the axis [force/length²]
    """
    t = chebyshev.chebpts1(terms)
    r = radius * np.sqrt(0.5 * (t + 1))
    scale = float(pressure(np.zeros(1))[0])
    values = pressure(r) / (scale * np.sqrt(0.5 * (1 - t)))
    series = chebyshev.chebfit(t, values, terms - 1)
    return HalfEllipsoids((Half((radius, radius), scale, tuple(float(c) for c in series)),))
