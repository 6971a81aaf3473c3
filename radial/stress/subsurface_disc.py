"""Displacement and stress in a layered body below the pressure of a frictionless contact."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

import numpy as np
from scipy.special import j0, j1

from contact_scene.array_types import Array
from radial.normal.disc import Disc
from radial.response.bodies import (
    LONGEST_WAVE,
    longest,
)
from radial.response.wavenumbers import waves
from radial.stress.half_space import below_pressure
from semi_analytical.frf.depth import Descent, Level, in_plane, material_at
from semi_analytical.frf.stack import Stack

# Largest wavenumber times distance, κ d: exp(-κ d) (κ d)² is below 1e-17 for larger values.
DIED_OUT = 48.0
BLOCK = 4096  # wavenumbers per block of Bessel functions


class SubsurfaceDisc:
    """Displacement and stress of one body below a frictionless contact on a disc.

    In the outermost layer they are those of a half-space (`half_space`) plus the contribution of
    the layers. This contribution has the images of the surface at a distance of at least 2h - z (h:
    thickness of the outermost layer, z: depth), and needs few wavenumbers. Below the outermost
    layer all contributions have a distance of at least z.

    contact   frictionless contact, which gives the pressure
    stack     the body, with or without layers
    reach     largest radius of points over the contact radius
    fineness  multiple of the number of wavenumbers
    """

    def __init__(self, contact: Disc, stack: Stack, reach: float, fineness: int = 1) -> None:
        self.contact, self.stack = contact, stack
        if not stack.layers:
            return
        a = contact.radius
        nearest = stack.layers[0].thickness / a
        chosen = waves(DIED_OUT / nearest, LONGEST_WAVE * longest(stack, a), reach, fineness)
        self._places, weights = chosen.rule
        scale = contact.bodies.modulus / (pi * a)
        self._sources = scale * weights * self._places * contact.wave_transform(chosen)

    def at(self, levels: Sequence[Level], r: Array) -> Array:
        """Compute displacement and stress at given depths and radii (levels, 6, n).

        The fields are u_r, u_z [length], σ_rr, σ_θθ, σ_zz, σ_rz [force/length²]. Raises ValueError
        for a depth in a rigid base.

        levels  depths, each with the layer that contains it
        r       radii of the points (n,) [length]
        """
        found = np.zeros((len(levels), 6, len(r)))
        x = r / self.contact.radius
        for n, level in enumerate(levels):
            if level.layer == 0:
                depth = level.depth / self.contact.radius
                found[n] = below_pressure(self.contact, material_at(self.stack, level), x, depth)
        if self.stack.layers:
            self._add_layers(levels, x, found)
        return found

    def _add_layers(self, levels: Sequence[Level], x: Array, found: Array) -> None:
        """Add the contribution of the layers to displacement and stress at all depths.

        levels  depths, each with the layer that contains it
        x       radii of the points over the contact radius (n,)
        found   fields to which the contribution is added, in place (levels, 6, n)
        """
        a, h = self.contact.radius, self.stack.layers[0].thickness
        for start in range(0, len(self._places), BLOCK):
            k = self._places[start : start + BLOCK]
            sources = self._sources[start : start + BLOCK]
            descent = Descent(self.stack, k / a)
            kx = np.multiply.outer(k, x)
            zeroth, first = j0(kx), j1(kx)
            second = np.divide(2 * first, kx, out=np.zeros_like(kx), where=kx > 0) - zeroth
            second[kx == 0] = 0.0
            for n, level in enumerate(levels):
                away = (2 * h - level.depth if level.layer == 0 else level.depth) / a
                if k[0] * away > DIED_OUT:
                    continue
                count = int(np.searchsorted(k, DIED_OUT / away))
                found[n] += _transformed(
                    _scalars(descent, level)[:, :count] * sources[:count],
                    *(bessel[:count] for bessel in (zeroth, first, second)),
                )


def _scalars(descent: Descent, level: Level) -> Array:
    """Return the responses of a layered body to pressure at one depth, for all wavenumbers (6, κ).

    A unit pressure wave causes the displacements U (along the wave vector) and W (normal), the
    tractions s (along the wave vector) and n (normal) on a horizontal plane, and in-plane stresses
    along and across the wave vector. The result is U, W, s, n, and half the sum and half the
    difference of these stresses.

    descent  propagation of the surface tractions to depths of the body
    level    depth and the layer that contains it
    """
    fields = descent.remainder(level)
    plane = in_plane(fields, material_at(descent.stack, level), descent.alpha)
    (U, W), (s, n) = fields.displacement[:, 1], fields.traction[:, 1]
    along, across = plane.along[1], plane.across[1]
    return np.stack([U, W, s, n, (along + across) / 2, (along - across) / 2])


def _transformed(scalars: Array, zeroth: Array, first: Array, second: Array) -> Array:
    """Compute the contribution of layers below a contact from its Hankel transforms (6, n).

    The fields are u_r, u_z, σ_rr, σ_θθ, σ_zz, σ_rz. The inverse Hankel transforms are sums over the
    wavenumbers κ.

    scalars                responses of the body (6, κ), times the transform of the pressure and
                           quadrature weights
    zeroth, first, second  Bessel functions J₀, J₁, J₂ at κ x (κ, n)
    """
    U, W, s, n, mean, half = scalars
    out, shear = -np.stack([U, -s]) @ first
    down, normal, mean_there = np.stack([W, -n, mean]) @ zeroth
    turned = half @ second
    return np.stack([out, down, mean_there - turned, mean_there + turned, normal, shear])
