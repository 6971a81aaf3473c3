"""Closed-form contact of a rigid cone with an elastic half-space.

The flank is inclined by `slope_angle` to the surface, which must be small for linear elasticity.
The solution is valid for frictionless faces or pairs without normal-tangential coupling.
"""

from dataclasses import dataclass
from math import pi, sqrt, tan

import numpy as np
from numpy.typing import ArrayLike, NDArray


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
    def under_load(cls, load: float, slope_angle: float, contact_modulus: float) -> "ConeContact":
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

    def pressure(self, r: ArrayLike) -> NDArray[np.float64]:
        """Compute the pressure (E*/2) tan(slope) arccosh(a/r) at distance r from the axis
        [force/length²].

        The pressure is infinite at the apex and zero outside the contact radius a.
        """
        a, rho = self.contact_radius, np.abs(np.asarray(r, dtype=float))
        inside = rho < a
        with np.errstate(divide="ignore"):
            ratio = np.divide(a, rho, out=np.ones_like(rho), where=inside)
        return np.asarray(self.contact_modulus / 2 * tan(self.slope_angle) * np.arccosh(ratio))

    def gap(self, r: ArrayLike) -> NDArray[np.float64]:
        """Compute the gap between cone and deformed half-space at distance r from the axis
        [length].

        The gap is tan(slope) [√(r²-a²) - a arccos(a/r)], and zero inside the contact radius a.
        """
        a, rho = self.contact_radius, np.abs(np.asarray(r, dtype=float))
        outside = np.maximum(rho, a)
        root = np.sqrt((outside - a) * (outside + a))
        return np.asarray(tan(self.slope_angle) * (root - a * np.arctan2(root, a)))
