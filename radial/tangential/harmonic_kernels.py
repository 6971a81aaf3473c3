"""Integrals of products of Bessel functions for displacements by tractions on a half-space.

The traction and the displacement are angular harmonics ∝ cos mθ or sin mθ on rings of radii s and
r. The kernel G_m(r, s) = ∫₀^∞ J_m(kr) J_m(ks) dk = Q_{m-½}(χ)/(π√(rs)) with χ = (r² + s²)/(2rs)
(Watson, Bessel Functions 13.22) is logarithmic at r = s. It is computed with the recurrence of the
Legendre function Q in its stable direction. Two other integrals follow:

    ∫₀^∞ J_{m-1}(kr) J_{m+1}(ks) dk = (2m-1) G_{m-1} - 2m (r/s) G_m
    ∫₀^∞ J_m(kr) J_{m+1}(ks) dk     = r^m / s^{m+1} for r < s, else 0

The module `hat_integrals` integrates these kernels over the rings.
"""

from __future__ import annotations

from math import ceil

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipe, ellipkm1

from contact_scene.array_types import Array

# The upward recurrence loses about 1e-13 if the highest order times arccosh χ is below UPWARDS. The
# downward recurrence starts at an order where Q is below round-off.
UPWARDS = 3.0
ROUND_OFF = 18.0


def equal_order_kernels(highest: int, r: Array, s: Array, apart: Array) -> Array:
    """Compute the kernels G_m(r, s) = ∫₀^∞ J_m(kr) J_m(ks) dk for the harmonics 0 to M [1/length].

    The normal displacement of a half-space at radius r by a pressure at radius s is proportional to
    the kernel G_m, if the pressure is an angular harmonic ∝ cos mθ. The shape is (M + 1, …).

    highest  highest harmonic M
    r, s     radii of pairs of points, above 0 (…) [length]
    apart    distance |r - s|, given separately to avoid cancellation (…) [length]
    """
    total = r + s
    small = (apart / total) ** 2
    found = np.empty((highest + 1, *r.shape))
    whole = ellipkm1(small)
    found[0] = 2 / np.pi * whole / total
    chi = 1 + apart * (apart / (2 * r * s))
    border = UPWARDS / max(highest, 9)
    near = chi < np.cosh(border)
    _recur_upwards(found, near, chi[near], (r * s)[near], total[near], whole[near], small[near])
    far = ~near
    x = chi[far]
    ratio = np.exp(-np.arccosh(x))
    ratios = np.empty((highest + 1, *x.shape))
    for m in range(highest + ceil(ROUND_OFF / border), 0, -1):
        ratio = (m - 0.5) / (2 * m * x - (m + 0.5) * ratio)
        if m <= highest:
            ratios[m] = ratio
    for m in range(1, highest + 1):
        found[m, far] = found[m - 1, far] * ratios[m]
    return found


def _recur_upwards(
    found: Array,
    near: NDArray[np.bool_],
    chi: Array,
    moment: Array,
    total: Array,
    whole: Array,
    small: Array,
) -> None:
    """Write the kernels G_m(r, s), m ≥ 1, of pairs with r near s into `found`, which contains G_0.

    G_m = Q_{m-½}(χ)/(π√(rs)). The upward recurrence

        (m+½) Q_{m+½} = 2mχ Q_{m-½} - (m-½) Q_{m-3/2}

    is accurate for χ near 1.

    found          kernels of all pairs, harmonics on the first axis (M + 1, …) [1/length]
    near           true for the pairs to be computed (…)
    moment, total  r s and r + s of the pairs to be computed [length², length]
    whole          complete elliptic integral K of the modulus √(1 - `small`)
    small          (r - s)²/(r + s)² of the pairs to be computed
    """
    if len(found) > 1:
        once = 2 * chi * moment / total * whole - total * ellipe(1 - small)
        found[1, near] = once / (np.pi * moment)
    for m in range(1, len(found) - 1):
        up = 2 * m * chi * found[m, near] - (m - 0.5) * found[m - 1, near]
        found[m + 1, near] = up / (m + 0.5)
