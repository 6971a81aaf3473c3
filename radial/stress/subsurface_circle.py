"""Displacement and stress in a layered body below the pressure and shear of a loaded circle.

The fields are those of a half-space (`ray_integrals`), plus the contribution of the layers
(`layer_contribution`).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil

import numpy as np

from contact_scene.array_types import Array
from radial.response.bessel_functions import bessel_functions
from radial.response.wavenumbers import wave_blocks
from radial.stress.layer_contribution import Complex, LayerContribution, bessel_of_order
from radial.stress.loaded_circle import LoadedCircle
from radial.stress.ray_integrals import below_circle
from semi_analytical.frf.depth import Level, material_at
from semi_analytical.frf.stack import Stack

LEAST_POINTS = 64  # least number of quadrature points over the radius


class SubsurfaceCircle:
    """Displacement and stress of one body, with or without layers, below a loaded circle.

    circle    tractions on the body, over a circle
    stack     the body, with or without layers
    reach     largest distance of points from the centre over the radius of the circle
    highest   highest angular harmonic of the tractions
    fineness  factor on the numbers of points and wavenumbers, 1 by default
    """

    def __init__(
        self, circle: LoadedCircle, stack: Stack, reach: float, highest: int, fineness: int = 1
    ) -> None:
        self.circle, self.stack = circle, stack
        self.highest, self.fineness = highest, fineness
        if stack.layers:
            self._layers = LayerContribution(stack, circle.radius, reach, fineness)
            kappa, weights = self._layers.waves.rule
            self._sources = self._hankel_transforms(kappa) * (weights * kappa)

    def _hankel_transforms(self, kappa: Array) -> Complex:
        """Compute the Hankel transforms of the shear and pressure on the circle, for all harmonics.

        The transforms are H_{m+1}(q_r + i q_θ), H_{m-1}(q_r - i q_θ) and H_m(p) for the angular
        harmonic m, with the Hankel transform H_n of order n. The shape is (3, M + 1, κ), with the
        highest harmonic M. Layers contribute to the stress by these transforms.

        kappa  wavenumbers κ times the radius of the circle (κ,)
        """
        count = ceil(max(LEAST_POINTS, kappa[-1]) * self.fineness)
        eta, area = self.circle.disc_rule(count)
        outward, inward, p = self.circle.harmonics(eta, self.highest)
        found = np.zeros((3, self.highest + 1, len(kappa)), dtype=np.complex128)
        for some in wave_blocks(len(kappa), len(eta) * (self.highest + 3)):
            orders = list(bessel_functions(self.highest + 2, np.multiply.outer(kappa[some], eta)))
            for m in range(self.highest + 1):
                for part, field, order in ((0, outward, 1), (1, inward, -1), (2, p, 0)):
                    found[part, m, some] = bessel_of_order(orders, m + order) @ (area * field[m])
        return found

    def compute_fields(self, levels: Sequence[Level], x: Array, y: Array) -> Array:
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
            r, theta = np.hypot(x, y), np.arctan2(y, x)
            polar = self._layers.fields(self._sources, levels, r, theta)
            found += _cartesian_components(polar, np.cos(theta), np.sin(theta))
        return found


def _cartesian_components(polar: Array, cos: Array, sin: Array) -> Array:
    """Transform u_r, u_θ, u_z, σ_rr, θθ, zz, θz, rz, rθ to u_x,
    u_y, u_z, σ_xx, yy, zz, yz, xz, xy, both (levels, 9, n)."""
    u_r, u_t, u_z, rr, tt, zz, tz, rz, rt = np.moveaxis(polar, 1, 0)
    mean, half = (rr + tt) / 2, (rr - tt) / 2
    c2, s2 = cos * cos - sin * sin, 2 * sin * cos
    apart = half * c2 - rt * s2
    return np.stack(
        [
            cos * u_r - sin * u_t,
            sin * u_r + cos * u_t,
            u_z,
            mean + apart,
            mean - apart,
            zz,
            sin * rz + cos * tz,
            cos * rz - sin * tz,
            half * s2 + rt * c2,
        ],
        axis=1,
    )
