"""Both bodies as pressure feels them: outermost materials, and what layers add to them."""

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
# Of the wavenumber at which the softest part of the layers begins to be felt.
LONGEST_WAVE = 1e-2
# Radii whose layers are kept: pressure, shear and gap of a contact all ask for them.
KEPT = 4


@dataclass(frozen=True)
class Bodies:
    """Lower body and indenter.

    layered  those that are not one half-space
    modulus  E* of their outermost materials [force/length²]
    """

    layered: Sequence[Stack]
    modulus: float

    @classmethod
    def of(cls, scene: Scene) -> Bodies:
        """Those of a scene."""
        stacks = (stack_of(scene.body), stack_of(scene.indenter))
        return cls([stack for stack in stacks if stack.layers], contact_modulus(scene))

    @property
    def stiffest(self) -> float:
        """A modulus beyond which nothing is that is layered, by order of magnitude
        [force/length²]."""
        moduli = (4 * modulus for stack in self.layered for modulus in _moduli(stack))
        return max([self.modulus, *moduli])

    @property
    def thickness(self) -> float:
        """Of the thinner outermost layer; infinite without [length]."""
        return min((stack.layers[0].thickness for stack in self.layered), default=np.inf)

    def waves(self, radius: float, reach: float = 1.0, fineness: int = 1) -> Waves:
        """All wavenumbers of which layers are felt in a contact of this radius [length], for places
        within `reach` radii."""
        least = LONGEST_WAVE * min(longest(stack, radius) for stack in self.layered)
        return waves(REACH * radius / self.thickness, least, reach, fineness)

    def excess(self, waves: Waves, radius: float) -> Array:
        """X - 1 with X = k E* F_zz / 2 at wavenumbers k = κ/radius: what the layers add to the
        half-spaces of the outermost materials, relative to that [1]."""
        added = np.sum([added_by(stack, waves, radius).c22 for stack in self.layered], axis=0)
        return np.asarray(0.5 * self.modulus * (waves.rule[0] / radius) * added)


@lru_cache(maxsize=KEPT)
def added_by(stack: Stack, waves: Waves, radius: float) -> SurfaceScalars:
    """What the layers of a body add to a half-space of its outermost material, at wavenumbers
    κ/radius (κ,) [length²/force · length]."""
    return remainder_scalars(stack, waves.rule[0] / radius)


def longest(stack: Stack, radius: float) -> float:
    """κ below which layers act as if they were not there, by order of magnitude."""
    moduli = _moduli(stack)
    total = sum(film.thickness for film in stack.layers)
    return radius / (radius + total) * min(moduli) / max(moduli)


def _moduli(stack: Stack) -> list[float]:
    """Shear moduli of all that deforms [force/length²]."""
    films = [film.shear_modulus for film in stack.layers]
    return films if stack.base is None else [*films, stack.base.shear_modulus]
