"""Hertz contact in closed form: paraboloid, ball with its exact arc, and elliptical contact.

The gap of the paraboloid is r²/2R, the leading term of the exact arc, or x²/2Rx + y²/2Ry. The
elliptical contact uses Carlson's symmetric elliptic integrals, which have no 0/0 in the circular
limit and do not depend on which axis is the longer. The solutions are valid for semi-axes much
smaller than the radii, and for frictionless surfaces or pairs without normal-tangential
coupling.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from math import atanh, pi

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import elliprd, elliprf

from verification.closed_forms.quadrature import unit_gauss

Array = NDArray[np.float64]

ElasticConstants = tuple[float, float]


def half_chord(a: float, r: ArrayLike) -> Array:
    """Compute √(a² - r²) within a circle of radius a, and 0 outside [length].

    The product of a - r and a + r keeps the digits close to the circle.
    """
    rho = np.abs(np.asarray(r, dtype=float))
    return np.asarray(np.sqrt(np.maximum((a - rho) * (a + rho), 0)))


def contact_modulus(*bodies: ElasticConstants) -> float:
    """Compute the contact modulus E* of two bodies: 1/E* = sum of (1 - ν²)/E [force/length²].

    The contact stiffness dW/d(approach) of a circular contact of radius a is 2 E* a (Johnson 1985,
    ch. 4).

    bodies  Young's modulus E and Poisson's ratio ν of each elastic body
    """
    return 1 / sum((1 - nu**2) / E for E, nu in _checked(bodies))


def tangential_modulus(*bodies: ElasticConstants) -> float:
    """Compute the tangential modulus G* of two bodies: 1/G* = sum of (2 - ν)/(4 G) [force/length²].

    The tangential stiffness of a circular contact of radius a in full stick is 2 G* a (Mindlin
    1949).

    bodies  Young's modulus E and Poisson's ratio ν of each elastic body
    """
    return 1 / sum((2 - nu) * (1 + nu) / (2 * E) for E, nu in _checked(bodies))


def _checked(bodies: tuple[ElasticConstants, ...]) -> tuple[ElasticConstants, ...]:
    if not bodies:
        raise ValueError("no elastic body given: at least one of the two must be deformable")
    for E, nu in bodies:
        if not (math.isfinite(E) and E > 0):
            raise ValueError(f"Young's modulus is {E!r}, expected a finite number > 0")
        if not -1 < nu <= 0.5:
            raise ValueError(f"Poisson's ratio is {nu!r}, expected -1 < nu <= 0.5")
    return bodies


@dataclass(frozen=True)
class PointContact:
    """Hold a Hertz contact of a paraboloid (Hertz 1882; Johnson 1985, Eqs. 4.22–4.24).

    radius           relative radius of curvature R [length]
    contact_modulus  contact modulus E* [force/length²]
    contact_radius   contact radius a [length], zero at first touch
    """

    radius: float
    contact_modulus: float
    contact_radius: float

    @classmethod
    def under_load(cls, load: float, radius: float, contact_modulus: float) -> PointContact:
        """Compute the Hertz contact of a paraboloid under a normal load W >= 0 [force].

        The contact radius a follows from a³ = 3WR/4E*.
        """
        return cls(radius, contact_modulus, float(np.cbrt(3 * load * radius / contact_modulus / 4)))

    @property
    def load(self) -> float:
        """Normal load W = 4E*a³/3R of the Hertz contact (a: contact radius, R: radius of curvature)
        [force].
        """
        return 4 * self.contact_modulus * self.contact_radius**3 / (3 * self.radius)

    @property
    def approach(self) -> float:
        """Approach a²/R of distant points since first touch (a: contact radius) [length]."""
        return self.contact_radius**2 / self.radius

    @property
    def normal_stiffness(self) -> float:
        """Derivative 2E*a of the normal load by the approach (Johnson 1985, ch. 4)
        [force/length].
        """
        return 2 * self.contact_modulus * self.contact_radius

    @property
    def peak_pressure(self) -> float:
        """Pressure at the centre of the Hertz contact, 3W/2πa² = 2E*a/πR [force/length²]."""
        return 2 * self.contact_modulus * self.contact_radius / (pi * self.radius)

    def pressure(self, r: ArrayLike) -> Array:
        """Compute the Hertz pressure at distance r from the axis [force/length²].

        The pressure is zero outside the contact.
        """
        # p0/a = 2E*/πR does not involve a, so first touch needs no special case.
        slope = 2 * self.contact_modulus / (pi * self.radius)
        return np.asarray(slope * half_chord(self.contact_radius, r))


SERIES_BELOW = 0.3
SERIES_TERMS = 20
ORDER = 60


@dataclass(frozen=True)
class SphereContact:
    """Hold the frictionless contact of a ball with its exact circular arc (Sneddon 1965).

    Hertz theory replaces the arc by a paraboloid. The fields are Galin-Sneddon integrals.

    radius           ball radius R [length]
    contact_modulus  contact modulus E* [force/length²]
    contact_radius   contact radius a, 0 <= a < R [length]
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
    def under_load(cls, load: float, radius: float, contact_modulus: float) -> SphereContact:
        """Compute the contact of a ball with its exact arc under a normal load W >= 0 [force].

        Raises ValueError if the contact radius would reach the ball radius R.
        """
        target = load / (contact_modulus * radius**2)
        if target == 0:
            return cls(radius, contact_modulus, 0.0)
        from scipy.optimize import brentq  # half a second, which each judged solver would wait

        # the arc is stiffer than the paraboloid, whose radius is therefore an upper bound
        upper = min(float(np.cbrt(0.75 * target)), 1 - 1e-15)
        if _reduced_load(upper) < target:
            raise ValueError(f"load {load!r} presses the ball (radius {radius!r}) to its equator")
        # the unknown is relative, because brentq has an absolute tolerance
        factor = brentq(lambda t: _reduced_load(t * upper) / target - 1, 0.1, 1.0, xtol=1e-15)
        return cls(radius, contact_modulus, radius * upper * float(factor))

    @property
    def load(self) -> float:
        """Normal load of the ball with its exact arc [force].

        The load is E* [(a²+R²)/2 ln((R+a)/(R-a)) - aR] (a: contact radius, R: ball radius).
        """
        reduced = _reduced_load(self.contact_radius / self.radius)
        return self.contact_modulus * self.radius**2 * reduced

    @property
    def approach(self) -> float:
        """Approach (a/2) ln((R+a)/(R-a)) of distant points of the two bodies [length].

        a is the contact radius and R the ball radius.
        """
        return self.contact_radius * atanh(self.contact_radius / self.radius)

    @property
    def peak_pressure(self) -> float:
        """Pressure at the centre of the contact of ball and half-space [force/length²]."""
        return float(self.pressure(0.0))

    def pressure(self, r: ArrayLike) -> Array:
        """Compute the pressure below a ball with its exact arc at distance r from the axis
        [force/length²].

        The pressure is (E*/π) ∫ᵣᵃ S'(s)/√(s²-r²) ds with S = s artanh(s/R) (a: contact radius). The
        second term of S' is integrated in closed form, the first by a Gauss rule.
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


def _reduced_load(x: float) -> float:
    """Compute the dimensionless load W/(E*R²) of a ball with its exact arc.

    The load is (1+x²) artanh x - x. For small x the power series avoids cancellation.

    x  contact radius over ball radius
    """
    if x >= SERIES_BELOW:
        return (1 + x**2) * atanh(x) - x
    k = np.arange(SERIES_TERMS, 0, -1)
    return float((4 * k / (4 * k**2 - 1) * x ** (2 * k + 1)).sum())


def axis_ratio(radius_x: float, radius_y: float) -> float:
    """Compute the ratio k = b/a of the semi-axes along y and x of an elliptical Hertz contact.

    k follows from Rx/Ry = R_D(1, 0, k²)/R_D(k², 0, 1) with Carlson's integral R_D. The equation is
    the classical B/A = [(a/b)²E - K]/[K - E] (Hertz 1882) after cancelling the common factor 1 -
    k².

    radius_x  radius of curvature Rx of the gap along x [length]
    radius_y  radius of curvature Ry of the gap along y [length]
    """
    if radius_x == radius_y:
        return 1.0
    from scipy.optimize import brentq

    target = np.log(radius_x / radius_y)

    def mismatch(log_k: float) -> float:
        square = np.exp(2 * log_k)
        return float(np.log(elliprd(1, 0, square) / elliprd(square, 0, 1)) - target)

    # k lies between 1 and Ry/Rx: the ellipse is less slender than the ratio of the radii
    return float(np.exp(brentq(mismatch, -target, 0.0, xtol=1e-15, rtol=8.9e-16)))


@dataclass(frozen=True)
class EllipticalContact:
    """Hold an elliptical Hertz contact (Hertz 1882; Johnson 1985, ch. 4.2); created by
    `under_load`.

    radii            principal radii of curvature (Rx, Ry) of the gap [length]
    contact_modulus  contact modulus E* [force/length²]
    semi_axes        semi-axes (a, b) of the contact along x and y [length]
    axis_ratio       b/a, which is also defined at first touch, where the semi-axes vanish
    """

    radii: tuple[float, float]
    contact_modulus: float
    semi_axes: tuple[float, float]
    axis_ratio: float

    @classmethod
    def under_load(
        cls, load: float, radii: tuple[float, float], contact_modulus: float
    ) -> EllipticalContact:
        """Compute the elliptical Hertz contact under a normal load W >= 0 [force].

        radii            principal radii of curvature (Rx, Ry) of the gap [length]
        contact_modulus  contact modulus E* [force/length²]
        """
        k = axis_ratio(*radii)
        a = np.cbrt(load * radii[0] * elliprd(k**2, 0, 1) / (pi * contact_modulus))
        return cls(radii, contact_modulus, (float(a), float(k * a)), k)

    @property
    def _pressure_slope(self) -> float:
        # p0/a, independent of the load
        k = self.axis_ratio
        return float(3 * self.contact_modulus / (2 * self.radii[0] * k * elliprd(k**2, 0, 1)))

    @property
    def peak_pressure(self) -> float:
        """Pressure p0 = 3W/2πab at the centre of the contact [force/length²].

        W is the normal load; a and b are the semi-axes.
        """
        return self._pressure_slope * self.semi_axes[0]

    @property
    def load(self) -> float:
        """Normal load W = 2πab p0/3 [force], with the semi-axes a and b and the peak
        pressure p0.
        """
        a, b = self.semi_axes
        return 2 * pi / 3 * a * b * self.peak_pressure

    @property
    def approach(self) -> float:
        """Approach of distant points of the two bodies since first touch [length].

        The approach is 3WK/2πE*a with the complete elliptic integral K, normal load W and semi-axis
        a.
        """
        b = self.semi_axes[1]
        return float(self.peak_pressure * b * elliprf(1, self.axis_ratio**2, 0)) / (
            self.contact_modulus
        )

    def pressure(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Compute the pressure of the elliptical Hertz contact at points (x, y) [force/length²].

        The coordinates are broadcast together. The pressure is zero outside the contact ellipse.
        """
        xs, ys = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        room = self.semi_axes[0] ** 2 - xs**2 - (ys / self.axis_ratio) ** 2
        return np.asarray(self._pressure_slope * np.sqrt(np.maximum(room, 0)))
