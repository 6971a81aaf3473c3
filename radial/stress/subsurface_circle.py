"""Displacement and stress in a layered body below the tractions of a circle.

In the outermost layer they are those of a half-space (`ray_integrals`) plus the contribution of the
layers. This contribution has the images of the surface at a distance of at least 2h - z (h:
thickness of the outermost layer, z: depth), and needs few wavenumbers. Below the outermost layer
all contributions have a distance of at least z. The Hankel integrals are evaluated for every
harmonic m: with the Hankel transforms A = H_{m+1}(q_r + i q_θ) and B = H_{m-1}(q_r - i q_θ), waves
∝ exp(imψ) have the tractions (B - A)/2 along the wave vector and -(A + B)/2 across.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Array
from radial.response.bodies import (
    LONGEST_WAVE,
    longest,
)
from radial.response.wavenumbers import waves
from radial.stress.loaded_circle import LoadedCircle
from radial.stress.ray_integrals import below_circle
from radial.tangential.ring_energies import bessel_functions
from semi_analytical.frf.depth import Descent, Level, in_plane, material_at
from semi_analytical.frf.stack import Stack

Complex = NDArray[np.complex128]

# Largest wavenumber times distance, κ d: exp(-κ d) (κ d)² is below 1e-12, the accuracy of the
# tractions, for larger values.
DIED_OUT = 36.0
LEAST_POINTS = 64  # least number of quadrature points over the radius
MAX_AT_ONCE = 1 << 21  # numbers in a block of Bessel functions


class SubsurfaceCircle:
    """Displacement and stress of one body below a loaded circle.

    circle    tractions on the body
    stack     the body, with or without layers
    reach     largest distance of points from the centre over the radius of the circle
    highest   highest angular harmonic of the tractions
    fineness  multiple of the numbers of points and wavenumbers
    """

    def __init__(
        self, circle: LoadedCircle, stack: Stack, reach: float, highest: int, fineness: int = 1
    ) -> None:
        self.circle, self.stack = circle, stack
        self.highest, self.fineness = highest, fineness
        if stack.layers:
            a = circle.radius
            nearest = DIED_OUT * a / stack.layers[0].thickness
            chosen = waves(nearest, LONGEST_WAVE * longest(stack, a), reach, fineness)
            self._kappa, weights = chosen.rule
            self._sources = self._transforms() * (weights * self._kappa)

    def _transforms(self) -> Complex:
        """Compute the Hankel transforms of the shear and pressure of the circle, for all harmonics.

        They are A = H_{m+1}(q_r + i q_θ), B = H_{m-1}(q_r - i q_θ) and H_m(p), with the transform
        H_n of order n. The shape is (3, M + 1, κ), with the highest harmonic M. Lengths are in
        units of the radius of the circle.
        """
        count = ceil(max(LEAST_POINTS, self._kappa[-1]) * self.fineness)
        eta, area = self.circle.disc_rule(count)
        outward, inward, p = self.circle.harmonics(eta, self.highest)
        found = np.zeros((3, self.highest + 1, len(self._kappa)), dtype=np.complex128)
        for some in self._blocks(len(eta)):
            orders = self._orders(np.multiply.outer(self._kappa[some], eta))
            for m in range(self.highest + 1):
                for part, field, order in ((0, outward, 1), (1, inward, -1), (2, p, 0)):
                    found[part, m, some] = _order(orders, m + order) @ (area * field[m])
        return found

    def _orders(self, at: Array) -> list[Array]:
        """Return the Bessel functions J_0 … J_{M+2} at given arguments.

        M is the highest angular harmonic of the tractions.
        """
        return list(bessel_functions(self.highest + 2, at))

    def _blocks(self, points: int) -> list[slice]:
        """Return slices of the wavenumbers that limit the memory of the Bessel functions.

        points  number of points per wavenumber
        """
        step = max(MAX_AT_ONCE // (points * (self.highest + 3)), 1)
        return [slice(k, k + step) for k in range(0, len(self._kappa), step)]

    def at(self, levels: Sequence[Level], x: Array, y: Array) -> Array:
        """Compute displacement and stress at given depths and horizontal positions (levels, 9, n).

        The fields are u_x, u_y, u_z [length] and σ_xx, yy, zz, yz, xz, xy [force/length²]. Raises
        ValueError for a depth in a rigid base.

        levels  depths, each with the layer that contains it
        x, y    coordinates of the points in the scene's axes (n,) [length]
        """
        a = self.circle.radius
        found = np.zeros((len(levels), 9, len(x)))
        x, y = (x - self.circle.centre) / a, y / a
        for n, level in enumerate(levels):
            if level.layer == 0:
                material = material_at(self.stack, level)
                found[n] = below_circle(self.circle, material, x, y, level.depth / a, self.fineness)
        if self.stack.layers:
            self._add_layers(levels, x, y, found)
        return found

    def _add_layers(self, levels: Sequence[Level], x: Array, y: Array, found: Array) -> None:
        """Add the contribution of the layers to displacement and stress at all depths.

        levels  depths, each with the layer that contains it
        x, y    coordinates of the points from the centre of the circle, over its radius (n,)
        found   fields to which the contribution is added, in place (levels, 9, n)
        """
        a, h = self.circle.radius, self.stack.layers[0].thickness
        r, theta = np.hypot(x, y), np.arctan2(y, x)
        turns = np.exp(1j * np.arange(self.highest + 1)[:, None] * theta)
        polar = np.zeros_like(found)
        for some in self._blocks(len(x)):
            kappa, sources = self._kappa[some], self._sources[..., some]
            descent = Descent(self.stack, kappa / a)
            orders = self._orders(np.multiply.outer(kappa, r))
            for n, level in enumerate(levels):
                away = (2 * h - level.depth if level.layer == 0 else level.depth) / a
                count = int(np.searchsorted(kappa, DIED_OUT / away))
                if count:
                    polar[n] += _transformed(
                        descent, level, sources[..., :count], orders, turns, count
                    )
        found += _turned(polar, np.cos(theta), np.sin(theta))


def _order(orders: Sequence[Array], m: int) -> Array:
    """Return the Bessel function J_m of a positive or negative order m, from positive orders.

    orders  J_0, J_1, … at the arguments
    m       order
    """
    return orders[m] if m >= 0 else (-1) ** m * orders[-m]


def _transformed(
    descent: Descent, level: Level, sources: Complex, orders: Sequence[Array], turns: Complex,
    count: int,
) -> Array:  # fmt: skip
    """Compute the contribution of layers below a loaded circle at one depth (9, n).

    The fields are u_r, u_θ, u_z, σ_rr, θθ, zz, θz, rz, rθ, summed over wavenumbers and angular
    harmonics m.

    descent  propagation of the surface tractions to depths of the body
    level    depth and the layer that contains it
    sources  Hankel transforms of q_r + i q_θ, q_r - i q_θ and the pressure, times quadrature
             weights (3, M + 1, κ)
    orders   Bessel functions J_0, J_1, … at κ r (κ, n)
    turns    exp(imθ) at the points (M + 1, n)
    count    number of wavenumbers that contribute
    """
    fields = descent.remainder(level)
    plane = in_plane(fields, material_at(descent.stack, level), descent.alpha)
    total = np.zeros((9, turns.shape[1]))
    for m, turn in enumerate(turns):
        A, B, p = sources[:, m]
        along, across = (B - A) / 2, -(A + B) / 2

        def by_wave(entries: Array, along: Complex = along, p: Complex = p) -> Complex:
            """Return the response to the pressure and the traction along a wave vector (κ,).

            entries  responses to a unit traction along the wave vector and to a unit pressure (2,
                     κ)
            along    traction along the wave vector (κ,)
            p        pressure (κ,)
            """
            return np.asarray(entries[0, :count] * along + entries[1, :count] * p)

        U, W = by_wave(fields.displacement[0]), by_wave(fields.displacement[1])
        s, n = by_wave(fields.traction[0]), by_wave(fields.traction[1])
        lengthwise, sideways = by_wave(plane.along), by_wave(plane.across)
        V = fields.transverse_displacement[:count] * across
        t = fields.transverse_traction[:count] * across
        st = plane.shear[:count] * across
        half = (lengthwise - sideways) / 2
        level_J = _order(orders, m)[:count]
        W, n, mean = (f @ level_J for f in (W, -n, (lengthwise + sideways) / 2))
        out, out_z = (f @ _order(orders, m + 1)[:count] for f in (-(U + V), s + t))
        in_, in_z = (f @ _order(orders, m - 1)[:count] for f in (U - V, t - s))
        out_2 = (st - half) @ _order(orders, m + 2)[:count]
        in_2 = -(half + st) @ _order(orders, m - 2)[:count]
        apart = (out_2 + in_2) / 2
        polar = (
            (out + in_) / 2, (out - in_) / 2j, W, mean + apart, mean - apart, n,
            (out_z - in_z) / 2j, (out_z + in_z) / 2, (out_2 - in_2) / 2j,
        )  # fmt: skip
        total += (np.stack(polar) * turn).real
    return total


def _turned(polar: Array, cos: Array, sin: Array) -> Array:
    """Transform displacement and stress from cylindrical to x and y components (levels, 9, n).

    polar     u_r, u_θ, u_z, σ_rr, θθ, zz, θz, rz, rθ (levels, 9, n)
    cos, sin  cosine and sine of the angle θ of the points (n,)
    """
    u_r, u_t, u_z, rr, tt, zz, tz, rz, rt = np.moveaxis(polar, 1, 0)
    mean, half = (rr + tt) / 2, (rr - tt) / 2
    c2, s2 = cos * cos - sin * sin, 2 * sin * cos
    apart = half * c2 - rt * s2
    return np.stack([
        cos * u_r - sin * u_t, sin * u_r + cos * u_t, u_z,
        mean + apart, mean - apart, zz,
        sin * rz + cos * tz, cos * rz - sin * tz, half * s2 + rt * c2,
    ], axis=1)  # fmt: skip
