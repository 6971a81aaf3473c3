"""Hertz line contact of parallel cylinders, per unit length, with its partial slip.

Plane strain: the approach depends on where it is measured (logarithm), so none is given.
Tangential and normal compliance are equal, hence no G* appears. Valid for a << R and uncoupled
pairs; unlike point contact, partial slip is then exact for every Poisson's ratio.
"""

from dataclasses import dataclass
from math import copysign, pi, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from verification.closed_forms.validity import (
    require_non_negative,
    require_positive,
    require_within_friction_limit,
)


@dataclass(frozen=True)
class LineContact:
    """State of a Hertz line contact (Hertz 1882; Johnson 1985, ch. 4.2).

    radius              relative radius of curvature R [length]
    contact_modulus     E* [force/length²]
    contact_half_width  a [length], zero at first touch
    """

    radius: float
    contact_modulus: float
    contact_half_width: float

    def __post_init__(self) -> None:
        require_positive(radius=self.radius, contact_modulus=self.contact_modulus)
        require_non_negative(contact_half_width=self.contact_half_width)

    @classmethod
    def under_load(cls, load: float, radius: float, contact_modulus: float) -> "LineContact":
        """Contact under a load per length P >= 0 [force/length]: a² = 4PR/πE*."""
        require_non_negative(load=load)
        require_positive(radius=radius, contact_modulus=contact_modulus)
        return cls(radius, contact_modulus, sqrt(4 * load * radius / (pi * contact_modulus)))

    @property
    def load(self) -> float:
        """Load per length P = πE*a²/4R [force/length]."""
        return pi * self.contact_modulus * self.contact_half_width**2 / (4 * self.radius)

    @property
    def peak_pressure(self) -> float:
        """Pressure on the centre line, 2P/πa = E*a/2R [force/length²]."""
        return self.contact_modulus * self.contact_half_width / (2 * self.radius)

    def pressure(self, x: ArrayLike) -> NDArray[np.float64]:
        """Pressure at distance x from the centre line [force/length²], zero outside."""
        a, xs = self.contact_half_width, np.abs(np.asarray(x, dtype=float))
        slope = self.contact_modulus / (2 * self.radius)
        return np.asarray(slope * np.sqrt(np.maximum((a - xs) * (a + xs), 0)))

    def gap(self, x: ArrayLike) -> NDArray[np.float64]:
        """Deformed gap [length], zero inside; follows from integrating the surface slope."""
        a, xs = self.contact_half_width, np.abs(np.asarray(x, dtype=float))
        if a == 0:
            return np.asarray(xs**2 / (2 * self.radius))
        outside = np.maximum(xs, a)
        root = np.sqrt((outside - a) * (outside + a))
        return np.asarray((outside * root - a**2 * np.arcsinh(root / a)) / (2 * self.radius))


@dataclass(frozen=True)
class LinePartialSlip:
    """Line contact under constant load and a tangential force from zero (Cattaneo 1938).

    contact               the normal contact
    friction_coefficient  µ > 0
    tangential_force      T per length, |T| <= µP [force/length]; odd in its sign

    Raises ValueError when |T| > µP.
    """

    contact: LineContact
    friction_coefficient: float
    tangential_force: float

    def __post_init__(self) -> None:
        mu, P = self.friction_coefficient, self.contact.load
        require_positive(friction_coefficient=mu, load=P)
        require_within_friction_limit(self.tangential_force, mu, P)

    @property
    def stick_half_width(self) -> float:
        """Half-width c of the stick zone: c² = a² (1 - |T|/µP) [length]."""
        ratio = abs(self.tangential_force) / (self.friction_coefficient * self.contact.load)
        return self.contact.contact_half_width * sqrt(max(1 - ratio, 0))

    @property
    def stick_contact(self) -> LineContact:
        """The smaller Hertz contact whose pressure, times µ, is taken off."""
        return LineContact(self.contact.radius, self.contact.contact_modulus, self.stick_half_width)

    def shear(self, x: ArrayLike) -> NDArray[np.float64]:
        """Shear traction at x on the lower body [force/length²]."""
        difference = self.contact.pressure(x) - self.stick_contact.pressure(x)
        scale = copysign(self.friction_coefficient, self.tangential_force)
        return np.asarray(scale * difference)

    def slip(self, x: ArrayLike) -> NDArray[np.float64]:
        """Slip of the lower surface relative to the indenter, |x| <= a [length]; opposes shear."""
        scale = -copysign(self.friction_coefficient, self.tangential_force)
        return np.asarray(scale * (self.stick_contact.gap(x) - self.contact.gap(x)))
