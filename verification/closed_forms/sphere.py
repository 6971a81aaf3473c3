"""Frictionless contact of a rigid ball with its exact circular arc on a half-space.

Hertz replaces the arc R - √(R²-r²) by the paraboloid r²/2R. The arc in the same linear half-space
changes the results by O(a²/R²). To first order the factors are, at equal contact radius, 1 + (2/5)
a²/R² on load, 1 + (1/3) a²/R² on approach, 1 + (2/9) a²/R² on peak pressure; at equal load, 1 -
(2/15) a²/R² on contact radius, 1 + (1/15) a²/R² on approach, 1 + (4/45) a²/R² on peak pressure.
Valid for contact radius < R. Slopes must be small: the result is the error of the paraboloid, not a
theory of large strains.
"""

from dataclasses import dataclass
from math import atanh, pi

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from verification.closed_forms.quadrature import unit_gauss

SERIES_BELOW = 0.3
SERIES_TERMS = 20
ORDER = 60


@dataclass(frozen=True)
class SphereContact:
    """State of the contact of a ball with its exact circular arc (Sneddon 1965; Galin-Sneddon
    integrals).

    radius           ball radius R [length]
    contact_modulus  E* [force/length²]
    contact_radius   0 <= a < R [length]
    """

    radius: float
    contact_modulus: float
    contact_radius: float

    def __post_init__(self) -> None:
        if self.contact_radius >= self.radius:
            raise ValueError(
                f"contact radius {self.contact_radius!r} reaches the ball's radius {self.radius!r}"
            )

    @classmethod
    def under_load(cls, load: float, radius: float, contact_modulus: float) -> "SphereContact":
        """Compute the ball contact under a normal load W >= 0 [force].

        Raises ValueError if the contact radius would reach the ball radius R.
        """
        target = load / (contact_modulus * radius**2)
        if target == 0:
            return cls(radius, contact_modulus, 0.0)
        # the arc is stiffer than the paraboloid, whose radius is therefore an upper bound
        upper = min(float(np.cbrt(0.75 * target)), 1 - 1e-15)
        if _reduced_load(upper) < target:
            raise ValueError(f"load {load!r} presses the ball (radius {radius!r}) to its equator")
        # relative unknown: brentq's absolute tolerance must not bite for small loads
        factor = brentq(lambda t: _reduced_load(t * upper) / target - 1, 0.1, 1.0, xtol=1e-15)
        return cls(radius, contact_modulus, radius * upper * float(factor))

    @property
    def load(self) -> float:
        """Normal load W = E* [(a²+R²)/2 ln((R+a)/(R-a)) - aR] [force]."""
        reduced = _reduced_load(self.contact_radius / self.radius)
        return self.contact_modulus * self.radius**2 * reduced

    @property
    def approach(self) -> float:
        """Approach (a/2) ln((R+a)/(R-a)) of distant points of the two bodies [length]."""
        return self.contact_radius * atanh(self.contact_radius / self.radius)

    @property
    def peak_pressure(self) -> float:
        """Pressure at the centre of the contact [force/length²]."""
        return float(self.pressure(0.0))

    def pressure(self, r: ArrayLike) -> NDArray[np.float64]:
        """Compute the pressure (E*/π) ∫ᵣᵃ S'(s)/√(s²-r²) ds with S = s artanh(s/R) [force/length²].

        The second term of S' is integrated in closed form, the first by a Gauss rule.
        """
        R, a = self.radius, self.contact_radius
        rho = np.minimum(np.abs(np.asarray(r, dtype=float)), a)
        chord = np.sqrt((a - rho) * (a + rho))
        v, weights = unit_gauss(ORDER)
        x = np.hypot(rho[..., None], chord[..., None] * v) / R
        first = chord / R * (np.arctanh(x) / np.maximum(x, np.finfo(float).tiny) * weights).sum(-1)
        depth = np.sqrt((R - rho) * (R + rho))
        return np.asarray(
            self.contact_modulus / pi * (first + R / depth * np.arctanh(chord / depth))
        )

    def gap(self, r: ArrayLike) -> NDArray[np.float64]:
        """Compute the gap of the deformed surfaces at distance r from the axis [length].

        The gap is zero inside the contact, and infinite for r > R, where the ball has no surface.
        """
        R, a = self.radius, self.contact_radius
        rho = np.abs(np.asarray(r, dtype=float))
        outside = np.clip(rho, a, R)
        start = np.arctan2(a, np.sqrt((outside - a) * (outside + a)))[..., None]
        v, weights = unit_gauss(ORDER)
        s = outside[..., None] * np.sin(start + (pi / 2 - start) * v)
        excess = s * np.arctanh(s / R) - self.approach
        gap = 2 / pi * (pi / 2 - start[..., 0]) * (excess * weights).sum(axis=-1)
        return np.asarray(np.where(rho > R, np.inf, gap))


def _reduced_load(x: float) -> float:
    """Compute the dimensionless load W/(E*R²) = (1+x²) artanh x - x of a ball contact with x = a/R.

    For small x the power series avoids cancellation.
    """
    if x >= SERIES_BELOW:
        return (1 + x**2) * atanh(x) - x
    k = np.arange(SERIES_TERMS, 0, -1)
    return float((4 * k / (4 * k**2 - 1) * x ** (2 * k + 1)).sum())
