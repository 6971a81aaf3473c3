"""Points at equal angles on a ring, and transforms between point values and angular harmonics.

All fields are mirror symmetric in θ. q_r, p and the displacements u_r, u_z are sums of cos nθ. q_θ
and u_θ are sums of sin nθ. The half circle is therefore sufficient. The number of harmonics equals
the number of unknowns on a ring. More harmonics are not unique, and fewer make the tangential
problem singular.
"""

from dataclasses import dataclass

import numpy as np
from scipy.fft import dct, dst

from contact_scene.array_types import Matrix, Vector


@dataclass(frozen=True)
class AngularGrid:
    """Angles of the points on a ring, with transforms between point values and angular harmonics.

    A ring is a circle around the axis on the surface. The half circle is sufficient by symmetry.

    angles   θ_j (points,) [radian]
    weights  angle of the full circle that each point represents (points,), with the sum 2π
    cosines  matrix from point values to the amplitudes of cos nθ (harmonics, points)
    sines    matrix from point values to the amplitudes of sin nθ (harmonics, points); a row is zero
             if sin nθ is zero at all points
    """

    angles: Vector
    weights: Vector
    cosines: Matrix
    sines: Matrix

    @property
    def points(self) -> int:
        """Number of points on the half circle of each ring.

        The other half is its mirror image. A ring is a circle around the axis on the surface.
        """
        return len(self.angles)

    @property
    def highest(self) -> int:
        """Highest angular harmonic n (as in cos nθ) that the points on a ring can represent."""
        return len(self.cosines) - 1

    @property
    def transforms(self) -> tuple[Matrix, Matrix, Matrix]:
        """Matrices from point values to harmonic amplitudes, for the vector components r, θ and z.

        Each matrix has the shape (harmonics, points). The components r and z are sums of cos nθ,
        the component θ is a sum of sin nθ.
        """
        return self.cosines, self.sines, self.cosines

    @property
    def norms(self) -> Vector:
        """Normalisation factors c_n of the angular harmonics cos nθ and sin nθ (harmonics,).

        For a field f with the amplitudes f_n, Σ_j weight_j f(θ_j) cos nθ_j = c_n f_n over the
        points θ_j of a ring. c_n is 2π for n = 0 and for the harmonic that alternates from point to
        point, and π for all others.
        """
        powers = [np.sum(d**2 / self.weights, axis=1) for d in (self.cosines, self.sines)]
        return np.asarray(1 / np.maximum(*powers))

    def amplitudes(self, values: Matrix) -> Matrix:
        """Transform a vector field at the points of rings to amplitudes of angular harmonics.

        The components r and z are sums of cos nθ over n, the component θ is a sum of sin nθ. A ring
        is a circle around the axis on the surface.

        values   components r, θ, z at the points (3, rings, points)
        returns  amplitudes of the components (3, rings, harmonics)
        """
        return np.stack([f @ d.T for f, d in zip(values, self.transforms, strict=True)])

    def evaluate_at_points(self, amplitudes: Matrix) -> Matrix:
        """Transform amplitudes of angular harmonics to a vector field at the points of rings.

        The components r and z are sums of cos nθ over n, the component θ is a sum of sin nθ. A ring
        is a circle around the axis on the surface.

        amplitudes  amplitudes of the components r, θ, z (3, rings, harmonics)
        returns     components r, θ, z at the points (3, rings, points)
        """
        waves = [d * self.norms[:, None] / self.weights for d in self.transforms]
        return np.stack([f @ wave for f, wave in zip(amplitudes, waves, strict=True)])

    def modes(self, angles: Vector) -> tuple[Matrix, Matrix]:
        """Compute cos nθ and sin nθ of all harmonics n at given angles, each (harmonics, angles).

        Used to evaluate a field between the points of the grid from its harmonic amplitudes.

        angles  θ (angles,) [radian]
        """
        phase = np.outer(np.arange(self.highest + 1), angles)
        return np.cos(phase), np.sin(phase)


def axisymmetric_grid() -> AngularGrid:
    """Create the grid with one point per ring, for fields that do not depend on the angle θ."""
    return AngularGrid(np.zeros(1), np.full(1, 2 * np.pi), np.ones((1, 1)), np.ones((1, 1)))


def end_grid(highest: int) -> AngularGrid:
    """Create the angular grid θ_j = πj/J, j = 0…J, which includes θ = 0 and θ = π.

    These two angles are on the line of the tangential load, where the circumferential shear q_θ is
    zero. Used for coupled bodies under a tangential load.

    highest  J, highest angular harmonic
    """
    J = highest
    share = np.full(J + 1, 2 * np.pi / J)
    share[[0, J]] /= 2
    cosines = dct(np.eye(J + 1), type=1, axis=0) / J
    cosines[[0, J]] /= 2
    sines = np.zeros((J + 1, J + 1))
    sines[1:J, 1:J] = dst(np.eye(J - 1), type=1, axis=0) / J
    return AngularGrid(np.pi * np.arange(J + 1) / J, share, cosines, sines)


def mid_grid(highest: int) -> AngularGrid:
    """Create the angular grid θ_j = π(j + ½)/J, j = 0…J−1, without the points θ = 0 and θ = π.

    The grid can represent sin Jθ, but not cos Jθ. Used for the stress below tractions that are
    given at these angles.

    highest  J, highest angular harmonic and number of points on the half circle
    """
    J = highest
    cosines = np.zeros((J + 1, J))
    cosines[:J] = dct(np.eye(J), type=2, axis=0) / J
    cosines[0] /= 2
    sines = np.zeros((J + 1, J))
    sines[1:] = dst(np.eye(J), type=2, axis=0) / J
    sines[J] /= 2
    return AngularGrid(np.pi * (np.arange(J) + 0.5) / J, np.full(J, 2 * np.pi / J), cosines, sines)
