"""Angular grid of a ring, and the transform from values at its angles to harmonics.

The symmetric family of harmonics has p and q_r ∝ cos mθ and q_θ ∝ sin mθ. The antisymmetric family
has p and q_r ∝ sin mθ and q_θ ∝ -cos mθ. Its harmonic 0 is torsion: q_θ alone.
"""

from __future__ import annotations

from enum import Enum

import numpy as np

from contact_scene.array_types import Array


class Circle(Enum):
    """Angles that represent a field by its symmetry."""

    ONE = "one angle"
    HALF = "half the circle"
    WHOLE = "the whole circle"

    def angles(self, highest: int) -> Array:
        """Return θ_j = π(j + ½)/J, the angles that resolve harmonics up to J = highest."""
        if self is Circle.ONE:
            return np.zeros(1)
        count = highest if self is Circle.HALF else 2 * highest
        return np.pi * (np.arange(count) + 0.5) / highest

    def shown(self, highest: int) -> Array:
        """Return the angles of output πj/J: 0 … π for a half circle, [0, 2π) for a whole one."""
        count = highest + 1 if self is Circle.HALF else 2 * highest
        return np.pi * np.arange(count) / highest

    def families(self, highest: int) -> tuple[Array, ...]:
        """Return matrices from values at the angles to harmonics 0 … J of q_r, q_θ and p.

        Each family has one matrix of shape (3, J + 1, angles). A half circle has the symmetric
        family only.
        """
        angles = self.angles(highest)
        at = np.multiply.outer(np.arange(highest + 1), angles)
        cosines, sines = 2 * np.cos(at) / len(angles), 2 * np.sin(at) / len(angles)
        cosines[0] /= 2
        if highest:
            # The cosine of the highest harmonic is zero at all these angles.
            cosines[-1], sines[-1] = 0.0, sines[-1] / 2
        alike = np.stack([cosines, sines, cosines])
        if self is Circle.HALF:
            return (alike,)
        return alike, np.stack([sines, -cosines, sines])
