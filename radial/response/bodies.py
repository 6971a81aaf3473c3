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

    The response is the normal surface displacement of both bodies by a pressure of given
    wavenumber.

    layered  the bodies with layers (none, one or two)
    modulus  contact modulus E* of the outermost materials, which determines the response of
             half-spaces [force/length²]
    """

    layered: Sequence[Stack]
    modulus: float

    @classmethod
    def of(cls, scene: Scene) -> Bodies:
        """Create the normal response of both bodies of a scene to pressure, from their materials.

        scene  contact problem, which gives materials and layers of both bodies
        """
        stacks = (stack_of(scene.body), stack_of(scene.indenter))
        return cls([stack for stack in stacks if stack.layers], contact_modulus(scene))

    @property
    def stiffest(self) -> float:
        """Upper bound of the moduli of all materials of both bodies [force/length²].

        The bound is the largest of E* and of 4 times the shear modulus of every material in the
        bodies with layers. Used for an initial guess of the contact radius from below.
        """
        moduli = (4 * modulus for stack in self.layered for modulus in _shear_moduli(stack))
        return max([self.modulus, *moduli])

    @property
    def thickness(self) -> float:
        """Smallest thickness of the outermost layers of both bodies [length].

        The thickness determines the number of wavenumbers. It is infinite if no body has layers.
        """
        return min((stack.layers[0].thickness for stack in self.layered), default=np.inf)

    def waves(self, radius: float, reach: float = 1.0, fineness: int = 1) -> Waves:
        """Return the quadrature over the wavenumbers at which the layers have an effect.

        Wavenumbers are multiplied by the contact radius.

        radius    contact radius [length]
        reach     largest distance of the points of evaluation from the axis, over the contact
                  radius
        fineness  factor on the number of wavenumbers, 1 by default
        """
        least = LONGEST_WAVE * min(least_wavenumber(stack, radius) for stack in self.layered)
        return waves(REACH * radius / self.thickness, least, reach, fineness)

    def excess(self, waves: Waves, radius: float) -> Array:
        """Compute the contribution of layers to the normal response over that of half-spaces.

        The result is X - 1 (κ,) [1], where X = k E* F_zz/2. F_zz is the normal displacement of both
        bodies per unit pressure at the wavenumber k = κ/radius, and E* the contact modulus of the
        outermost materials. X is 1 for half-spaces.

        waves   quadrature over dimensionless wavenumbers κ
        radius  contact radius [length]
        """
        stacks = tuple((stack, 1.0) for stack in self.layered)
        return np.asarray(0.5 * self.modulus * layer_responses(stacks, waves, radius)[2])


@lru_cache(maxsize=CACHED)
def layer_responses(stacks: tuple[tuple[Stack, float], ...], waves: Waves, radius: float) -> Array:
    """Compute the contribution of layers to the surface displacements at wavenumbers k (4, κ).

    The contribution of a body is its response minus that of a half-space of its outermost material.
    A response is a displacement per unit traction, times k [length²/force]. The rows are summed
    over the bodies. The results are cached. The four rows are

        displacement along the wave vector by shear in this direction,
        coupling of this direction with the normal,
        normal displacement by pressure,
        displacement across the wave vector by shear across the wave vector.

    stacks  bodies with layers, with the sign of their coupling response: 1 for the lower body, -1
            for the indenter
    waves   quadrature over dimensionless wavenumbers κ = k times radius
    radius  contact radius [length]
    """
    k = waves.rule[0] / radius
    total = np.zeros((4, len(k)))
    for stack, sign in stacks:
        added = remainder_scalars(stack, k)
        total += (added.c11, sign * added.c12, added.c22, added.csh)
    return k * total


def least_wavenumber(stack: Stack, radius: float) -> float:
    """Estimate the wavenumber below which the layers of a body change its response little [1].

    The wavenumber is multiplied by the contact radius. The result is an order of magnitude. Used to
    place the first interval of the quadrature over wavenumbers.

    stack   the body with its layers
    radius  contact radius [length]
    """
    moduli = _shear_moduli(stack)
    total = sum(
        # A compliant bond acts like this thickness of the stiffest material.
        film.thickness + max(moduli) * max(film.normal_opening, film.tangential_jump)
        for film in stack.layers
    )
    return radius / (radius + total) * min(moduli) / max(moduli)


def _shear_moduli(stack: Stack) -> list[float]:
    """Return the shear moduli of the layers and the base; a rigid base is omitted."""
    films = [film.shear_modulus for film in stack.layers]
    return films if stack.base is None else [*films, stack.base.shear_modulus]
