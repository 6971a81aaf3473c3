"""Reference compliance of a coated half-space on rings of traction, by Hankel transforms, for
tests.

The code shares nothing with the finite elements. The contact solver can therefore be tested without
finite elements, and their compliance against this one. Formulas are those of `hankel_responses`.
"""

from functools import cache

import numpy as np
from hankel_responses import Coating
from scipy.special import jv

from fem_reference.compliance.ring_compliance import RingCompliance
from fem_reference.compliance.ring_edge import HatEdge
from fem_reference.elasticity.hat_functions import hats_on
from fem_reference.plan import Path

# Beyond k = CUT / (width of a hat) hats hold a part of 1e-7 of their energy.
CUT = 40.0
ON_ELEMENT = 28  # Gauss points, for J_n(k r) over CUT radians on an element
ON_PANEL = 12  # Gauss points on half an oscillation of J_n(k r)² in k


def half_space(nu: float) -> Coating:
    """Homogeneous, of shear modulus 1."""
    return Coating(1.0, nu, 1.0, nu, 1.0)


@cache
def rings(per_unit: int, reach: float, highest: int, *bodies: Coating) -> RingCompliance:
    """The bodies' compliances on rings of equal distance, the lower body's first.

    per_unit  rings on a radius of 1; reach: largest radius
    """
    radii = np.arange(round(reach * per_unit) + 1) / per_unit
    k, weight = _wavenumbers(radii)
    responses = [body.response(k) for body in bodies]
    ss, tt, zz, _ = weight * k * sum(responses)
    # Lower less upper body: the entries that mix normal and tangential subtract.
    C = weight * k * sum(s * r[3] for s, r in zip((1, -1), responses, strict=False))
    hats = _hats(per_unit, len(radii), highest)
    nodes = np.sort(np.concatenate([radii, (radii[1:] + radii[:-1]) / 2]))
    harmonics = tuple(_harmonic(n, hats, ss, tt, zz, C) for n in range(highest + 1))
    basis = hats_on(nodes)
    return RingCompliance(
        radii=radii,
        areas=basis.weights,
        gap=0.0 * radii,
        harmonics=harmonics,
        path=Path.HARMONICS,
        motions=np.zeros((3, 2, len(radii))),
        stretch=basis.arms / basis.weights,
        reach=float(radii[-1]),
        edge=HatEdge(),
        beta=0.0,
    )


def _harmonic(n, hats, ss, tt, zz, C):
    """(3, rings, 3, rings)"""
    below = hats[n - 1] if n > 0 else -hats[1]
    above = hats[n + 1]
    nothing = np.zeros_like(above)
    a = np.stack([below - above, -below - above, nothing]) / 2
    b = -np.stack([below + above, -below + above, nothing]) / 2
    c = np.stack([nothing, nothing, hats[n]])
    size = 3 * len(above)
    a, b, c = (f.reshape(size, -1) for f in (a, b, c))
    A = (a * ss) @ a.T + (b * tt) @ b.T + (c * zz) @ c.T + (a * C) @ c.T + (c * C) @ a.T
    return A.reshape(3, len(above), 3, len(above))


def _wavenumbers(radii):
    end, panel = CUT / radii[1], np.pi / radii[-1]
    x, w = np.polynomial.legendre.leggauss(ON_PANEL)
    edges = np.linspace(0.0, end, int(np.ceil(end / panel)) + 1)
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (1 + x)).ravel(), (half * w).ravel()


@cache
def _hats(per_unit, count, highest):
    """∫ φ_i J_m(kr) r dr, (orders 0…highest + 1, rings, wavenumbers)."""
    radii = np.arange(count) / per_unit
    k, _ = _wavenumbers(radii)
    x, w = np.polynomial.legendre.leggauss(ON_ELEMENT)
    rising = (1 + x) / 2
    transforms = np.zeros((highest + 2, count, len(k)))
    for element in range(count - 1):
        r = radii[element] + rising / per_unit
        waves = _bessel(highest + 1, np.multiply.outer(r, k)) * (w * r / (2 * per_unit))[:, None]
        transforms[:, element] += np.einsum("g,mgk->mk", 1 - rising, waves)
        transforms[:, element + 1] += np.einsum("g,mgk->mk", rising, waves)
    return transforms


def _bessel(highest, x):
    """J_0 … J_highest, recurring downwards, which is stable."""
    J = [jv(highest, x), jv(highest - 1, x)]
    for order in range(highest - 1, 0, -1):
        J.append(2 * order / x * J[-1] - J[-2])
    return np.stack(J[::-1])
