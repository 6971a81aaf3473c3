"""Torsion of a circular contact in closed form: full stick, and partial slip of a Hertz contact.

Torsion is uncoupled from the normal problem for all materials. In partial slip a central stick disc
rotates as a rigid body; outside this disc the shear is µ times the Hertz pressure.
"""

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq
from scipy.special import ellipe, elliprd

from verification.closed_forms.quadrature import unit_gauss

ORDER = 120


@dataclass(frozen=True)
class StuckTorsion:
    """Hold a circular contact in full stick under a torque (Reissner and Sagoci 1944).

    contact_radius     contact radius a > 0 [length]
    torsional_modulus  reciprocal of the sum of 1/G of both bodies [force/length²]
    moment             torque M, of either sign [force*length]
    """

    contact_radius: float
    torsional_modulus: float
    moment: float

    @property
    def twist(self) -> float:
        """Relative rotation 3M/(16 a³ torsional_modulus) of the two bodies by the torque M
        [radian].
        """
        return 3 * self.moment / (16 * self.contact_radius**3 * self.torsional_modulus)

    def shear(self, r: ArrayLike) -> NDArray[np.float64]:
        """Compute the circumferential shear 3Mr/(4πa³√(a²-r²)) at distance r from the axis
        [force/length²].

        M is the torque and a the contact radius. The shear is infinite at r = a and zero outside.
        """
        a, rho = self.contact_radius, np.abs(np.asarray(r, dtype=float))
        room = np.where(rho <= a, (a - rho) * (a + rho), np.inf)
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(3 * self.moment * rho / (4 * pi * a**3 * np.sqrt(room)))


@dataclass(frozen=True)
class TorsionalPartialSlip:
    """Hold a Hertz contact in partial slip under a torque that has grown monotonically from zero.

    A central disc sticks and rotates as a rigid body. The formulas are those of Lubkin (1951) in
    Jäger's Abel-integral form.

    contact_radius        contact radius a > 0 [length]
    peak_pressure         peak pressure p0 > 0 [force/length²]
    friction_coefficient  coefficient of friction µ > 0
    torsional_modulus     reciprocal of the sum of 1/G of both bodies [force/length²]
    stick_radius          stick radius c, 0 < c <= a [length]; the twist grows without bound as c →
                          0
    """

    contact_radius: float
    peak_pressure: float
    friction_coefficient: float
    torsional_modulus: float
    stick_radius: float

    def __post_init__(self) -> None:
        if self.stick_radius > self.contact_radius:
            raise ValueError(
                f"stick radius {self.stick_radius!r} exceeds the contact radius "
                f"{self.contact_radius!r}"
            )

    @classmethod
    def under_moment(
        cls,
        moment: float,
        contact_radius: float,
        peak_pressure: float,
        friction_coefficient: float,
        torsional_modulus: float,
    ) -> "TorsionalPartialSlip":
        """Compute the partial slip of a Hertz contact under a torque M [force*length].

        moment                torque, 0 <= M < (3π/16) µWa (W: normal load, a: contact radius)
        contact_radius        contact radius a [length]
        peak_pressure         peak pressure p0 [force/length²]
        friction_coefficient  coefficient of friction µ
        torsional_modulus     reciprocal of the sum of 1/G of both bodies [force/length²]

        Raises ValueError for a torque outside this range.
        """
        stuck = cls(
            contact_radius,
            peak_pressure,
            friction_coefficient,
            torsional_modulus,
            contact_radius,
        )
        if not 0 <= moment < stuck.sliding_moment:
            raise ValueError(
                f"moment {moment!r} outside [0, {stuck.sliding_moment!r}): "
                "the upper limit is gross sliding"
            )
        if moment == 0:
            return stuck
        target = moment / (friction_coefficient * peak_pressure * contact_radius**3)
        ratio = float(brentq(lambda x: _reduced_moment(x) - target, 1e-300, 1.0, xtol=1e-15))
        return cls(
            contact_radius,
            peak_pressure,
            friction_coefficient,
            torsional_modulus,
            contact_radius * ratio,
        )

    @property
    def sliding_moment(self) -> float:
        """Torque at gross slip, (3π/16) µWa = (π²/8) µ p0 a³ [force*length].

        W is the normal load, a the contact radius and p0 the peak pressure.
        """
        return pi**2 / 8 * self.friction_coefficient * self.peak_pressure * self.contact_radius**3

    @property
    def moment(self) -> float:
        """Torque of the contact [force*length].

        The torque is (8/3) µ p0 ∫ s² E(√(1-s²/a²)) ds from the stick radius to the contact radius
        a, with the complete elliptic integral E and the peak pressure p0.
        """
        scale = self.friction_coefficient * self.peak_pressure * self.contact_radius**3
        return scale * _reduced_moment(self.stick_radius / self.contact_radius)

    @property
    def twist(self) -> float:
        """Relative rotation µ p0 [K(k') - E(k')]/(2 torsional_modulus) of the two bodies [radian].

        K and E are complete elliptic integrals, and k'² = 1-c²/a² with stick radius c and contact
        radius a. p0 is the peak pressure.
        """
        square = (self.stick_radius / self.contact_radius) ** 2
        # Carlson's R_D gives K - E without cancellation for a narrow slip annulus
        difference = (1 - square) / 3 * float(elliprd(0, square, 1))
        traction = self.friction_coefficient * self.peak_pressure
        return traction * difference / (2 * self.torsional_modulus)

    def shear(self, r: ArrayLike) -> NDArray[np.float64]:
        """Compute the circumferential shear in partial slip at distance r from the axis
        [force/length²].

        The shear is µp in the slip annulus and smaller in the stick disc. The reduction in the
        stick disc is (2/π) µ p0 ∫ E(√(1 - r²/(a cos φ)²)) dφ from 0 to arccos(r/c), by inversion of
        the Abel integral with the twist of a rigid disc. E is the complete elliptic integral, p0
        the peak pressure, a the contact radius and c the stick radius.
        """
        a, c = self.contact_radius, self.stick_radius
        rho = np.abs(np.asarray(r, dtype=float))
        full = np.sqrt(np.maximum(1 - (rho / a) ** 2, 0))
        v, weights = unit_gauss(ORDER)
        inner = np.minimum(rho, c)[..., None]
        angle = np.arccos(inner / c)
        # nodes crowd cubically towards arccos(r/c), where the integrand turns fast for small r
        phi = angle * (1 - v**3)
        modulus_complement = np.minimum((inner / (a * np.cos(phi))) ** 2, 1)
        integrand = ellipe(1 - modulus_complement) * 3 * v**2 * weights
        taken_off = 2 / pi * angle[..., 0] * integrand.sum(axis=-1)
        return np.asarray(self.friction_coefficient * self.peak_pressure * (full - taken_off))


def _reduced_moment(ratio: float) -> float:
    """Compute the dimensionless torque M/(µ p0 a³) of a Hertz contact in partial slip.

    p0 is the peak pressure and a the contact radius.

    ratio  stick radius over contact radius
    """
    v, weights = unit_gauss(ORDER)
    s = ratio + (1 - ratio) * v
    return 8 / 3 * (1 - ratio) * float((s**2 * ellipe((1 - s) * (1 + s)) * weights).sum())
