"""Closed-form line contacts in plane strain: cylinders, wedges and flat punches, per unit length.

W is the normal force per length, E* the contact modulus, a the half width of the contact. Approach
and shift are those of the surface far from the contact, counted from the surface at the distance L.
In a pair without normal-tangential coupling the shear µp moves the surfaces along x as the pressure
p moves them along z (Cattaneo 1938; Johnson 1985, section 7.2).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, cos, log, pi, sin, sqrt, tan

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class CylinderContact:
    """Hold the contact of a parabolic cylinder with a half-space (Johnson 1985, section 4.2).

    load      W [force/length]
    radius    radius of curvature R of the cylinder [length]
    modulus   E* [force/length²]
    distance  L [length]
    """

    load: float
    radius: float
    modulus: float
    distance: float

    @property
    def contact_radius(self) -> float:
        """Half width a = √(4WR/πE*) of the contact [length]."""
        return sqrt(4 * self.load * self.radius / (pi * self.modulus))

    @property
    def peak_pressure(self) -> float:
        """Largest pressure p₀ = 2W/πa [force/length²]."""
        return 2 * self.load / (pi * self.contact_radius)

    @property
    def approach(self) -> float:
        """Approach W (1 + 2 ln(2L/a))/πE* [length]."""
        far = 1 + 2 * log(2 * self.distance / self.contact_radius)
        return self.load * far / (pi * self.modulus)

    @property
    def complementary_work(self) -> float:
        """Integral of the approach over the load from 0 to W [force]."""
        far = 1.5 + 2 * log(2 * self.distance / self.contact_radius)
        return self.load**2 / 2 * far / (pi * self.modulus)

    def pressure(self, x: ArrayLike) -> Array:
        """Compute the pressure p₀ √(1 - x²/a²) at a distance from the middle [force/length²].

        x  distance [length]
        """
        inside = np.maximum(1 - np.square(np.divide(x, self.contact_radius)), 0)
        return np.asarray(self.peak_pressure * np.sqrt(inside))

    def under(self, load: float) -> CylinderContact:
        """Return the contact of the same cylinder under another normal force per length."""
        return CylinderContact(load, self.radius, self.modulus, self.distance)


@dataclass(frozen=True)
class PushedCylinder:
    """Hold partial slip of a cylinder of equal bodies under a monotonic tangential force T along x.

    A bulk strain ε of the lower body that grows in proportion with T moves the stick zone by
    e = εR/µ, as long as it stays inside the contact (Nowell and Hills 1987).

    pressed   contact under the constant normal force
    friction  µ
    force     T [force/length]
    strain    ε along x
    """

    pressed: CylinderContact
    friction: float
    force: float
    strain: float = 0.0

    @property
    def stuck(self) -> CylinderContact:
        """Contact whose pressure times µ is the shear deficit in the stick zone."""
        return self.pressed.under(self.pressed.load - self.force / self.friction)

    @property
    def stick_radius(self) -> float:
        """Half width a √(1 - T/µW) of the stick zone [length]."""
        return self.stuck.contact_radius

    @property
    def stick_centre(self) -> float:
        """Centre e = εR/µ of the stick zone [length]."""
        return self.strain * self.pressed.radius / self.friction

    @property
    def contact_radius(self) -> float:
        """Half width of the contact [length]."""
        return self.pressed.contact_radius

    @property
    def shift(self) -> float:
        """Tangential shift without bulk strain [length]."""
        return self.friction * (self.pressed.approach - self.stuck.approach)

    @property
    def energy_per_cycle(self) -> float:
        """Energy dissipated from T to -T and back, without bulk strain [force].

        Unloading and reloading follow the first curve s(T), doubled in force and shift: the area of
        the loop is 4 T s(T) - 8 ∫ s dT.
        """
        pressed, stuck, mu, T = self.pressed, self.stuck, self.friction, self.force
        below = pressed.complementary_work - stuck.complementary_work
        return 4 * T * self.shift - 8 * (mu * pressed.approach * T - mu**2 * below)

    @property
    def dissipated_energy(self) -> float:
        """Energy dissipated in the first push: a quarter of that of a cycle, whose slip is double
        in each of two branches [force].
        """
        return self.energy_per_cycle / 4

    def shear(self, x: ArrayLike, y: ArrayLike = 0.0) -> Array:
        """Compute the shear µp(x) - µp_c(x - e) along the force [force/length²].

        x, y  coordinates of the points [length]
        """
        lost = self.stuck.pressure(np.subtract(x, self.stick_centre))
        return np.asarray(self.friction * (self.pressed.pressure(x) - lost) + np.zeros_like(y))


@dataclass(frozen=True)
class WedgeContact:
    """Hold the contact of a wedge with a half-space (Johnson 1985, section 5.2).

    load         W [force/length]
    slope_angle  α, angle between flank and surface
    modulus      E* [force/length²]
    """

    load: float
    slope_angle: float
    modulus: float

    @property
    def contact_radius(self) -> float:
        """Half width a = W/(E* tan α) [length]."""
        return self.load / (self.modulus * tan(self.slope_angle))

    def pressure(self, x: ArrayLike) -> Array:
        """Compute the pressure E* tan α arcosh(a/|x|)/π [force/length²].

        x  distance from the edge of the wedge, not 0 [length]
        """
        ratio = np.maximum(self.contact_radius / np.abs(x), 1.0)
        return np.asarray(self.modulus * tan(self.slope_angle) / pi * np.arccosh(ratio))


@dataclass(frozen=True)
class FlatStrip:
    """Hold the contact of a rigid flat punch of infinite length under a moment M.

    The solutions are those of Sadowsky (1928) and of Johnson (1985), section 2.8.

    load            W [force/length]
    contact_radius  half width b [length]
    modulus         E* [force/length²]
    moment          M = ∫ p x dx [force]
    """

    load: float
    contact_radius: float
    modulus: float
    moment: float = 0.0

    @property
    def tilt(self) -> float:
        """Tilt 4M/πE*b² [radian]."""
        return 4 * self.moment / (pi * self.modulus * self.contact_radius**2)

    def pressure(self, x: ArrayLike, y: ArrayLike = 0.0) -> Array:
        """Compute the pressure (W + 2Mx/b²)/(π√(b² - x²)) inside the edges [force/length²].

        x, y  coordinates of the points [length]
        """
        b, at = self.contact_radius, np.add(x, np.zeros_like(y))
        inside = np.where(np.abs(at) < b, b**2 - at**2, np.inf)
        return np.asarray((self.load + 2 * self.moment * at / b**2) / (pi * np.sqrt(inside)))


def rounded_strip_load(half_width: float, flat: float, edge_radius: float, modulus: float) -> float:
    """Compute W of a flat punch with rounded edges (Ciavarella, Hills and Monno 1998).

    W = E*/R ∫_b^a t (t - b)/√(a² - t²) dt, which is E* a² (π/2 - φ - sin φ cos φ)/2R with
    sin φ = b/a.

    half_width   a [length]
    flat         half width b of the flat part [length]
    edge_radius  R [length]
    modulus      E* [force/length²]
    """
    angle = asin(flat / half_width)
    rest = pi / 2 - angle - sin(angle) * cos(angle)
    return modulus * half_width**2 * rest / (2 * edge_radius)


@dataclass(frozen=True)
class SlidingCylinder:
    """Hold a rigid cylinder that slides on a half-space (Johnson 1985, section 8.2).

    The pressure is proportional to (a + x)^(½ ± γ) (a - x)^(½ ∓ γ) about the middle of the contact,
    with tan πγ = µβ and Dundurs' constant β.

    load      W [force/length]
    radius    R [length]
    modulus   E* [force/length²]
    friction  µ
    beta      β
    """

    load: float
    radius: float
    modulus: float
    friction: float
    beta: float

    @property
    def gamma(self) -> float:
        """Change γ of the exponents at the edges."""
        return float(np.arctan(self.friction * self.beta) / pi)

    @property
    def contact_radius(self) -> float:
        """Half width a, with a² = 4WR/πE*(1 - 4γ²) [length]."""
        narrow = pi * self.modulus * (1 - 4 * self.gamma**2)
        return sqrt(4 * self.load * self.radius / narrow)

    @property
    def distance_of_middle(self) -> float:
        """Distance 2γa of the middle of the contact from the apex, against the slip [length]."""
        return 2 * self.gamma * self.contact_radius
