"""Indentation by an arbitrary axisymmetric profile, semi-closed (Galin 1946; Sneddon 1965).

With S(s) = s ∫₀ˢ f'(r)/√(s²-r²) dr of the profile f(r) and the contact radius a: approach = S(a),
load = 2E* ∫₀ᵃ (S(a) - S(s)) ds; pressure and gap are Abel integrals of S. Valid if the contact is
the full disc r < a (S increasing) and slopes are small, for frictionless faces or uncoupled pairs.
Substitutions make every integrand smooth for Gauss's rule; for profiles smooth on [0, a] the error
is rounding.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from verification.closed_forms.validity import require_positive, unit_gauss

RadialFunction = Callable[[NDArray[np.float64]], NDArray[np.float64]]

PROFILE_ORDER = 60
LOAD_ORDER = 60
PRESSURE_ORDER = 120


@dataclass(frozen=True)
class AxisymmetricProfile:
    """Profile f(r) of an indenter, given by its derivatives on 0 <= r, vectorised.

    slope      f'(r) [1]
    curvature  f''(r) [1/length]
    """

    slope: RadialFunction
    curvature: RadialFunction

    def penetration(self, s: ArrayLike) -> NDArray[np.float64]:
        """Compute S(s) = s ∫₀^{π/2} f'(s sin φ) dφ [length]: the approach for the contact radius
        s."""
        r, weights = _arc(s)
        return np.asarray(np.asarray(s) * (self.slope(r) * weights).sum(axis=-1))

    def penetration_rate(self, s: ArrayLike) -> NDArray[np.float64]:
        """Compute the derivative dS/ds [1]."""
        r, weights = _arc(s)
        return np.asarray(((self.slope(r) + r * self.curvature(r)) * weights).sum(axis=-1))


@dataclass(frozen=True)
class AxisymmetricIndentation:
    """Result of `axisymmetric_indentation`: load [force], approach [length], fields by method."""

    profile: AxisymmetricProfile
    contact_modulus: float
    contact_radius: float
    load: float
    approach: float

    def pressure(self, r: ArrayLike) -> NDArray[np.float64]:
        """Compute the pressure (E*/π) ∫ᵣᵃ S'(s)/√(s²-r²) ds [force/length²], zero outside.

        r = 0 is allowed unless the profile has an apex, where the pressure is infinite.
        """
        a, rho = self.contact_radius, np.abs(np.asarray(r, dtype=float))
        chord = np.sqrt(np.maximum((a - rho) * (a + rho), 0))[..., None]
        v, weights = unit_gauss(PRESSURE_ORDER)
        # s² = r² + u² removes the root; u = chord v³ resolves the near-singularity of an apex.
        s = np.hypot(np.broadcast_to(rho[..., None], np.shape(rho) + v.shape), chord * v**3)
        rate = np.divide(self.profile.penetration_rate(s), s, out=np.zeros_like(s), where=s > 0)
        integral = (rate * chord * 3 * v**2 * weights).sum(axis=-1)
        return np.asarray(self.contact_modulus / pi * integral)

    def gap(self, r: ArrayLike) -> NDArray[np.float64]:
        """Compute the deformed gap (2/π) ∫ₐʳ (S(s) - S(a))/√(r²-s²) ds [length], zero inside."""
        a, rho = self.contact_radius, np.abs(np.asarray(r, dtype=float))
        outside = np.maximum(rho, a)
        start = np.arcsin(a / outside)[..., None]
        v, weights = unit_gauss(LOAD_ORDER)
        s = outside[..., None] * np.sin(start + (pi / 2 - start) * v)
        excess = self.profile.penetration(s) - self.approach
        return np.asarray(2 / pi * (pi / 2 - start[..., 0]) * (excess * weights).sum(axis=-1))


def axisymmetric_indentation(
    profile: AxisymmetricProfile, contact_radius: float, contact_modulus: float
) -> AxisymmetricIndentation:
    """Compute load, approach and fields of a profile at a contact radius (Sneddon 1965).

    contact_radius   a > 0 [length]
    contact_modulus  E* > 0 [force/length²]
    """
    require_positive(contact_radius=contact_radius, contact_modulus=contact_modulus)
    v, weights = unit_gauss(LOAD_ORDER)
    # integrated by parts, 2E* ∫ s S' ds: no difference of nearly equal numbers
    s = contact_radius * v
    load = 2 * contact_modulus * contact_radius * (s * profile.penetration_rate(s) * weights).sum()
    approach = profile.penetration(contact_radius)
    return AxisymmetricIndentation(
        profile, contact_modulus, contact_radius, float(load), float(approach)
    )


def _arc(s: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    v, weights = unit_gauss(PROFILE_ORDER)
    r = np.asarray(s, dtype=float)[..., None] * np.sin(pi / 2 * v)
    return np.asarray(r), pi / 2 * weights
