"""Displacement and stress in a layered body below the pressure of a frictionless contact."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

import numpy as np

from contact_scene.array_types import Array
from radial.normal.disc import Disc
from radial.stress.half_space import below_pressure
from radial.stress.layer_contribution import LayerContribution
from semi_analytical.frf.depth import Level, material_at
from semi_analytical.frf.stack import Stack


class SubsurfaceDisc:
    """Displacement and stress of one body below the pressure of a frictionless contact.

    The fields are those of a half-space (`half_space`), plus the contribution of the layers
    (`layer_contribution`).

    contact   frictionless contact, which gives the pressure
    stack     the body, with or without layers
    reach     largest radius of points over the contact radius
    fineness  factor on the number of wavenumbers, 1 by default
    """

    def __init__(self, contact: Disc, stack: Stack, reach: float, fineness: int = 1) -> None:
        self.contact, self.stack = contact, stack
        if stack.layers:
            a = contact.radius
            self._layers = LayerContribution(stack, a, reach, fineness)
            kappa, weights = self._layers.waves.rule
            transform = (
                contact.bodies.modulus / (pi * a) * contact.wave_transform(self._layers.waves)
            )
            self._sources = np.stack([0 * kappa, 0 * kappa, weights * kappa * transform])[:, None]

    def compute_fields(self, levels: Sequence[Level], r: Array) -> Array:
        """Compute displacement and stress below the pressure at given depths and radii.

        The shape is (levels, 6, n). The fields are u_r, u_z [length], σ_rr, σ_θθ, σ_zz, σ_rz
        [force/length²]. Raises ValueError for a depth in a rigid base.

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
            polar = self._layers.fields(self._sources, levels, x, 0 * x)
            found += polar[:, [0, 2, 3, 4, 5, 7]]
        return found
