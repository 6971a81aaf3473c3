"""Pressure and surface displacement of a frictionless contact on a disc, at any radius."""

from __future__ import annotations

from math import pi

import numpy as np
from scipy.special import j0

from contact_scene.array_types import Array
from radial.normal.disc import Disc
from radial.response.quadrature import (
    unit_gauss,
)
from radial.response.wavenumbers import wave_blocks

POINTS = 48
# Smallest radius over the contact radius in integrals. It changes no digit of the results.
AXIS = 1e-7
PLACE = 1e-9  # error of the position of the largest pressure over the contact radius


def pressure(contact: Disc, x: Array) -> Array:
    """Compute the pressure of a frictionless contact at given radii (n,) [force/length²].

    The pressure is 0 outside the contact, and infinite at an apex or a rim of the indenter.

        p(a x) = (E*/π a) [G(1)/√(1-x²) - ∫ₓ¹ G'(t)/√(t²-x²) dt]

    G is the function of which the pressure is the Abel transform, E* the contact modulus. The
    substitution t = x cosh y makes the integrand smooth.

    contact  frictionless contact of radius a
    x        radii over the contact radius (n,)
    """
    found = np.zeros_like(x)
    inside = x < 1
    rho = x[inside]
    chord, axis = np.sqrt((1 - rho) * (1 + rho)), rho == 0
    v, weights = unit_gauss(POINTS + len(contact.profile.abel) + len(contact.layers))
    furthest = np.arcsinh(chord / np.where(axis, 1.0, rho))
    t = np.minimum(rho[:, None] * np.cosh(furthest[:, None] * v), 1.0)
    total = furthest * (contact.abel_function_rate(t) @ weights)
    total[axis] = -np.inf if contact.profile.apex else weights @ (contact.abel_function_rate(v) / v)
    found[inside] = contact.bodies.modulus / (pi * contact.radius) * (contact.edge / chord - total)
    return found


def half_mean_pressure(contact: Disc, x: Array) -> Array:
    """Compute half the mean pressure within given radii of a contact (n,) [force/length²].

    The value at x is ∫₀ˣ p x dx / x². The radial surface displacement of a half-space by the
    pressure is proportional to this value times x.

    contact  frictionless contact, which gives the pressure p
    x        radii over the contact radius (n,)
    """
    found, x = np.empty_like(x), np.maximum(x, AXIS)
    inside = x < 1
    found[~inside] = contact.load / (2 * pi * (contact.radius * x[~inside]) ** 2)
    rho = x[inside][:, None]
    chord = np.sqrt((1 - rho) * (1 + rho))
    v, weights = unit_gauss(POINTS + len(contact.profile.abel) + len(contact.layers))
    furthest = np.arcsinh(chord / rho)
    y = furthest * v
    further = furthest[:, 0] * (
        (contact.abel_function_rate(np.minimum(rho * np.cosh(y), 1.0)) * np.sinh(y) * np.exp(-y))
        @ weights
    )
    nearer = (contact.abel_function_rate(rho * v) * v) @ weights
    unit = contact.bodies.modulus / (pi * contact.radius)
    found[inside] = unit * (contact.edge / (1 + chord[:, 0]) - further - nearer)
    return found


def largest_pressure(contact: Disc, x: Array) -> float:
    """Find the largest pressure of a frictionless contact, at or between places [force/length²].

    The maximum is searched near the place of largest pressure. The value at this place is returned
    if it is the innermost one, or if the pressure is infinite at a rim.

    contact  frictionless contact
    x        places: radii over the contact radius, increasing (n,)
    """
    p = pressure(contact, x)
    at = int(np.argmax(p))
    if at == 0 or contact.edge:
        return float(p[at])
    # Takes as long to import as a contact takes to solve, and most pressures peak at the axis.
    from scipy.optimize import minimize_scalar

    found = minimize_scalar(
        lambda place: -float(pressure(contact, np.array([place]))[0]),
        bounds=(x[at - 1], min(x[at + 1], 1.0)),
        method="bounded",
        options={"xatol": PLACE},
    )
    return max(float(p[at]), -float(found.fun))


def abel_integral(contact: Disc, x: Array) -> Array:
    """Compute ∫ G(t)/√(x²-t²) dt over t < x and t < 1, for the surface displacement (n,) [length].

    G is the function of which the pressure is the Abel transform. t runs from 0 at the axis to 1 at
    the contact edge. 2/π times the integral is the normal surface displacement of both bodies
    without the contribution of their layers.

    contact  frictionless contact, which gives G
    x        radii over the contact radius, above 0 (n,)
    """
    v, weights = unit_gauss(POINTS + len(contact.profile.abel) + len(contact.layers))
    angle = np.arcsin(np.minimum(1 / x, 1.0))
    return np.asarray(
        angle * (contact.evaluate_abel_function(x[:, None] * np.sin(angle[:, None] * v)) @ weights)
    )


def displacement(contact: Disc, x: Array) -> Array:
    """Compute the normal surface displacement outside a frictionless contact (n,) [length].

        u_z = (2/π) [∫₀¹ G(t)/√(x²-t²) dt + ∫₀^∞ (X - 1) G~ J₀(κx) dκ]

    G is the function of which the pressure is the Abel transform and G~ its cosine transform. X - 1
    is the contribution of the layers to the normal response at the wavenumber κ, relative to
    half-spaces. u_z is the sum of both bodies, positive into each body. The gap outside the contact
    follows from u_z.

    contact  frictionless contact
    x        radii over the contact radius, above 1 (n,)
    """
    direct = abel_integral(contact, x)
    if not contact.bodies.layered:
        return np.asarray(2 / pi * direct)
    reach = 2.0 ** np.ceil(np.log2(np.max(x)))  # powers of 2: few values, which contacts share
    waves = contact.bodies.waves(contact.radius, float(reach))
    places, weights = waves.rule
    spectrum = weights * contact.bodies.excess(waves, contact.radius)
    spectrum *= contact.wave_transform(waves)
    added = np.zeros_like(x)
    for some in wave_blocks(len(spectrum), len(x)):
        added += j0(np.multiply.outer(x, places[some])) @ spectrum[some]
    return np.asarray(2 / pi * (direct + added))
