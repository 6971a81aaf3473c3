"""Torsion of a circular contact in closed form: full stick, and partial slip of a Hertz contact.

Torsion is uncoupled from the normal problem for all materials. In partial slip a central stick disc
rotates as a rigid body; outside this disc the shear is µ times the Hertz pressure.

Coated bodies in partial slip have a semi-closed solution. Torsion makes only shear waves (SH),
which are uncoupled from the pressure. The Hankel transform of the circumferential shear is q~(k) =
∫₀ᵃ h(s) sin ks ds, where h is the Abel transform

    h(s) = (2/π) s ∫ₛᵃ q(r)/√(r²-s²) dr.

For a rigid rotation φ of the disc r < c the equation for s < c is (Lubkin 1951 for h without
layers)

    h(s) + ∫₀ᵃ K(s, t) h(t) dt = (4/π) G φ s,   K(s, t) = (2/π) ∫₀^∞ (X(k) - 1) sin ks sin kt dk,

and in the slip annulus h is that of the friction limit. X(k) = k G F(k), with F(k) the displacement
per unit shear across the wavenumber k and G the torsional modulus for short waves. The shear is
finite at the edge of the stick disc if h is continuous there, which gives φ. The torque is 4π ∫₀ᵃ
h(s) s ds. Without layers K = 0.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq
from scipy.special import ellipe, elliprd

from verification.closed_forms.coated_indentation import LayeredSurface, wavenumbers
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
    ) -> TorsionalPartialSlip:
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
    def torsional_stiffness(self) -> float:
        """Derivative (16/3) G c³ of the torque by the twist, c the stick radius [force*length].

        It is that of a punch of the stick radius (Reissner and Sagoci 1944), because the shear is
        continuous at the stick radius.
        """
        return 16 / 3 * self.torsional_modulus * self.stick_radius**3

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


Array = NDArray[np.float64]

LEAST_ORDER = 80


def one_layer(k: Array, thickness: float, shear_modulus: float, base_modulus: float) -> Array:
    """Compute the torsional compliance F(k) of one layer that is bonded to a half-space
    [length³/force].

    F is the circumferential displacement per unit shear: F = 1/(Gk) (1 + χ e^(-2kh))/(1 - χ
    e^(-2kh)) with χ = (G - G_base)/(G + G_base).

    k              wavenumbers [1/length]
    thickness      thickness h of the layer [length]
    shear_modulus  shear modulus G of the layer [force/length²]
    base_modulus   shear modulus G_base of the half-space [force/length²]
    """
    chi = (shear_modulus - base_modulus) / (shear_modulus + base_modulus)
    reflected = chi * np.exp(-2 * k * thickness)
    return np.asarray((1 + reflected) / (1 - reflected) / (shear_modulus * k))


@dataclass(frozen=True)
class CoatedTorsion:
    """Hold the state of a contact of coated bodies in partial slip, under a torque that grew from
    zero.

    A central disc sticks and rotates as a rigid body. In the annulus around it the shear is the
    friction limit.

    surface         torsional compliance of the two bodies; its modulus is 2G, with the reciprocal G
                    of the sum of 1/G of the outermost materials
    contact_radius  contact radius a > 0 [length]
    limit           friction limit µp as a function of the distance from the axis [force/length²],
                    falling like a square root towards r = a
    stick_radius    stick radius c, 0.1 a <= c < a [length]
    """

    surface: LayeredSurface
    contact_radius: float
    limit: Callable[[Array], Array]
    stick_radius: float

    def __post_init__(self) -> None:
        if not 0.1 <= self.stick_radius / self.contact_radius < 1:
            raise ValueError(
                f"stick radius {self.stick_radius!r} is not between a tenth of the contact radius "
                f"{self.contact_radius!r} and all of it"
            )

    @classmethod
    def under_torque(
        cls,
        torque: float,
        surface: LayeredSurface,
        contact_radius: float,
        limit: Callable[[Array], Array],
    ) -> CoatedTorsion:
        """Compute the state of the contact under a given torque.

        torque          torque [force*length]
        surface         torsional compliance of the two bodies
        contact_radius  contact radius [length]
        limit           friction limit µp as a function of the distance from the axis
                        [force/length²]

        Raises ValueError if the stick radius would be outside its range.
        """

        def excess(part: float) -> float:
            state = cls(surface, contact_radius, limit, part * contact_radius)
            return state.torque / torque - 1

        part = float(brentq(excess, 0.1 + 1e-9, 1 - 1e-9, xtol=1e-14, rtol=1e-14))
        return cls(surface, contact_radius, limit, part * contact_radius)

    @property
    def sliding_torque(self) -> float:
        """Torque 2π ∫ µp r² dr at gross slip, from the friction limit µp [force*length]."""
        a = self.contact_radius
        v, weights = unit_gauss(LEAST_ORDER)
        r, chord = a * np.sin(pi / 2 * v), a * np.cos(pi / 2 * v)
        return float(pi**2 * np.sum(weights * self.limit(r) * r**2 * chord))

    @property
    def twist(self) -> float:
        """Relative rotation φ of the two bodies under the torque [radian]."""
        return self._solve_fredholm[0]

    @property
    def torque(self) -> float:
        """Torque 4π ∫ h s ds of the contact, from the Abel transform h of the shear
        [force*length].
        """
        s, weights = self._quadrature_nodes
        return float(4 * pi * np.sum(weights * self.transform * s))

    @property
    def transform(self) -> Array:
        """Abel transform h of the circumferential shear, which is the unknown of the integral
        equation.

        The values belong to the nodes in the stick disc, then to those in the slip annulus
        [force/length].
        """
        return self._solve_fredholm[1]

    @cached_property
    def _solve_fredholm(self) -> tuple[float, Array]:
        """Twist φ of the contact, and Abel transform h of the shear at the nodes.

        The integral equation is solved once for unit twist and once for the shear of the slip
        annulus alone. Continuity of h at the edge of the stick disc determines φ.
        """
        G, c = self.surface.modulus / 2, self.stick_radius
        s, weights = self._quadrature_nodes
        order = self._quadrature_order
        stick, slip = slice(order), slice(order, None)
        annulus = self._sliding_transform(s[slip])
        kernel = self._fredholm_kernel(np.append(s[stick], c), s) * weights
        right = np.column_stack([4 / pi * G * np.append(s[stick], c), -kernel[:, slip] @ annulus])
        h = np.linalg.solve(np.eye(order) + kernel[stick, stick], right[stick])
        by_twist, by_annulus = right[-1] - kernel[-1, stick] @ h
        edge = self._sliding_transform(np.array([c]))[0]
        twist = float((edge - by_annulus) / by_twist)
        return twist, np.append(twist * h[:, 0] + h[:, 1], annulus)

    def _fredholm_kernel(self, s: Array, t: Array) -> Array:
        """Compute the kernel K(s, t) of the integral equation for the shear; layers are its only
        cause.

        s, t  positions between 0 and the contact radius [length]
        """
        k, weight = wavenumbers(self.contact_radius, self.surface.thickness)
        weighted = weight * self.surface.excess(k)
        return np.asarray(2 / pi * (np.sin(np.outer(s, k)) * weighted) @ np.sin(np.outer(k, t)))

    def _sliding_transform(self, s: Array) -> Array:
        """Compute the Abel transform of the friction limit at positions s [force/length].

        The transform is that of the shear in the slip annulus. The substitution r² = s² + (a²-s²)
        sin² θ removes the square root of the integrand (a: contact radius).
        """
        v, weights = unit_gauss(LEAST_ORDER)
        chord = np.sqrt(self.contact_radius**2 - s**2)[:, None]
        r = np.hypot(s[:, None], chord * np.sin(pi / 2 * v))
        integrand = self.limit(r) * chord * np.cos(pi / 2 * v) / r
        return np.asarray(s * (integrand @ weights))

    @property
    def _quadrature_order(self) -> int:
        """Number of Gauss nodes, for stick disc and slip annulus each, that resolves the layer
        thickness.
        """
        return LEAST_ORDER + int(4 * self.contact_radius / self.surface.thickness)

    @cached_property
    def _quadrature_nodes(self) -> tuple[Array, Array]:
        """Gauss nodes and weights over the stick disc, followed by those over the slip annulus
        [length].
        """
        a, c = self.contact_radius, self.stick_radius
        v, weights = unit_gauss(self._quadrature_order)
        return np.append(c * v, c + (a - c) * v), np.append(c * weights, (a - c) * weights)
