"""Frictionless indentation of a layered half-space by an axisymmetric indenter, semi-closed.

The transform of the pressure is p~(k) = ∫₀ᵃ g(s) cos ks ds. Contact on the disc r < a is then a
Fredholm equation of the second kind for g (Lebedev and Ufliand 1958; for layers, Perriot and
Barthel 2004):

    (π/E*) g(s) + (2/E*) ∫₀ᵃ K(s, t) g(t) dt = approach - S(s),
    K(s, t) = ∫₀^∞ (X(k) - 1) cos ks cos kt dk,   X(k) = k E* F(k) / 2.

F(k) is the normal displacement per unit pressure of wavenumber k, E* the contact modulus for short
waves, and S(s) = s ∫₀ˢ f'(r)/√(s²-r²) dr of the profile f: s²/R for a paraboloid, 0 for a flat
punch. K is smooth on the scale of the layer thickness, so that Gauss's rule converges
geometrically. Without layers K = 0.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import pi

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from verification.closed_forms.hertz import half_chord
from verification.closed_forms.quadrature import composite_gauss, unit_gauss

Array = NDArray[np.float64]
Compliance = Callable[[Array], Array]

# exp(-2 k h) (k h)² is below 1e-17 from here on.
REACH = 24.0
PANEL_POINTS = 16
PANEL_PHASE = 8.0
# Smallest wavenumber over 1/(a + h). Below it, layers with modulus ratios up to 1e6 have no effect.
LONGEST_WAVE = 1e-8
PRESSURE_ORDER = 20


@dataclass(frozen=True)
class LayeredSurface:
    """Represent the compliance of the surfaces of two layered bodies, in wavenumber space.

    compliance  F(k) of both bodies together [length³/force]: displacement per unit traction of
                wavenumber k, along the traction; a vectorised function
    modulus     limit of 2/(k F) for short waves, which see the outermost materials: E* for pressure
                [force/length²]
    thickness   thickness of the thinner outermost layer: the scale on which F approaches this limit
                [length]
    """

    compliance: Compliance
    modulus: float
    thickness: float

    def excess(self, k: Array) -> Array:
        """Compute the relative change of the compliance by the layers at wavenumbers k [1].

        The change X(k) - 1 = k E* F(k)/2 - 1 is relative to a half-space of the outermost material.
        """
        return np.asarray(k * self.modulus * self.compliance(k) / 2 - 1)


@dataclass(frozen=True)
class LayeredIndentation:
    """Hold the frictionless contact of a paraboloid or flat punch with layered bodies.

    surface         normal compliance of the bodies
    contact_radius  contact radius a [length]
    radius          radius of curvature R of the paraboloid [length]; infinite for a flat punch
    approach        approach since first touch [length]
    load            normal load [force]
    transform       (X - 1) p~ at the wavenumbers, times their quadrature weights [force/length]; X
                    - 1 is the relative change of the compliance by the layers, p~ the transform of
                    the pressure
    wavenumbers     nodes of the Gauss rule in the wavenumber k [1/length]
    """

    surface: LayeredSurface
    contact_radius: float
    radius: float
    approach: float
    load: float
    transform: Array
    wavenumbers: Array

    def pressure(self, r: ArrayLike) -> Array:
        """Compute the contact pressure at distance r from the axis [force/length²].

        The pressure is zero outside the contact.
        """
        a, rho = self.contact_radius, np.abs(np.asarray(r, dtype=float))
        chord = half_chord(a, rho)
        smooth = chebyshev.chebval(2 * np.minimum(rho / a, 1) ** 2 - 1, self._smooth_response)
        if np.isfinite(self.radius):
            return np.asarray(chord * smooth)
        return np.asarray(np.divide(smooth, chord, out=np.zeros_like(rho), where=chord > 0))

    @cached_property
    def _smooth_response(self) -> Array:
        """Chebyshev coefficients of the pressure without its square root at the contact edge.

        The variable is 2r²/a² - 1 (a: contact radius). The expanded function is p/√(a²-r²) for a
        paraboloid, and p √(a²-r²) for a flat punch.
        """
        count = _quadrature_order(self.contact_radius, self.surface.thickness)
        x = chebyshev.chebpts1(count)
        a = self.contact_radius
        r, chord = a * np.sqrt((1 + x) / 2), a * np.sqrt((1 - x) / 2)
        rim_factor = 1 / chord if np.isfinite(self.radius) else chord
        values = self._pressure_at(r, chord) * rim_factor
        return np.asarray(
            np.linalg.solve(chebyshev.chebvander(x, count - 1), values)  # well conditioned here
        )

    def _pressure_at(self, r: Array, chord: Array) -> Array:
        """Compute the pressure at radii r from the solution g of the integral equation
        [force/length²].

        The pressure is g(a)/√(a²-r²) - ∫ᵣᵃ g'(s)/√(s²-r²) ds, where g is the cosine transform of
        the pressure over the contact radius a.

        chord  √(a²-r²) [length]
        """
        v, weights = unit_gauss(
            PRESSURE_ORDER + _quadrature_order(self.contact_radius, self.surface.thickness)
        )
        # s² = r² + u² removes the root.
        s = np.hypot(r[:, None], chord[:, None] * v)
        rates = np.array([self._rate(row) for row in s])
        edge = 0.0 if np.isfinite(self.radius) else self._g(np.array([self.contact_radius]))[0]
        return np.asarray(edge / chord - chord * ((rates / s) @ weights))

    def _g(self, s: Array) -> Array:
        k = self.wavenumbers
        right = self.approach - s**2 / self.radius
        E = self.surface.modulus
        return np.asarray(
            E / pi * right - 2 / pi * np.cos(np.multiply.outer(s, k)) @ self.transform
        )

    def _rate(self, s: Array) -> Array:
        k = self.wavenumbers
        E = self.surface.modulus
        bent = np.sin(np.multiply.outer(s, k)) @ (k * self.transform)
        return np.asarray(-2 * E / pi * s / self.radius + 2 / pi * bent)


def flat_punch(surface: LayeredSurface, contact_radius: float) -> LayeredIndentation:
    """Solve the contact of a flat punch with layered bodies at the approach 1.

    The load of the result is then the contact stiffness.

    surface         normal compliance of the bodies
    contact_radius  radius of the punch [length]
    """
    return _solve_fredholm(surface, contact_radius, np.inf)


def paraboloid(surface: LayeredSurface, radius: float, contact_radius: float) -> LayeredIndentation:
    """Solve the frictionless contact of a paraboloid with layered bodies for a given contact
    radius.

    surface         normal compliance of the bodies
    radius          radius of curvature of the paraboloid [length]
    contact_radius  contact radius a [length]
    """
    return _solve_fredholm(surface, contact_radius, radius)


def paraboloid_under(load: float, surface: LayeredSurface, radius: float) -> LayeredIndentation:
    """Solve the frictionless contact of a paraboloid with layered bodies under a given normal load.

    load     normal load [force]
    surface  normal compliance of the bodies
    radius   radius of curvature of the paraboloid [length]
    """
    hertz = float(np.cbrt(3 * load * radius / (4 * surface.modulus)))

    def excess(scale: float) -> float:
        return float(np.log(paraboloid(surface, radius, hertz * np.exp(scale)).load / load))

    low = high = 0.0
    while excess(low) > 0:
        low -= 0.5
    while excess(high) < 0:
        high += 0.5
    scale = brentq(excess, low - 1e-3, high + 1e-3, xtol=1e-15, rtol=1e-15)
    return paraboloid(surface, radius, hertz * float(np.exp(scale)))


def _solve_fredholm(surface: LayeredSurface, a: float, radius: float) -> LayeredIndentation:
    k, weight = wavenumbers(a, surface.thickness)
    weighted = weight * surface.excess(k)
    s, weights = unit_gauss(_quadrature_order(a, surface.thickness))
    s, weights = a * s, a * weights
    E = surface.modulus
    cosines = np.cos(np.outer(s, k))
    kernel = (cosines * weighted) @ cosines.T
    matrix = pi / E * np.eye(len(s)) + 2 / E * kernel * weights
    by_approach, by_profile = np.linalg.solve(
        matrix, np.column_stack([np.ones_like(s), s**2 / radius])
    ).T
    approach = 1.0
    if np.isfinite(radius):
        # The pressure vanishes at the edge: g(a) = 0, with g(a) from the integral equation.
        edge = np.cos(a * k) * weighted @ (cosines.T * weights)
        approach = float(
            (a**2 / radius - 2 / E * (edge @ by_profile)) / (1 - 2 / E * (edge @ by_approach))
        )
    g = approach * by_approach - by_profile
    transform = weighted * (cosines.T @ (weights * g))
    load = 2 * pi * float(weights @ g)
    return LayeredIndentation(surface, a, radius, approach, load, transform, k)


def _quadrature_order(a: float, thickness: float) -> int:
    """Return the number of Gauss nodes over the contact radius that resolves the layer thickness.

    a          contact radius [length]
    thickness  thickness of the thinnest outermost layer [length]
    """
    return 50 + int(4 * a / thickness)


def wavenumbers(a: float, thickness: float) -> tuple[Array, Array]:
    """Return nodes and weights of a composite Gauss rule in the wavenumber k [1/length].

    The rule extends to 24 over the layer thickness, where the effect of the layers has vanished.
    The panels double in width from the smallest wavenumber, up to the width that resolves the
    oscillation of cos ka.

    a          contact radius [length]
    thickness  thickness of the thinnest outermost layer [length]
    """
    limit, step = REACH / thickness, PANEL_PHASE / (a + thickness)
    first = LONGEST_WAVE / (a + thickness)
    doublings = first * 2.0 ** np.arange(np.ceil(np.log2(step / first)) + 1)
    equal = np.arange(doublings[-1] + step, limit, step)
    bounds = np.concatenate([[0.0], doublings, equal, [limit]])
    bounds = np.append(bounds[bounds < limit], limit)
    return composite_gauss(bounds, PANEL_POINTS)
