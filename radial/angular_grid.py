"""Angles on a ring, and the harmonics that are known by values at them.

Harmonics come in two families. In one p and q_r go as cos mθ and q_θ as sin mθ: mirror images
about θ = 0 are alike. The other is the same turned by a quarter of a wave, sin mθ and -cos mθ; of
m = 0 it is torsion, which has q_θ alone.
"""

from __future__ import annotations

from enum import Enum

import numpy as np

from contact_scene.array_types import Array


class Circle(Enum):
    """How much of a circle tells all of a field."""

    ONE = "one angle"
    HALF = "half the circle"
    WHOLE = "the whole circle"

    def angles(self, highest: int) -> Array:
        """θ_j = π(j + ½)/J by which harmonics up to J = highest are known."""
        if self is Circle.ONE:
            return np.zeros(1)
        count = highest if self is Circle.HALF else 2 * highest
        return np.pi * (np.arange(count) + 0.5) / highest

    def shown(self, highest: int) -> Array:
        """πj/J: the half circle with both ends, or the whole with its beginning alone."""
        count = highest + 1 if self is Circle.HALF else 2 * highest
        return np.pi * np.arange(count) / highest

    def families(self, highest: int) -> tuple[Array, ...]:
        """Harmonics 0 … J of q_r, q_θ and p by values at the angles (3, J + 1, angles), family by
        family; of the half circle that of its mirror image."""
        angles = self.angles(highest)
        at = np.multiply.outer(np.arange(highest + 1), angles)
        cosines, sines = 2 * np.cos(at) / len(angles), 2 * np.sin(at) / len(angles)
        cosines[0] /= 2
        if highest:
            # Of the highest harmonic values at these angles know the sine alone.
            cosines[-1], sines[-1] = 0.0, sines[-1] / 2
        alike = np.stack([cosines, sines, cosines])
        if self is Circle.HALF:
            return (alike,)
        return alike, np.stack([sines, -cosines, sines])
