"""Compliance between the points (r_i, θ_j): the harmonics put together."""

from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field, Matrix, Vector
from fem_reference.compliance.angular_grid import AngularGrid
from fem_reference.compliance.ring_compliance import RingCompliance

Scalar = TypeVar("Scalar", np.float64, np.bool_)


@dataclass(frozen=True)
class PointCompliance:
    """Displacements of all points by tractions on all points, weighted with the area of a point.

    The point on ring r_i at angle θ_j stands for the area w_ij = Δθ_j ∫ φ_i r dr. The first ring is
    one point: on several angles it is the axis, with one traction for the whole hat that peaks
    there. Fields on points are flat (points,), the axis first, then ring by ring; vectors
    (2, points) are r and θ components, on the axis of several angles x and y.

    rings, grid  where the points are
    springs      compliance of springs between the surfaces, the same along and across them
                 [length^3/force]: zero, or one over a penalty
    """

    rings: RingCompliance
    grid: AngularGrid
    springs: float = 0.0

    @property
    def shape(self) -> tuple[int, int]:
        """Rings, the axis among them, and angles."""
        return len(self.rings.radii), self.grid.points

    @cached_property
    def ring_of_point(self) -> NDArray[np.intp]:
        """Index of the ring of each point (points,)."""
        rings, angles = self.shape
        return np.concatenate([[0], np.repeat(np.arange(1, rings), angles)])

    @cached_property
    def areas(self) -> Vector:
        """w (points,) [length^2]; their sum is the area of the zone."""
        weights = self.grid.weights
        around = np.tile(weights, len(self.rings.radii) - 1)
        return self.rings.areas[self.ring_of_point] * np.concatenate([[np.sum(weights)], around])

    @cached_property
    def motion(self) -> Field:
        """Displacement of the points per unit of the indenter's shift or twist (2, points)."""
        if self.grid.highest == 0:
            return self.rings.motion
        around = np.tile(self._e_x_around, len(self.rings.radii) - 1)
        return np.concatenate([[[1.0], [0.0]], around], axis=1)

    @cached_property
    def stretch(self) -> Field:
        """Displacement of the points per unit of an equibiaxial strain (2, points) [length]."""
        outward = self.rings.stretch[self.ring_of_point]
        return np.stack([outward, np.zeros_like(outward)])

    @cached_property
    def along(self) -> Field:
        """Load, a force or torque: Σ along · q (2, points) [length^2] or [length^3]."""
        return np.asarray(self.areas * self.motion)

    @cached_property
    def carries_shear(self) -> NDArray[np.bool_]:
        """Mask of the points that can carry shear (points,).

        The axis carries shear only along a tangential load.
        """
        on_axis = self.rings.radii[self.ring_of_point] == 0.0
        return np.asarray(~on_axis | (self.motion[0] != 0.0))

    @cached_property
    def couples(self) -> bool:
        """True if pressure causes relative tangential displacement."""
        return any(np.any(A[:2, :, 2]) for A in self.rings.harmonics)

    @cached_property
    def matrix(self) -> Matrix:
        """K (3 points, 3 points), components r, θ, z outermost: w u = K t. Symmetric, positive
        definite. Where mirror symmetry leaves no component, a diagonal entry keeps it zero.

        K_ab = Σ_n c_n A^n_ab ⊗ D_aᵀ D_b with D the amplitudes from point values.
        """
        rings, angles = self.shape
        harmonics = np.stack(self.rings.harmonics[: self.grid.highest + 1], axis=-1)
        harmonics = harmonics * self.grid.norms
        blocks = np.empty((3, rings, angles, 3, rings, angles))
        for a, analysis in enumerate(self.grid.transforms):
            for b, synthesis in enumerate(self.grid.transforms):
                around = np.einsum("nj,nl->njl", analysis, synthesis)
                block = np.tensordot(harmonics[a, :, b], around, axes=1)
                blocks[a, :, :, b] = block.transpose(0, 2, 1, 3)
        by_rings = self._summed_on_axis(blocks).transpose(2, 3, 4, 0, 1)
        K = self._summed_on_axis(by_rings).reshape(2 * (3 * len(self.areas),))
        diagonal = np.diagonal(K).reshape(3, -1)
        diagonal = np.where(diagonal == 0, diagonal[2], diagonal)
        K[np.diag_indices_from(K)] = (diagonal + self.springs * self.areas).ravel()
        return K

    def displacement(self, pressure: Vector, shear: Field) -> tuple[Field, Vector]:
        """Compute u_t (2, points) and u_z (points,) [length] harmonic by harmonic.

        The matrix is not used. u_t is zero at points that cannot carry shear.
        """
        tractions = np.stack([*shear, pressure])
        amplitudes = self.grid.amplitudes(self._spread(tractions))
        weak = np.stack(
            [
                np.einsum("aibk,bk->ai", A, amplitudes[:, :, n])
                for n, A in enumerate(self.rings.harmonics[: self.grid.highest + 1])
            ],
            axis=-1,
        )
        w_u = self._summed_on_axis(self.grid.at_points(weak) * self.grid.weights)
        u = w_u / self.areas + self.springs * tractions
        return u[:2] * self.carries_shear, u[2]

    def scalar_on_grid(self, values: NDArray[Scalar]) -> NDArray[Scalar]:
        """Convert values at points to (rings, angles)."""
        rings, angles = self.shape
        on_grid = [np.repeat(values[:1], angles), values[1:]]
        return np.concatenate(on_grid).reshape(rings, angles)

    def vector_on_grid(self, values: Field) -> Field:
        """Convert a vector at points to r and θ components (2, rings, angles)."""
        return self._spread(np.stack([*values, np.zeros_like(values[0])]))[:2]

    @cached_property
    def _e_x_around(self) -> Field:
        """e_x in r, θ components (2, angles)."""
        cos, sin = np.cos(self.grid.angles), np.sin(self.grid.angles)
        return np.stack([cos, np.where(np.any(self.grid.sines, axis=0), -sin, 0.0)])

    @cached_property
    def _axis(self) -> Field:
        """Unit tractions of the axis x, y, z (3,) in components r, θ, z (3,) at all angles: none
        along y, by mirror symmetry. Where nothing depends on θ it is a ring like the others."""
        if self.grid.highest == 0:
            return np.eye(3)[:, :, None]
        unit = np.zeros((3, 3, self.grid.points))
        unit[2, 2] = 1.0
        unit[0, :2] = self._e_x_around
        return unit

    def _spread(self, values: Field) -> Field:
        """Convert values at points (3, points) to (3, rings, angles)."""
        rings, angles = self.shape
        axis = np.einsum("cak,c->ak", self._axis, values[:, 0])
        return np.concatenate([axis[:, None], values[:, 1:].reshape(3, rings - 1, angles)], axis=1)

    def _summed_on_axis(self, weak: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the displacement (3, points, …) on which tractions (3, rings, angles, …) do
        work."""
        axis = np.einsum("cak,ak...->c...", self._axis, weak[:, 0])
        rest = weak[:, 1:].reshape(3, -1, *weak.shape[3:])
        return np.concatenate([axis[:, None], rest], axis=1)
