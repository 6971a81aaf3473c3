"""Transform of the friction limit µp of a contact, for torsion.

Circumferential shear q has the Hankel transform of order 1 ∫₀ᵃ h(s) sin ks ds. The shear and the
function h are related by Abel transforms, with s = a t and r = a x,

    h = (2/π) s ∫ₛᵃ q/√(r²-s²) dr,    q = -d/dr ∫ᵣᵃ h/√(s²-r²) ds.

For q = µp with p = (E*/πa) [G(1)/√(1-x²) - ∫ₓ¹ G'(t)/√(t²-x²) dt] (see `disc`), the inner integral
is Legendre's K:

    h = (2µE*/π²) t m,    m = G(1) K'(t) - ∫ₜ¹ G'(τ) K'(t/τ) dτ/τ,    K'(t) = K(√(1-t²)).

m is logarithmic at t = 0. It is expanded on panels whose widths halve towards t = 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.special import ellipkm1

from contact_scene.array_types import Array
from radial.normal.disc import Disc
from radial.response.quadrature import unit_gauss

POINTS = 48
# PANELS: number of panels, down to t = 2^-26. NODES: Chebyshev points of a panel, whose
# interpolation has an error of 1e-16.
PANELS = 26
NODES = 26


@dataclass(frozen=True)
class FrictionLimit:
    """Transform N(t)/t of the circumferential shear q = µp, the friction limit of a contact.

    The shear is the Abel transform of N: q(a x) = -G d/dx ∫ₓ¹ N/√(t²-x²) dt, with the torsional
    modulus G and the contact radius a. The coordinate t runs from 0 at the axis to 1 at the contact
    edge. N/t is expanded in Chebyshev series on the intervals 2^-(n+1) < t < 2^-n, n = 0 … 25.
    Torsion uses N in the slip annulus, where the shear is at the friction limit.

    slopes  Chebyshev coefficients of N/t on each interval (intervals, nodes) [1]
    rates   Chebyshev coefficients of d(N/t)/dt on each interval, times 2^-n (intervals, nodes - 1)
            [1]
    """

    slopes: Array
    rates: Array

    @classmethod
    def of(cls, contact: Disc, friction: float, modulus: float) -> FrictionLimit:
        """Compute the transform N/t of the shear q = µp at the friction limit of a contact.

        contact   frictionless contact, which gives the pressure p
        friction  coefficient of friction µ
        modulus   torsional modulus G: reciprocal of the sum of 1/G of the outermost materials
                  [force/length²]
        """
        count = NODES + len(contact.layers)
        points = chebyshev.chebpts1(count)
        t = (3 + points) / 4 * 0.5 ** np.arange(PANELS)[:, None]
        fit = chebyshev.chebvander(points, count - 1) * (2.0 / count)
        fit[:, 0] /= 2
        slopes = friction / (modulus * contact.radius) * _unit_limit(contact, t) @ fit
        rates = np.asarray(4 * chebyshev.chebder(slopes, axis=1), dtype=np.float64)
        return cls(slopes, rates)

    def evaluate_transform(self, t: Array) -> Array:
        """Evaluate N/t at coordinates t,
        from 0 at the axis to 1 at the contact edge (any shape) [1]."""
        return _evaluate_panels(self.slopes, *_panel_positions(t))

    def transform_rate(self, t: Array) -> Array:
        """Evaluate d(N/t)/dt at coordinates t (any shape) [1],
        an integrand of the shear in the stick disc."""
        panel, place = _panel_positions(t)
        return np.asarray(_evaluate_panels(self.rates, panel, place) * 2.0**panel)


def _panel_positions(t: Array) -> tuple[NDArray[np.int64], Array]:
    """Find the panel n of each t, 2^-(n+1) < t < 2^-n, and the position in it, from -1 to 1."""
    panel = np.clip(np.floor(-np.log2(t)), 0, PANELS - 1).astype(np.int64)
    return panel, np.asarray(4 * t * 2.0**panel - 3)


def _evaluate_panels(coefficients: Array, panel: NDArray[np.int64], place: Array) -> Array:
    """Evaluate Chebyshev series (intervals, nodes) at places of panels by Clenshaw's recurrence."""
    last, now = np.zeros_like(place), np.zeros_like(place)
    for column in coefficients.T[:0:-1]:
        last, now = now, column[panel] + 2 * place * now - last
    return np.asarray(coefficients[panel, 0] + place * now - last)


def _unit_limit(contact: Disc, t: Array) -> Array:
    """Compute h/t of the shear that equals the pressure, for t from 0 to 1 [force/length].

        h/t = (2E*/π²) [G(1) K'(t) - ∫ₜ¹ G'(τ) K'(t/τ) dτ/τ]

    The shear µp at the friction limit has µ times this value. The integral is evaluated with τ = t
    exp(y).
    """
    v, weights = unit_gauss(POINTS + len(contact.profile.abel) + 2 * len(contact.layers))
    furthest = -np.log(t)[..., None]
    y = furthest * v
    inner = -contact.abel_function_rate(np.minimum(t[..., None] * np.exp(y), 1.0)) * ellipkm1(
        np.exp(-2 * y)
    )
    found = np.sum(inner * furthest * weights, axis=-1) + contact.edge * ellipkm1(t**2)
    return np.asarray(2 * contact.bodies.modulus / pi**2 * found)
