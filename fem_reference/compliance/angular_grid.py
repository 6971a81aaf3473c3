"""Points at equal angles on a ring, and transforms between point values and angular harmonics.

Fields are sums of two families of harmonics. In the symmetric family q_r, p and the displacements
u_r, u_z are ∝ cos nθ, and q_θ and u_θ are ∝ sin nθ. The turned family is the symmetric one turned
by a quarter wave: (sin nθ, -cos nθ, sin nθ). Its harmonic 0 is torsion. Under tangential loads on
one line all fields are mirror symmetric in θ. The symmetric family and the half circle are then
sufficient. The number of harmonics equals the number of unknowns on a ring. More harmonics are not
unique, and fewer make the tangential problem singular.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Indices, Matrix, Vector

R, THETA, Z = range(3)
Transforms = tuple[Matrix, Matrix, Matrix]


@dataclass(frozen=True)
class AngularGrid:
    """Angles of the points on a ring, with transforms between point values and angular harmonics.

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
        """Number of points on each ring.

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

    def amplitudes(self, values: Matrix, components: Sequence[int] = (R, THETA, Z)) -> Matrix:
        """Transform fields at the points of rings to amplitudes of angular harmonics.

        values      fields at the points (fields, rings, points)
        components  component r, θ or z as which each field is transformed (fields,)
        returns     amplitudes of the fields in each family (families, fields, rings, harmonics)
        """
        return np.stack(
            [
                [f @ transforms[c].T for f, c in zip(values, components, strict=True)]
                for transforms in self.families
            ]
        )

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


def axisymmetric_grid(around: float = 2 * np.pi) -> AngularGrid:
    """Create the grid with one point per ring, for fields that do not depend on the angle θ.

    around  angle that the point represents; 2 in plane strain, for both halves of the surface
    """
    return AngularGrid(np.zeros(1), np.full(1, around), np.ones((1, 1)), np.ones((1, 1)))


def end_grid(highest: int) -> AngularGrid:
    """Create the angular grid θ_j = πj/J, j = 0…J, which includes θ = 0 and θ = π.

    These two angles are on the line of the tangential load, where the circumferential shear q_θ is
    zero. Used for coupled bodies under a tangential load.

    highest  J, highest angular harmonic
    """
    return _grid_on_places(2 * np.arange(highest + 1), highest, whole=False)


def whole_grid(highest: int) -> AngularGrid:
    """Create the angular grid θ_j = πj/J, j = 0…2J−1, of the whole circle.

    Its points on the half circle are those of `end_grid`. The grid can represent cos Jθ, but not
    sin Jθ. Used under tangential loads on several lines, or together with torsion.

    highest  J, highest angular harmonic, at least 2: for J = 1, the grid has no shift across θ = 0
    """
    return _grid_on_places(2 * np.arange(2 * highest), highest, whole=True)


def mid_grid(highest: int) -> AngularGrid:
    """Create the angular grid θ_j = π(j + ½)/J, j = 0…J−1, without the points θ = 0 and θ = π.

    The grid can represent sin Jθ, but not cos Jθ. Used for the stress below tractions that are
    given at these angles.

    highest  J, highest angular harmonic and number of points on the half circle
    """
    return _grid_on_places(2 * np.arange(highest) + 1, highest, whole=False)


def grid_at(angles: Vector) -> AngularGrid:
    """Return the angular grid with given angles, as the fields of a result have them.

    angles  θ (points,) [radian]: of `whole_grid`, `end_grid` or `mid_grid`
    """
    points = len(angles)
    if angles[-1] > 1.25 * np.pi:
        return whole_grid(points // 2)
    return end_grid(points - 1) if angles[0] == 0 else mid_grid(points)


def _grid_on_places(places: Indices, highest: int, *, whole: bool) -> AngularGrid:
    """Create the angular grid of equidistant angles, given as integers, so that zeros are exact.

    places   angles θ_j in units of π/(2J) (points,)
    highest  J, highest angular harmonic
    whole    True for angles of the whole circle
    """
    turns = np.outer(np.arange(highest + 1), places)
    # On the half circle, the points at 0 and π are their own mirror images.
    alone = whole | (places % (2 * highest) == 0)
    weights = np.where(alone, np.pi, 2 * np.pi) / highest
    cosines, sines = (
        _amplitude_matrix(
            np.where(at % (2 * highest), np.sin(np.pi / 2 / highest * at), 0), weights
        )
        for at in ((turns + highest) % (4 * highest), turns % (4 * highest))
    )
    angles = np.pi * places.astype(np.float64) / (2 * highest)
    return AngularGrid(angles, weights, cosines, sines, whole)


def _amplitude_matrix(waves: Matrix, weights: Vector) -> Matrix:
    """Return the matrix from point values to amplitudes of orthogonal waves (harmonics, points);
    the row of a wave that is zero at all points is zero."""
    weighted = waves * weights
    norms = np.sum(weighted * waves, axis=1, keepdims=True)
    return np.divide(weighted, norms, out=np.zeros_like(weighted), where=norms > 0)
