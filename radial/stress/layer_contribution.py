"""Displacement and stress that the layers of a body add below given surface tractions.

Within the outermost layer, the fields are those of a half-space plus the contribution of the
layers. This contribution has the images of the surface at a distance of at least 2h - z (h:
thickness of the outermost layer, z: depth), and needs few wavenumbers. Below the outermost layer
all contributions have a distance of at least z. The Hankel integrals are evaluated for every
harmonic m: with the Hankel transforms A = H_{m+1}(q_r + i q_θ) and B = H_{m-1}(q_r - i q_θ), waves
∝ exp(imψ) have the tractions (B - A)/2 along the wave vector and -(A + B)/2 across.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Array
from radial.response.bessel_functions import bessel_functions
from radial.response.bodies import (
    LONGEST_WAVE,
    least_wavenumber,
)
from radial.response.wavenumbers import wave_blocks, waves
from semi_analytical.frf.depth import Descent, Level, in_plane_stresses, material_at
from semi_analytical.frf.stack import Stack

Complex = NDArray[np.complex128]

# Largest wavenumber times distance, κ d: exp(-κ d) (κ d)² is below 1e-12, the accuracy of the
# tractions, for larger values.
DIED_OUT = 36.0


class LayerContribution:
    """Displacement and stress that the layers of one body add to those of a half-space.

    The body carries tractions on a circle of its surface. The half-space has the material of the
    outermost layer.

    stack     the body with its layers
    radius    radius of the circle, the unit of length of wavenumbers and positions [length]
    reach     largest distance of points from the axis over this radius
    fineness  factor on the number of wavenumbers, 1 by default
    """

    def __init__(self, stack: Stack, radius: float, reach: float, fineness: int) -> None:
        self.stack, self.radius = stack, radius
        nearest = DIED_OUT * radius / stack.layers[0].thickness
        self.waves = waves(nearest, LONGEST_WAVE * least_wavenumber(stack, radius), reach, fineness)

    def fields(
        self, sources: NDArray[np.inexact], levels: Sequence[Level], r: Array, theta: Array
    ) -> Array:
        """Compute displacement and stress by layers at given depths and positions (levels, 9, n).

        In the outermost layer the caller adds the results to the fields of a half-space. Below the
        outermost layer the results are the whole fields. The fields are u_r, u_θ, u_z [length] and
        σ_rr, θθ, zz, θz, rz, rθ [force/length²].

        sources   Hankel transforms of q_r + i q_θ, q_r - i q_θ and the pressure for the angular
                  harmonics 0 … M, times quadrature weights (3, M + 1, κ)
        levels    depths, each with the layer that contains it
        r, theta  distances of the n points from the axis over the radius of the circle, and angles
                  (n,)
        """
        h, found = self.stack.layers[0].thickness, np.zeros((len(levels), 9, len(r)))
        highest = sources.shape[1] - 1
        turns = np.exp(1j * np.arange(highest + 1)[:, None] * theta)
        places = self.waves.rule[0]
        for some in wave_blocks(len(places), len(r) * (highest + 3)):
            kappa = places[some]
            descent = Descent(self.stack, kappa / self.radius)
            orders = list(bessel_functions(highest + 2, np.multiply.outer(kappa, r)))
            for total, level in zip(found, levels, strict=True):
                away = 2 * h - level.depth if level.layer == 0 else level.depth
                count = int(np.searchsorted(kappa, DIED_OUT * self.radius / away))
                if count:
                    part = sources[..., some][..., :count]
                    total += _inverse_transform(descent, level, part, orders, turns, count)
        return found


def bessel_of_order(orders: Sequence[Array], m: int) -> Array:
    """Return the Bessel function J_m of any integer order m, from Bessel functions of orders m ≥ 0.

    A negative order follows from J_{-m} = (-1)^m J_m.

    orders  J_0, J_1, … at equal arguments
    m       order, positive or negative
    """
    return orders[m] if m >= 0 else (-1) ** m * orders[-m]


def _inverse_transform(
    descent: Descent,
    level: Level,
    sources: NDArray[np.inexact],
    orders: Sequence[Array],
    turns: Complex,
    count: int,
) -> Array:
    """Sum waves to displacement and stress that layers add at one depth (9, n).

    The fields are u_r, u_θ, u_z, σ_rr, θθ, zz, θz, rz, rθ. The sums are over the wavenumbers κ and
    the angular harmonics m = 0 … M.

    descent  object that propagates the surface tractions to depths of the body
    level    depth and the layer that contains it
    sources  Hankel transforms of q_r + i q_θ, q_r - i q_θ and the pressure, times quadrature
             weights (3, M + 1, κ)
    orders   Bessel functions J_0, J_1, … at κ r (κ, n)
    turns    exp(imθ) at the n points (M + 1, n)
    count    number of wavenumbers that contribute at this depth
    """
    fields = descent.remainder(level)
    plane = in_plane_stresses(fields, material_at(descent.stack, level), descent.alpha)
    total = np.zeros((9, turns.shape[1]))
    for m, turn in enumerate(turns):
        A, B, p = sources[:, m]
        along, across = (B - A) / 2, -(A + B) / 2

        def sum_responses(entries: Array, along: Complex = along, p: Complex = p) -> Complex:
            """Sum the responses to the pressure and to the traction along a wave vector (κ,).

            entries  responses at the depth to a unit traction along the wave vector and to a unit
                     pressure (2, κ)
            along    transform of the traction along the wave vector (κ,)
            p        transform of the pressure (κ,)
            """
            return np.asarray(entries[0, :count] * along + entries[1, :count] * p)

        U, W = sum_responses(fields.displacement[0]), sum_responses(fields.displacement[1])
        s, n = sum_responses(fields.traction[0]), sum_responses(fields.traction[1])
        lengthwise, sideways = sum_responses(plane.along), sum_responses(plane.across)
        V = fields.transverse_displacement[:count] * across
        t = fields.transverse_traction[:count] * across
        st = plane.shear[:count] * across
        half = (lengthwise - sideways) / 2
        level_J = bessel_of_order(orders, m)[:count]
        W, n, mean = (f @ level_J for f in (W, -n, (lengthwise + sideways) / 2))
        out, out_z = (f @ bessel_of_order(orders, m + 1)[:count] for f in (-(U + V), s + t))
        in_, in_z = (f @ bessel_of_order(orders, m - 1)[:count] for f in (U - V, t - s))
        out_2 = (st - half) @ bessel_of_order(orders, m + 2)[:count]
        in_2 = -(half + st) @ bessel_of_order(orders, m - 2)[:count]
        apart = (out_2 + in_2) / 2
        polar = (
            (out + in_) / 2,
            (out - in_) / 2j,
            W,
            mean + apart,
            mean - apart,
            n,
            (out_z - in_z) / 2j,
            (out_z + in_z) / 2,
            (out_2 - in_2) / 2j,
        )
        total += (np.stack(polar) * turn).real
    return total
