"""Compliance between the points (r_i, θ_j) of the surface, assembled from the angular harmonics."""

from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field, Matrix, Vector
from fem_reference.compliance.angular_grid import AngularGrid
from fem_reference.compliance.ring_compliance import RingCompliance
from fem_reference.loads import ALONG, TWIST

Scalar = TypeVar("Scalar", np.float64, np.bool_)


@dataclass(frozen=True)
class PointCompliance:
    """Compliance of the surface points: displacements of all points by tractions on all points.

    A point lies on a ring, a circle of radius r_i around the axis, at the angle θ_j. It represents
    the area w_ij = Δθ_j ∫ φ_i r dr with the basis function φ_i of the ring. Displacements are
    weighted with this area. On a grid of several angles, the first ring is the axis, which is one
    point with one traction. Scalar fields have the shape (points,): first the axis, then ring by
    ring. Vectors (2, points) have the components r and θ. On the axis of a grid of several angles,
    the components are x and y.

    rings, grid  radii and angles of the points, with the compliance of the rings
    springs      compliance of penalty springs between the surfaces, equal in the normal and
                 tangential direction [length^3/force]; zero without a penalty
    """

    rings: RingCompliance
    grid: AngularGrid
    springs: float = 0.0

    @property
    def shape(self) -> tuple[int, int]:
        """Number of rings (including the axis) and of angles on each."""
        return len(self.rings.radii), self.grid.points

    @cached_property
    def ring_of_point(self) -> NDArray[np.intp]:
        """Index of the ring on which each surface point lies (points,)."""
        rings, angles = self.shape
        return np.concatenate([[0], np.repeat(np.arange(1, rings), angles)])

    @cached_property
    def areas(self) -> Vector:
        """Areas w that the points represent (points,) [length^2].

        The sum of the areas is the area of the contact zone.
        """
        weights = self.grid.weights
        around = np.tile(weights, len(self.rings.radii) - 1)
        return self.rings.areas[self.ring_of_point] * np.concatenate([[np.sum(weights)], around])

    @cached_property
    def motions(self) -> Field:
        """Tangential displacement of the points per unit motion of the indenter (3, 2, points).

        The motions are the shifts along and across the load, and the twist. The displacement is
        dimensionless for a unit shift, and a length for a twist of 1 radian. It is zero for a
        motion that the symmetry of the solve excludes.
        """
        if self.grid.highest == 0:
            return self.rings.motions
        around = np.tile(self._shifts_around, len(self.rings.radii) - 1)
        on_axis = np.eye(2)[:, :, None] * np.any(around, axis=(1, 2))[:, None, None]
        twist = self.rings.motions[TWIST][:, self.ring_of_point]
        twist[:, 0] = 0.0
        return np.concatenate([np.concatenate([on_axis, around], axis=2), twist[None]])

    @cached_property
    def acting(self) -> tuple[int, ...]:
        """Indices of the tangential motions that the symmetry of the solve does not exclude."""
        return tuple(np.flatnonzero(np.any(self.motions, axis=(1, 2))).tolist())

    @property
    def levers(self) -> Vector:
        """Lever arms of the points in the torque (points,); 0 without twist [length]."""
        return np.hypot(*self.motions[TWIST])

    @cached_property
    def reaches(self) -> Vector:
        """Largest displacement of a point by each unit motion (3,); 1 for an excluded motion."""
        largest = np.max(np.hypot(self.motions[:, 0], self.motions[:, 1]), axis=1)
        return np.where(largest > 0, largest, 1.0)

    @cached_property
    def stretch(self) -> Field:
        """Tangential displacement of the points per unit imposed strain (2, points) [length].

        The strain of the lower body is equibiaxial, so that the displacement is radial and equal to
        the radius.
        """
        outward = self.rings.stretch[self.ring_of_point]
        return np.stack([outward, np.zeros_like(outward)])

    @cached_property
    def resultants(self) -> Field:
        """Factors that integrate the shear q over the surface to tangential loads (3, 2, points).

        The loads are Σ factor · q over all points: the forces along and across the load [factors in
        length^2] and the torque [factors in length^3].
        """
        return np.asarray(self.areas * self.motions)

    def tangential_loads(self, shear: Field) -> Vector:
        """Compute the forces along and across the load, and the torque, of a shear (3,).

        shear  shear at the points (2, points) [force/length^2]
        """
        return np.array([np.sum(factors * shear) for factors in self.resultants])

    @cached_property
    def carries_shear(self) -> NDArray[np.bool_]:
        """True for the points that can carry shear (points,).

        The point on the axis carries shear only under a tangential load.
        """
        on_axis = self.rings.radii[self.ring_of_point] == 0.0
        return np.asarray(~on_axis | (self.motions[ALONG, 0] != 0.0))

    @cached_property
    def couples(self) -> bool:
        """True if pressure causes relative tangential displacement of the two surfaces.

        Normal and tangential problem are then coupled.
        """
        return any(np.any(A[:2, :, 2]) for A in self.rings.harmonics)

    @cached_property
    def matrix(self) -> Matrix:
        """Compliance matrix K of all points (3 points, 3 points), with w u = K t.

        Rows and columns are ordered by the components r, θ, z, then by points. Here t are the
        tractions, u the displacements and w the areas of the points. K is symmetric and positive
        definite. If mirror symmetry excludes a component at a point, a diagonal entry keeps this
        component zero. The blocks of components a and b are

            K_ab = Σ_n c_n A^n_ab ⊗ D_aᵀ D_b

        with the ring compliances A^n and the matrices D from point values to amplitudes, summed
        over the families of harmonics.
        """
        rings, angles = self.shape
        harmonics = np.stack(self.rings.harmonics[: self.grid.highest + 1], axis=-1)
        harmonics = harmonics * self.grid.norms
        blocks = np.empty((3, rings, angles, 3, rings, angles))
        for a, analysis in enumerate(zip(*self.grid.families, strict=True)):
            for b, synthesis in enumerate(zip(*self.grid.families, strict=True)):
                around = np.einsum("fnj,fnl->njl", analysis, synthesis)
                block = np.tensordot(harmonics[a, :, b], around, axes=1)
                blocks[a, :, :, b] = block.transpose(0, 2, 1, 3)
        by_rings = self._summed_on_axis(blocks).transpose(2, 3, 4, 0, 1)
        K = self._summed_on_axis(by_rings).reshape(2 * (3 * len(self.areas),))
        diagonal = np.diagonal(K).reshape(3, -1)
        diagonal = np.where(diagonal == 0, diagonal[2], diagonal)
        K[np.diag_indices_from(K)] = (diagonal + self.springs * self.areas).ravel()
        return K

    @cached_property
    def equal_area_matrix(self) -> Matrix:
        """Compliance matrix for points of equal area, see `contact_solver.unequal_areas`.

        The matrix K is divided by the roots of the areas of both points [length/force].
        """
        units = 1 / np.sqrt(np.tile(self.areas, 3))
        matrix = self.matrix * units
        matrix *= units[:, None]
        return matrix

    def displacement(self, pressure: Vector, shear: Field) -> tuple[Field, Vector]:
        """Compute the displacement of the surface points by given tractions [length].

        Return the tangential displacement (2, points) and the normal displacement (points,), lower
        body minus indenter. The computation is done harmonic by harmonic, independently of the
        compliance matrix. The tangential displacement is set to zero at points that cannot carry
        shear.

        pressure  pressure at the points (points,) [force/length^2]
        shear     shear at the points (2, points) [force/length^2]
        """
        tractions = np.concatenate([*shear, pressure])
        u = (self.matrix @ tractions).reshape(3, -1) / self.areas
        return u[:2] * self.carries_shear, u[2]

    def scalar_on_grid(self, values: NDArray[Scalar]) -> NDArray[Scalar]:
        """Convert a scalar field at the surface points to the array shape (rings, angles).

        The value of the point on the axis is repeated for all angles. Used for the fields of the
        result.

        values  field at the points, first the axis, then ring by ring (points,)
        """
        rings, angles = self.shape
        on_grid = [np.repeat(values[:1], angles), values[1:]]
        return np.concatenate(on_grid).reshape(rings, angles)

    def vector_on_grid(self, values: Field) -> Field:
        """Convert a tangential vector field at the surface points to the shape (2, rings, angles).

        The components of the result are r and θ. The vector at the point on the axis is repeated
        for all angles. Used for the fields of the result.

        values  components at the points: x and y on the axis, else r and θ (2, points)
        """
        return self._spread_over_rings(np.stack([*values, np.zeros_like(values[0])]))[:2]

    @cached_property
    def _shifts_around(self) -> Field:
        """Components r and θ of unit vectors along x (the load) and y at all angles (2, 2, angles);
        zero where the grid cannot represent them."""
        cos, sin = np.cos(self.grid.angles), np.sin(self.grid.angles)
        sin = np.where(np.any(self.grid.sines, axis=0), sin, 0.0)
        across = np.stack([sin, cos]) * float(self.grid.whole)
        return np.stack([np.stack([cos, -sin]), across])

    @cached_property
    def _axis_vectors(self) -> Field:
        """Components r, θ, z at all angles of unit tractions x, y, z on the axis (3, 3, angles).

        On the half circle the traction along y is zero by mirror symmetry. On a grid of one angle
        the axis is treated as a ring, and the matrix is the identity.
        """
        if self.grid.highest == 0:
            return np.eye(3)[:, :, None]
        unit = np.zeros((3, 3, self.grid.points))
        unit[2, 2] = 1.0
        unit[:2, :2] = self._shifts_around
        return unit

    def _spread_over_rings(self, values: Field) -> Field:
        """Convert vectors at the points (3, points) to r, θ, z (3, rings, angles).
        The point on the axis has components x, y, z, and is repeated for all angles."""
        rings, angles = self.shape
        axis = np.einsum("cak,c->ak", self._axis_vectors, values[:, 0])
        return np.concatenate([axis[:, None], values[:, 1:].reshape(3, rings - 1, angles)], axis=1)

    def _summed_on_axis(self, weak: NDArray[np.float64]) -> NDArray[np.float64]:
        """Sum r, θ, z (3, rings, angles, …) on the axis to x, y, z (3, points, …):
        the transpose of `_spread_over_rings`, so that work is preserved."""
        axis = np.einsum("cak,ak...->c...", self._axis_vectors, weak[:, 0])
        rest = weak[:, 1:].reshape(3, -1, *weak.shape[3:])
        return np.concatenate([axis[:, None], rest], axis=1)
