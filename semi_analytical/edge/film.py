"""Wiener-Hopf solution for the pressure near the contact edge of layered bodies.

Near its edge a contact is plane. Let s be the distance inwards from the edge, and X(k) = k E*
F_zz/2, with the wavenumber k, the frequency response F_zz of both bodies and the contact modulus E*
of the outermost materials (X = 1 for short waves). Pressure p and slope u' of the displacement obey

    i sign(k) X(|k|) p~(k) = u'~(k),    p = 0 for s < 0,    u' smooth for s > 0

With X = X+ X-, each factor analytic in a half-plane, pressures that end smoothly are sums of

    Φn(s) = L⁻¹[z^(-n-1/2)/X+(iz)](s), n = 1, 2, …,    ln X+(iz) = (z/π) ∫₀^∞ ln X(k)/(k² + z²) dk

L is the Laplace transform; Φn+1 is the integral of Φn. Without layers Φ1 = 2 √(s/π). With layers Φ1
has this value at distances below the thickness of the outermost layer, and 1/√X(0) times this value
far inside. Along an edge of curvature κ the Φn represent (1 - κ s/2) p, to first order in κ.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import comb, gamma, log, pi
from typing import TYPE_CHECKING

import numpy as np

from contact_scene import Body
from contact_scene.array_types import Field
from semi_analytical.frf.stack import Stack, stack_of
from semi_analytical.frf.surface import remainder_scalars

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

# X as a function of the wavenumber times the thickness.
Response = Callable[[Field], Field]

# Step and ranges of the logarithms of wavenumbers and distances, scaled by the thickness.
STEP = 0.05
WAVES = (log(1e-8), log(1e8))
DISTANCES = (log(1e-5), log(1e6))
# Half the number of terms of the numerical Laplace inversion (Abate and Whitt 1995), error 1e-7.
TERMS = 14
# Distance from the edge over the width of a square beyond which two points yield its mean.
DEEP = 2.0
POINTS, WEIGHTS = (half / 2 for half in np.polynomial.legendre.leggauss(4))
# Least contact radius over the thickness. The edge of a narrower contact is not plane over the
# thickness; the root of a homogeneous film is then more accurate (moduli 0.3 to 20 times the base).
NARROW = 2.0
# Mean of the root over the root of the width below which the ratio of the means is set to 1.
TOUCHED = 1e-6

# Thickness of the outermost layer in cell sides beyond which the edge cells see a half-space.
THICK = 16.0
# Relative difference of X from 1, or of two materials, below which a layer is neglected.
LEAST_CONTRAST = 1e-3
SAMPLED = np.geomspace(1e-3, 10.0, 41)


@dataclass(frozen=True)
class FilmLaw:
    """Law of the pressure near the contact edge of layered bodies, which replaces the root √s.

    s is the distance from the edge in units of the layer thickness. The law is Φ1 + c (Φ2 - ⅔ s
    Φ1), with two functions Φ1(s), Φ2(s) of the layers and a coefficient c. Without layers the law
    is √s for all c, up to a factor.

    response   normal compliance over that of the outermost material, as a function of wavenumber
               times thickness
    stretched  sides of a cell along x and y over the thickness
    """

    response: Response
    stretched: tuple[float, float]

    @cached_property
    def _pressure_ratios(self) -> CubicSpline:
        """Ratios of three basic edge pressures with layers to their values without layers, as
        splines.

        The basic pressures Φn, n = 1, 2, 3, end smoothly at a straight contact edge. Every edge
        pressure of the bodies is a sum of them. The interpolating splines have the argument ln s,
        with s the distance from the edge over the layer thickness.
        """
        from scipy.interpolate import CubicSpline  # its import takes as long as a small contact

        t, u = (np.arange(low, high, STEP) for low, high in (WAVES, DISTANCES))
        level = log(self.response(np.exp(t[:1]))[0])
        # The integral of level/(1 + k²) is known; the remainder vanishes at both ends.
        rest = np.log(self.response(np.exp(t))) - level / (1 + np.exp(2 * t))
        s, z = np.exp(u), TERMS * log(10) / 3 + 1j * pi * np.arange(2 * TERMS + 1)
        # The kernel depends on k s alone, so the integral over ln k is a correlation.
        ks = np.exp(t[0] + u[0] + STEP * np.arange(len(t) + len(u) - 1))
        kernel = STEP / pi * z[:, None] * ks / (ks**2 + z[:, None] ** 2)
        size = 2 ** int(np.ceil(np.log2(len(ks) + len(t))))
        spectrum = np.fft.fft(kernel, size) * np.fft.fft(rest[::-1], size)
        integral = np.fft.ifft(spectrum)[:, len(t) - 1 : len(t) - 1 + len(u)]
        factor = np.exp(-integral - level / 2 / (1 + z[:, None] / s))
        weights = (-1.0) ** np.arange(len(z)) * _euler_weights() * 10 ** (TERMS / 3)
        ratios = [
            weights @ (gamma(n + 0.5) * z[:, None] ** (-n - 0.5) * factor).real for n in (1, 2, 3)
        ]
        return CubicSpline(u, np.stack(ratios, axis=-1))

    def holds_within(self, radius: float) -> bool:
        """Return True if a contact is wide enough for the edge pressure law of layered bodies.

        The law assumes an edge that is straight over the layer thickness. The contact radius must
        be at least NARROW times the thickness.

        radius  radius of the largest circle inside the contact, in cells
        """
        return radius * min(self.stretched) >= NARROW

    def over_root(self, s: Field, c: Field) -> Field:
        """Compute the ratio of the edge pressure law of layered bodies to √s, at points.

        s  distances s > 0 of the points from the contact edge over the layer thickness, any shape
        c  coefficient of the second term of the law, shape of s
        """
        first, second, _ = self._interpolate_ratios(s)
        return np.asarray(first + c * s / 1.5 * (second - first))

    def means_over_root(
        self, s: Field, along: Field, across: Field, c: Field
    ) -> tuple[Field, Field]:
        """Compute the ratio of the mean edge pressure law to the mean of √s on n rectangles.

        The rectangles are cells or subcells. The second result is the derivative d ln(ratio) / d
        ln(mean of √s), which Newton's method for the edge requires. For rectangles outside the
        contact edge the results are 1 and 0. All arrays have the shape (n,).

        s              distance of each rectangle centre from the edge over the layer thickness;
                       negative outside
        along, across  change of this distance along the two sides of each rectangle
        c              coefficient of the second term of the law
        """
        b, a = np.maximum(np.abs(along), np.abs(across)), np.minimum(np.abs(along), np.abs(across))
        means = np.zeros((4, len(s)))
        deep = s > DEEP * (a + b)
        off = np.sqrt((a**2 + b**2) / 12)
        for sign in (1, -1):
            means[:, deep] += self._law_values(s[deep] + sign * off[deep], c[deep]) / 2
        cut = (s > -(a + b) / 2) & ~deep
        for y, weight in zip(POINTS, WEIGHTS, strict=True):
            for sign in (1, -1):
                end = np.maximum(s[cut] + sign * b[cut] / 2 + y * a[cut], 0.0)
                means[:, cut] += sign * weight / b[cut] * self._law_integrals(end, c[cut])
        law, law_rate, root, root_rate = np.where(means[2] > TOUCHED * np.sqrt(b), means, 1.0)
        return law / root, law_rate * root / (law * root_rate) - 1

    def _interpolate_ratios(self, s: Field) -> Field:
        """Interpolate Φ1, Φ2 and Φ3 with layers over those without (3, …) at distances s
        (…) from the edge, over the layer thickness; beyond the table, its end is used."""
        u = np.log(np.maximum(s, 1e-300))
        found = self._pressure_ratios(
            np.clip(u, self._pressure_ratios.x[0], self._pressure_ratios.x[-1])
        )
        return np.asarray(np.moveaxis(found, -1, 0))

    def _law_values(self, s: Field, c: Field) -> Field:
        """Compute the law with the coefficient c of its second term, its s-derivative,
        √s and its derivative (4, n), at distances s > 0 over the layer thickness."""
        root, step = np.sqrt(s), 0.02
        here, after, before = (self.over_root(s * f, c) for f in (1.0, 1 + step, 1 - step))
        return np.stack(
            [root * here, (here / 2 + (after - before) / (2 * step)) / root, root, 0.5 / root]
        )

    def _law_integrals(self, s: Field, c: Field) -> Field:
        """Integrate the rows of `_law_values` from 0 to s >= 0 (4, n).
        Means over cells that the edge cuts are differences of these integrals."""
        root = np.sqrt(s)
        first, second, third = self._interpolate_ratios(s)
        bent = c * s / 1.5
        of_root = s * root / 1.5
        return np.stack(
            [
                of_root * (second + bent * (third - second)),
                root * (first + bent * (second - first)),
                of_root,
                root,
            ]
        )


def _euler_weights() -> Field:
    """Return the weights of Euler summation of the alternating
    series of the Laplace inversion (2 TERMS + 1,)."""
    tail = np.cumsum([comb(TERMS, k) for k in range(TERMS)]) / 2**TERMS
    return np.concatenate([[0.5], np.ones(TERMS), tail[::-1]])


def film_law(lower: Body, upper: Body, spacing: tuple[float, float]) -> FilmLaw | None:
    """Return the law of the pressure near the contact edge of two bodies that may have layers.

    None is returned if the pressure follows √s over the cells along the edge, s the distance from
    the edge: without layers, with thick layers, or with layers as compliant as the base. None is
    also returned for a layer on a rigid base.

    lower, upper  bodies in contact
    spacing       cell sides along x and y [length]
    """
    stacks = [stack_of(body) for body in (lower, upper) if body.deforms]
    layered = [stack for stack in stacks if stack.layers]
    if not layered or any(stack.base is None for stack in layered):
        return None
    thickness = min(_uniform_depth(stack) for stack in layered)
    if thickness > THICK * max(spacing):
        return None
    unit = sum(map(_material_compliance, stacks))

    def response(k: Field) -> Field:
        alpha = k / thickness
        return np.asarray(
            1 + alpha / unit * np.sum([remainder_scalars(s, alpha).c22 for s in layered], axis=0)
        )

    if np.max(np.abs(response(SAMPLED) - 1)) < LEAST_CONTRAST:
        return None
    return FilmLaw(response, (spacing[0] / thickness, spacing[1] / thickness))


def _uniform_depth(stack: Stack) -> float:
    """Return the depth [length] below a surface down to which the elastic constants are uniform.

    This depth is the total thickness of the outermost layers with equal elastic constants and
    rigid bonds.

    stack  layers and base of the body
    """
    depth, outer = 0.0, stack.outer
    for layer in stack.layers:
        stiffer = abs(layer.shear_modulus / outer.shear_modulus - 1)
        if max(stiffer, abs(layer.poisson_ratio - outer.poisson_ratio)) > LEAST_CONTRAST:
            break
        depth += layer.thickness
        if layer.normal_opening or layer.tangential_jump:
            break
    return depth


def _material_compliance(stack: Stack) -> float:
    """Return (1 - ν)/G [length²/force] of the outermost material:
    wavenumber times displacement per pressure of its half-space."""
    outer = stack.outer
    return (1 - outer.poisson_ratio) / outer.shear_modulus
