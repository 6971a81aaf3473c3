"""Normal response of both bodies: their outermost materials, and the contribution of layers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from contact_scene import Scene
from contact_scene.array_types import Array
from contact_scene.body_pair import contact_modulus
from radial.response.wavenumbers import (
    Waves,
    waves,
)
from semi_analytical.frf.stack import Stack, stack_of
from semi_analytical.frf.surface import SurfaceScalars, remainder_scalars

# exp(-2 k h) (k h)² is below 1e-17 from here on.
REACH = 24.0
# Ratio of the smallest wavenumber to the one where the softest layer has an effect.
LONGEST_WAVE = 1e-2
# Number of cached layer responses: pressure, shear and gap of a contact use the same one.
CACHED = 4


@dataclass(frozen=True)
class Bodies:
    """Lower body and indenter.

    layered  bodies with layers
    modulus  E* of the outermost materials [force/length²]
    """

    layered: Sequence[Stack]
    modulus: float

    @classmethod
    def of(cls, scene: Scene) -> Bodies:
        """Return the bodies of a scene."""
        stacks = (stack_of(scene.body), stack_of(scene.indenter))
        return cls([stack for stack in stacks if stack.layers], contact_modulus(scene))

    @property
    def stiffest(self) -> float:
        """Return an upper bound of the modulus of all materials, by order of magnitude
        [force/length²]."""
        moduli = (4 * modulus for stack in self.layered for modulus in _moduli(stack))
        return max([self.modulus, *moduli])

    @property
    def thickness(self) -> float:
        """Return the thickness of the thinner outermost layer, infinite without layers [length]."""
        return min((stack.layers[0].thickness for stack in self.layered), default=np.inf)

    def waves(self, radius: float, reach: float = 1.0, fineness: int = 1) -> Waves:
        """Return the wavenumbers at which layers contribute to a contact of this radius [length].

        reach  largest distance from the axis over the radius
        """
        least = LONGEST_WAVE * min(longest(stack, radius) for stack in self.layered)
        return waves(REACH * radius / self.thickness, least, reach, fineness)

    def excess(self, waves: Waves, radius: float) -> Array:
        """Return X - 1 with X = k E* F_zz / 2 at wavenumbers k = κ/radius [1].

        X - 1 is the contribution of layers over the response of the outermost materials.
        """
        added = np.sum([added_by(stack, waves, radius).c22 for stack in self.layered], axis=0)
        return np.asarray(0.5 * self.modulus * (waves.rule[0] / radius) * added)


@lru_cache(maxsize=CACHED)
def added_by(stack: Stack, waves: Waves, radius: float) -> SurfaceScalars:
    """Return the surface response of a body minus that of a half-space of its outermost material.

    Wavenumbers are κ/radius (κ,) [length²/force · length].
    """
    return remainder_scalars(stack, waves.rule[0] / radius)


def longest(stack: Stack, radius: float) -> float:
    """Return the order of magnitude of κ below which layers have no effect."""
    moduli = _moduli(stack)
    total = sum(film.thickness for film in stack.layers)
    return radius / (radius + total) * min(moduli) / max(moduli)


def _moduli(stack: Stack) -> list[float]:
    """Return the shear moduli of layers and base, without a rigid base [force/length²]."""
    films = [film.shear_modulus for film in stack.layers]
    return films if stack.base is None else [*films, stack.base.shear_modulus]
