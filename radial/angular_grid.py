"""Angles of the points on a ring, and the transform from values at these angles to harmonics.

In the symmetric family of harmonics p and q_r are ∝ cos mθ, and q_θ is ∝ sin mθ. In the
antisymmetric family p and q_r are ∝ sin mθ, and q_θ is ∝ -cos mθ. Harmonic 0 of the antisymmetric
family is torsion: q_θ alone.
"""

from __future__ import annotations

from enum import Enum

import numpy as np

from contact_scene.array_types import Array


class RingAngles(Enum):
    """Angles at which fields on a ring are represented, chosen by the symmetry of the load history.

    ONE    one angle, for axisymmetric fields including torsion
    HALF   angles between 0 and π, for fields symmetric about the direction θ = 0 of the load
    WHOLE  angles of the full circle, for fields without symmetry
    """

    ONE = "one angle"
    HALF = "half the circle"
    WHOLE = "the whole circle"

    def angles(self, highest: int) -> Array:
        """Return the angles of the points on a ring, θ_j = π(j + ½)/J [radian].

        A half circle has J angles and a full circle 2J. They resolve angular harmonics up to J. The
        single angle of axisymmetric fields is 0.

        highest  highest harmonic J of pressure and shear
        """
        if self is RingAngles.ONE:
            return np.zeros(1)
        count = highest if self is RingAngles.HALF else 2 * highest
        return np.pi * (np.arange(count) + 0.5) / highest

    def output_angles(self, highest: int) -> Array:
        """Return the angles at which fields on a ring are output, πj/J [radian].

        They run from 0 to π for a half circle and from 0 to less than 2π for a full circle. Unlike
        the angles of the points, they include the direction θ = 0 of the load.

        highest  highest angular harmonic J of pressure and shear
        """
        count = highest + 1 if self is RingAngles.HALF else 2 * highest
        return np.pi * np.arange(count) / highest

    def harmonic_matrices(self, highest: int) -> tuple[Array, ...]:
        """Return matrices from values at the angles of a ring to amplitudes of angular harmonics m.

        In the symmetric family of harmonics p and q_r are ∝ cos mθ and q_θ ∝ sin mθ, in the
        antisymmetric family p and q_r are ∝ sin mθ and q_θ ∝ -cos mθ. The result has one matrix of
        shape (3, J + 1, angles) for each family, with the components q_r, q_θ, p and the harmonics
        0 … J. A half circle has the symmetric family only.

        highest  highest harmonic J
        """
        angles = self.angles(highest)
        at = np.multiply.outer(np.arange(highest + 1), angles)
        cosines, sines = 2 * np.cos(at) / len(angles), 2 * np.sin(at) / len(angles)
        cosines[0] /= 2
        if highest:
            # The cosine of the highest harmonic is zero at all these angles.
            cosines[-1], sines[-1] = 0.0, sines[-1] / 2
        alike = np.stack([cosines, sines, cosines])
        if self is RingAngles.HALF:
            return (alike,)
        return alike, np.stack([sines, -cosines, sines])
