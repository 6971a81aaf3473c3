"""Normal response of both bodies to pressure: half-spaces plus the contribution of layers.

The half-spaces have the outermost materials of the bodies.
"""

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
from semi_analytical.frf.surface import remainder_scalars

# Largest wavenumber times thickness, k h: exp(-2 k h) (k h)², the relative contribution of a layer,
# is below 1e-17 for larger values.
REACH = 24.0
# Ratio of the smallest wavenumber to the wavenumber where the softest layer begins to have an
# effect.
LONGEST_WAVE = 1e-2
# Number of cached layer responses: pressure, shear and gap of a contact use the same one.
CACHED = 4


@dataclass(frozen=True)
class Bodies:
    """Normal response of both bodies to pressure: that of half-spaces, plus that of their layers.

    layered  the bodies with layers (none, one or two)
    modulus  contact modulus E* of the outermost materials, which determines the response of
             half-spaces [force/length²]
    """

    layered: Sequence[Stack]
    modulus: float

    @classmethod
    def of(cls, scene: Scene) -> Bodies:
        """Create the normal response of both bodies of a scene."""
        stacks = (stack_of(scene.body), stack_of(scene.indenter))
        return cls([stack for stack in stacks if stack.layers], contact_modulus(scene))

    @property
    def stiffest(self) -> float:
        """Return an upper bound of the moduli of all materials [force/length²].

        The bound is an order of magnitude: 4 times the largest shear modulus, or E*.
        """
        moduli = (4 * modulus for stack in self.layered for modulus in _shear_moduli(stack))
        return max([self.modulus, *moduli])

    @property
    def thickness(self) -> float:
        """Return the thickness of the thinner outermost layer of both bodies [length].

        It is infinite if no body has layers.
        """
        return min((stack.layers[0].thickness for stack in self.layered), default=np.inf)

    def waves(self, radius: float, reach: float = 1.0, fineness: int = 1) -> Waves:
        """Return the quadrature over wavenumbers at which the layers contribute to a contact.

        Wavenumbers are multiplied by the contact radius.

        radius    contact radius [length]
        reach     largest distance of the points of evaluation from the axis, over the contact
                  radius
        fineness  multiple of the number of wavenumbers
        """
        least = LONGEST_WAVE * min(least_wavenumber(stack, radius) for stack in self.layered)
        return waves(REACH * radius / self.thickness, least, reach, fineness)

    def excess(self, waves: Waves, radius: float) -> Array:
        """Return the relative contribution of layers to the normal response (κ,) [1].

        The result is X - 1. X = k E* F_zz/2 is the response F_zz of both bodies to pressure, over
        that of half-spaces of their outermost materials. The wavenumbers are k = κ/radius.

        waves   dimensionless wavenumbers κ
        radius  contact radius [length]
        """
        stacks = tuple((stack, 1.0) for stack in self.layered)
        return np.asarray(0.5 * self.modulus * layer_responses(stacks, waves, radius)[2])


@lru_cache(maxsize=CACHED)
def layer_responses(stacks: tuple[tuple[Stack, float], ...], waves: Waves, radius: float) -> Array:
    """Compute the contribution of layers to surface responses at wavenumbers k (4, κ).

    The contribution of a body is its response minus that of a half-space of its outermost material.
    The responses are displacements per unit traction, times k [length²/force]: along the wave
    vector, coupling, normal, transverse. They are summed over the bodies.

    stacks  bodies with layers, with the sign of their coupling response: 1 for the lower body, -1
            for the indenter
    waves   dimensionless wavenumbers κ = k times radius
    radius  contact radius [length]
    """
    k = waves.rule[0] / radius
    total = np.zeros((4, len(k)))
    for stack, sign in stacks:
        added = remainder_scalars(stack, k)
        total += (added.c11, sign * added.c12, added.c22, added.csh)
    return k * total


def least_wavenumber(stack: Stack, radius: float) -> float:
    """Estimate the wavenumber κ below which the layers of a body have no effect.

    κ is multiplied by the contact radius. The result is an order of magnitude.

    stack   the body with its layers
    radius  contact radius [length]
    """
    moduli = _shear_moduli(stack)
    total = sum(film.thickness for film in stack.layers)
    return radius / (radius + total) * min(moduli) / max(moduli)


def _shear_moduli(stack: Stack) -> list[float]:
    """Return the shear moduli of the layers and the base of a body [force/length²].

    A rigid base is omitted.
    """
    films = [film.shear_modulus for film in stack.layers]
    return films if stack.base is None else [*films, stack.base.shear_modulus]
