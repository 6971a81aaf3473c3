"""Points at equal angles on a ring, and transforms between point values and angular harmonics.

Fields are sums of two families of harmonics. In the symmetric family q_r, p and the displacements
u_r, u_z are ∝ cos nθ, and q_θ and u_θ are ∝ sin nθ. The turned family is the symmetric one turned
by a quarter wave: (sin nθ, -cos nθ, sin nθ). Its harmonic 0 is torsion. Under tangential loads on
one line all fields are mirror symmetric in θ. The symmetric family and the half circle are then
sufficient. The number of harmonics equals the number of unknowns on a ring. More harmonics are not
unique, and fewer make the tangential problem singular.
"""

from dataclasses import dataclass

import numpy as np
from scipy.fft import dct, dst

from contact_scene.array_types import Field, Matrix, Vector

Transforms = tuple[Matrix, Matrix, Matrix]


@dataclass(frozen=True)
class AngularGrid:
    """Angles of the points on a ring, with transforms between point values and angular harmonics.

    A ring is a circle around the axis on the surface.

    angles   θ_j (points,) [radian]
    weights  angle of the full circle that each point represents (points,), with the sum 2π
    cosines  matrix from point values to the amplitudes of cos nθ (harmonics, points)
    sines    matrix from point values to the amplitudes of sin nθ (harmonics, points); a row is zero
             if sin nθ is zero at all points
    whole    True for angles of the whole circle; False for the half circle of fields that are
             mirror symmetric in θ
    """

    angles: Vector
    weights: Vector
    cosines: Matrix
    sines: Matrix
    whole: bool = False

    @property
    def points(self) -> int:
        """Number of points on each ring, a circle around the axis on the surface.

        Points on the half circle represent their mirror images as well.
        """
        return len(self.angles)

    @property
    def highest(self) -> int:
        """Highest angular harmonic n (as in cos nθ) that the points on a ring can represent."""
        return len(self.cosines) - 1

    @property
    def families(self) -> tuple[Transforms, ...]:
        """Matrices from point values to harmonic amplitudes, for the vector components r, θ and z.

        Each family of harmonics has three matrices of the shape (harmonics, points). The families
        are the symmetric one and, on the whole circle, the turned one.
        """
        symmetric = self.cosines, self.sines, self.cosines
        return (symmetric, (self.sines, -self.cosines, self.sines)) if self.whole else (symmetric,)

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

        A ring is a circle around the axis on the surface.

        values   components r, θ, z at the points (3, rings, points)
        returns  amplitudes of the components in each family (families, 3, rings, harmonics)
        """
        return np.stack(
            [
                [f @ d.T for f, d in zip(values, transforms, strict=True)]
                for transforms in self.families
            ]
        )

    def evaluate_at_points(self, amplitudes: Matrix) -> Matrix:
        """Transform amplitudes of angular harmonics to a vector field at the points of rings.

        A ring is a circle around the axis on the surface.

        amplitudes  amplitudes of the components r, θ, z (families, 3, rings, harmonics)
        returns     components r, θ, z at the points (3, rings, points)
        """
        total = np.zeros((*amplitudes.shape[1:3], self.points))
        for parts, transforms in zip(amplitudes, self.families, strict=True):
            waves = [d * self.norms[:, None] / self.weights for d in transforms]
            total += [f @ wave for f, wave in zip(parts, waves, strict=True)]
        return total

    def modes(self, angles: Vector) -> Field:
        """Compute the harmonics at given angles (families, 3, harmonics, angles).

        The components are r, θ and z. Used to evaluate a field between the points of the grid from
        its harmonic amplitudes.

        angles  θ (angles,) [radian]
        """
        phase = np.outer(np.arange(self.highest + 1), angles)
        cosines, sines = np.cos(phase), np.sin(phase)
        families = (cosines, sines, cosines), (sines, -cosines, sines)
        return np.stack(families[: len(self.families)])


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


def whole_grid(highest: int) -> AngularGrid:
    """Create the angular grid θ_j = πj/J, j = 0…2J−1, of the whole circle.

    Its points on the half circle are those of `end_grid`. The grid can represent cos Jθ, but not
    sin Jθ. Used under tangential loads on several lines, or together with torsion.

    highest  J, highest angular harmonic, at least 2: for J = 1, the grid has no shift across θ = 0
    """
    J = highest
    # The angles of cos nθ_j and sin nθ_j are multiples of π/J below 2π.
    turns = np.outer(np.arange(J + 1), np.arange(2 * J)) % (2 * J)
    cosines = np.cos(np.pi * turns / J) / J
    cosines[[0, J]] /= 2
    sines = np.where(turns % J == 0, 0.0, np.sin(np.pi * turns / J) / J)
    angles = np.pi * np.arange(2 * J) / J
    return AngularGrid(angles, np.full(2 * J, np.pi / J), cosines, sines, whole=True)


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
