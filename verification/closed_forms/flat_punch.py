"""Closed-form contact of a rigid flat punch, centred or tilted, and of a rigid cone.

The body is a half-space. The pressure is infinite at the rim of the punch and at the apex of the
cone. The flank of the cone is inclined by `slope_angle`, which must be small for linear elasticity.
The solutions are valid for frictionless faces or pairs without normal-tangential coupling.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot, pi, sqrt, tan

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class FlatPunchContact:
    """Hold the contact between a rigid flat punch and a half-space (Boussinesq; Johnson 1985, 3.4).

    A pressure ∝ 1/√(a²-r²) displaces the disc below by a constant, and a pressure ∝ x/√(a²-r²) as a
    plane (Galin's theorem for a polynomial of first degree; Sneddon 1951, § 52).

    contact_radius   punch radius a [length]
    contact_modulus  contact modulus E* [force/length²]
    load             normal load W >= 0 [force]
    eccentricity     (e_x, e_y) of the load [length]; ValueError above a/3, where one side lifts off
    """

    contact_radius: float
    contact_modulus: float
    load: float
    eccentricity: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        if hypot(*self.eccentricity) > self.contact_radius / 3:
            raise ValueError(
                f"eccentricity {hypot(*self.eccentricity)!r} exceeds a third of the radius "
                f"{self.contact_radius!r}: the punch lifts off on one side"
            )

    @property
    def approach(self) -> float:
        """Approach W/2E*a of the punch axis, which does not depend on the tilt [length].

        W is the normal load and a the punch radius.
        """
        return self.load / (2 * self.contact_modulus * self.contact_radius)

    @property
    def tilt(self) -> tuple[float, float]:
        """Slopes of the punch face along x and y under the eccentric load [1].

        The slopes are We_x/k and We_y/k with the tilting stiffness k = (4/3) E* a³ (W: load, e:
        eccentricity, a: punch radius).
        """
        stiffness = 4 / 3 * self.contact_modulus * self.contact_radius**3
        e_x, e_y = self.eccentricity
        return self.load * e_x / stiffness, self.load * e_y / stiffness

    def pressure(self, x: ArrayLike, y: ArrayLike = 0.0) -> Array:
        """Compute the pressure of the punch at points (x, y) [force/length²].

        The pressure is W/(2πa√(a²-r²)) (1 + 3 (e_x x + e_y y)/a²), infinite at the rim and zero
        outside.
        """
        a, (e_x, e_y) = self.contact_radius, self.eccentricity
        X, Y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
        r = np.hypot(X, Y)
        inside = np.where(r <= a, (a - r) * (a + r), np.inf)
        with np.errstate(divide="ignore", invalid="ignore"):
            upright = self.load / (2 * pi * a * np.sqrt(inside))
        return np.asarray(upright * (1 + 3 * (e_x * X + e_y * Y) / a**2))


@dataclass(frozen=True)
class ConeContact:
    """Hold the contact between a rigid cone and an elastic half-space (Love 1939; Sneddon 1965).

    slope_angle      angle of the flank to the surface, 0 < angle < π/2 [radian]
    contact_modulus  contact modulus E* [force/length²]
    contact_radius   contact radius a [length], zero at first touch
    """

    slope_angle: float
    contact_modulus: float
    contact_radius: float

    @classmethod
    def under_load(cls, load: float, slope_angle: float, contact_modulus: float) -> ConeContact:
        """Compute the contact of a cone under a normal load W >= 0 [force].

        The contact radius a follows from a² = 2W/(πE* tan(slope)).
        """
        a = sqrt(2 * load / (pi * contact_modulus * tan(slope_angle)))
        return cls(slope_angle, contact_modulus, a)

    @property
    def load(self) -> float:
        """Normal load W = (π/2) E* a² tan(slope) of the cone (a: contact radius) [force]."""
        return pi / 2 * self.contact_modulus * self.contact_radius**2 * tan(self.slope_angle)

    @property
    def approach(self) -> float:
        """Approach (π/2) a tan(slope) of distant points of the two bodies (a: contact radius)
        [length].
        """
        return pi / 2 * self.contact_radius * tan(self.slope_angle)

    def pressure(self, r: ArrayLike) -> Array:
        """Compute the pressure (E*/2) tan(slope) arccosh(a/r) at distance r from the axis
        [force/length²].

        The pressure is infinite at the apex and zero outside the contact radius a.
        """
        a, rho = self.contact_radius, np.abs(np.asarray(r, dtype=float))
        inside = rho < a
        with np.errstate(divide="ignore"):
            ratio = np.divide(a, rho, out=np.ones_like(rho), where=inside)
        return np.asarray(self.contact_modulus / 2 * tan(self.slope_angle) * np.arccosh(ratio))
