"""What the contact solver knows of the elasticity: how rings of traction displace rings."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_reference.contact.ring_edge import BEYOND, Beyond, beyond_pressure
from fem_reference.model import ContactModel

Matrix = NDArray[np.float64]
Vector = NDArray[np.float64]


@dataclass(frozen=True)
class RingCompliance:
    """Displacement amplitudes by traction amplitudes, both over the hats φ of the rings.

    radii      of the rings, increasing from 0 (rings,) [length]
    areas      ∫ φ r dr (rings,) [length^2]
    harmonics  for n = 0, 1, …: ∫ φ_i u r dr of the components r, θ, z of the displacement, lower
               body less indenter, per traction with profile φ_k (3, rings, 3, rings)
               [length^5/force]. Symmetric; all of θ is zero for n = 0
    edge       how far beyond the last ring pressure ends, see `beyond_pressure`
    """

    radii: Vector
    areas: Vector
    harmonics: tuple[Matrix, ...]
    edge: Beyond = BEYOND


def ring_compliance(model: ContactModel, highest: int) -> RingCompliance:
    """Of the bodies of a model, for the harmonics 0…highest; condenses those that are missing."""
    hats = model.hats
    rings = len(hats.radii)
    harmonics = []
    for n in range(highest + 1):
        condensed = model.compliance(n)
        A = np.zeros((3, rings, 3, rings))
        for i, a in enumerate(condensed.motion.components):
            for j, b in enumerate(condensed.motion.components):
                A[a, :, b] = hats.compliance(condensed.matrix[i, :, j])
        harmonics.append(A)
    edge = beyond_pressure(model.scene.body, model.scene.indenter)
    return RingCompliance(hats.radii, hats.weights, tuple(harmonics), edge)
