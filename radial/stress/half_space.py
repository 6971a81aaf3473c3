"""Displacement and stress in a half-space below the pressure of a frictionless contact.

The waves exp(-kz) cos ks of the pressure are integrated over k in closed form: with c = z + is and
R² = r² + c², ∫ exp(-kc) J₀(kr) dk = 1/R and ∫ exp(-kc) J₁(kr) dk = r/(R (R + c)). One integral over
the transform G of the pressure (see `disc`) remains. Powers of k are integrated by parts, as
derivatives of G, to avoid cancellation near the surface. Lengths are in units of the contact
radius.
"""

from __future__ import annotations

from math import asinh, ceil, pi

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Array
from radial.normal.disc import Disc
from radial.normal.surface import AXIS, abel_integral, half_mean_pressure, pressure
from radial.response.quadrature import unit_gauss
from semi_analytical.frf.stack import HalfSpace

Complex = NDArray[np.complex128]

POINTS = 16
WIDTH = 1.5  # largest width of a panel of the coordinate y
SURFACE = 1e-16  # points at smaller depths over the contact radius are on the surface


def below_pressure(contact: Disc, material: HalfSpace, x: Array, depth: float) -> Array:
    """Compute displacement and stress in a half-space below a frictionless contact (6, n).

    The fields are u_r, u_z [length], σ_rr, σ_θθ, σ_zz, σ_rz [force/length²], at n points of equal
    depth.

    contact   frictionless contact, which gives the pressure
    material  elastic constants of the half-space
    x         radii of the points over the contact radius (n,)
    depth     depth of the points over the contact radius, at least 0
    """
    true, x = x, np.maximum(x, AXIS)
    G, nu = material
    modulus = contact.bodies.modulus / pi
    if depth < SURFACE:
        p, mean = pressure(contact, x), half_mean_pressure(contact, x)
        out, down = (
            -(1 - 2 * nu) * mean * contact.radius * true,
            modulus * abel_integral(contact, x),
        )
        radial = mean * (1 - 2 * nu)
        stress = [radial - p, -radial - 2 * nu * p, -p, np.zeros_like(p)]
        return np.stack([out / (2 * G), (1 - nu) * down / G, *stress])
    level, once, twice, outward, steep, steeper = _wave_integrals(contact, x, depth)
    moved, unit = modulus / (2 * G), modulus / contact.radius
    # Quantities divided by r avoid 0/0: u_r is r times `spread`, and
    # σ_θθ = 2G u_r/r - 2ν ∫ p~ exp(-kz) J₀ k dk.
    spread = -(1 - 2 * nu) * outward + depth * steep
    hoop = spread - 2 * nu * once
    return np.stack(
        [
            moved * true * spread,
            moved * (2 * (1 - nu) * level + depth * once),
            unit * (depth * twice - (1 + 2 * nu) * once - hoop),
            unit * hoop,
            -unit * (once + depth * twice),
            -unit * depth * true * steeper,
        ]
    )


def _wave_integrals(contact: Disc, x: Array, depth: float) -> tuple[Array, ...]:
    """Compute six integrals over wavenumbers for displacement and stress below a pressure (n,).

    The integrals are ∫ G~ exp(-κz) f dκ with f = J₀, κ J₀, κ² J₀, J₁/x, κ J₁/x and κ² J₁/x, in this
    order. The Bessel functions have the argument κx. G~ = ∫₀¹ G(t) cos κt dt is the cosine
    transform of the function G of which the pressure is the Abel transform.

    contact  frictionless contact, which gives G
    x        radii of the points over the contact radius, above 0 (n,)
    depth    depth z over the contact radius, above 0
    """
    offset, weights = _quadrature_offsets(contact, x, depth)
    t = x[:, None] + offset
    c, R = _complex_distances(x[:, None], depth, offset)
    by_G, by_rate = (
        weights * contact.evaluate_abel_function(t),
        weights * contact.abel_function_rate(t),
    )
    end, last = (part[:, 0] for part in _complex_distances(x[:, None], depth, 1 - x[:, None]))

    def integrate_by_parts(inside: Complex, outside: Complex) -> Array:
        """Return the integral ∫ G~ exp(-κz) κ f dκ over wavenumbers κ, integrated by parts (n,).

        The integral is a term of the stress at depth z. The pressure is the Abel transform of a
        function G(t), and G~ is the cosine transform of G. f is a Bessel function of κx at the
        radius x.

        inside   factor of dG/dt at the quadrature points (n, points)
        outside  factor of G(1), the boundary term at the contact edge t = 1 (n,)
        """
        return np.asarray((1j * contact.edge * outside - 1j * np.sum(by_rate * inside, 1)).real)

    out = 1 / (R * (R + c))
    return (
        np.asarray(np.sum(by_G / R, axis=1).real),
        integrate_by_parts(1 / R, 1 / last),
        integrate_by_parts(c / R**3, end / last**3),
        np.asarray(np.sum(by_G * out, axis=1).real),
        integrate_by_parts(out, 1 / (last * (last + end))),
        integrate_by_parts(1 / R**3, 1 / last**3),
    )


def _quadrature_offsets(contact: Disc, x: Array, depth: float) -> tuple[Array, Array]:
    """Return t - x (n, points) and weights of a quadrature over t from axis (0) to edge (1).

    Integrands contain 1/R with R = √(x² + (z + it)²), large near t = x. The points are dense there,
    by the substitution t = x + z sinh y.
    """
    first, last = np.arcsinh(-x / depth), np.arcsinh((1 - x) / depth)
    count = ceil(2 * asinh(max(1.0, float(np.max(x))) / depth) / WIDTH)
    v, shares = unit_gauss(POINTS + len(contact.layers))
    v = ((np.arange(count)[:, None] + v) / count).ravel()
    y = first[:, None] + (last - first)[:, None] * v
    weights = (last - first)[:, None] / count * np.tile(shares, count) * depth * np.cosh(y)
    return depth * np.sinh(y), weights


def _complex_distances(x: Array, depth: float, offset: Array) -> tuple[Complex, Complex]:
    """Compute c = z + it and R = √(x² + c²) at t = x + offset, for x (n, 1) and offset (n, points).
    1/R is the integral of exp(-κc) J₀(κx) over κ."""
    t = x + offset
    c = np.asarray(depth + 1j * t, dtype=np.complex128)
    return c, np.asarray(np.sqrt(depth**2 - offset * (x + t) + 2j * depth * t))
