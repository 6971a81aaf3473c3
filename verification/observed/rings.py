"""Forces and motions of the surfaces of finite elements, computed again from the tractions.

Displacements are computed with the compliances of the sections and averaged over the hat functions
of the rings, as gap and slip are.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fem_reference import Increment, Path, Result
from fem_reference.model import ContactModel, outermost_modulus
from fem_reference.scales import Scales

Field = NDArray[np.float64]

# Gauss points of an element: exact for the product of r and a function linear on it.
PLACES, PARTS = np.polynomial.legendre.leggauss(2)


def model_of(result: Result, length: float) -> ContactModel:
    """Create the contact model of the bodies of a result.

    length  unit of length of its sections [length]
    """
    scales = Scales(length, outermost_modulus(result.scene))
    bodies = result.scene.model_copy(update={"rig": None})  # motions of the contact
    return ContactModel(bodies, scales, result.sections)


def section_radii(result: Result) -> Field:
    """Return the radii of the nodes of a section, corner and midside alternating [1]."""
    return next(np.asarray(s.radii) for s in result.sections if s is not None)


def along_load(model: ContactModel) -> Field:
    """Compute the mean displacement along the load around the axis, per nodal force along the
    load."""
    C = model.compliance(1).matrix
    return np.asarray(0.5 * (C[0, :, 0] - C[0, :, 1] - C[1, :, 0] + C[1, :, 1]))


@dataclass(frozen=True)
class Rings:
    """Points on rings and angles; fields are (rings, angles), vectors (2, rings, angles) in r, θ.

    path    of the result
    angles  of the half circle, ends included; one angle for axisymmetric fields
    """

    model: ContactModel
    path: Path
    angles: Field

    @classmethod
    def of(cls, result: Result) -> Rings:
        """Create the rings of the increments of a result."""
        last = result.increments[-1]
        corners = section_radii(result)[::2]
        model = model_of(result, float(last.radii[-1] / corners[len(last.radii) - 1]))
        return cls(model, result.plan.path, np.zeros(1) if last.angles is None else last.angles)

    @cached_property
    def driven(self) -> Field:
        """Motion of the points per unit shift along the load, or per unit twist, of the indenter.

        Zero without a tangential load. The motion by a twist is the mean over a ring [length].
        """
        if self.path is Path.TWISTING:
            hats = self.model.hats
            return np.stack([self.on_grid(None), self.on_grid(hats.arms / hats.weights)])
        vector = np.stack([np.cos(self.angles), -np.sin(self.angles)])[:, None]
        tangential = self.path is Path.SHEARING or len(self.angles) > 1
        return np.broadcast_to(vector if tangential else 0.0, (2, *self._shape))

    @cached_property
    def weights(self) -> Field:
        """Area of the points [length^2]."""
        return np.outer(self.model.hats.weights, self._around)

    @cached_property
    def undeformed(self) -> Field:
        """Gap before any load [length]."""
        hats = self.model.hats
        return self.on_grid(hats.of(self.model.gap) / hats.weights)

    def on_grid(self, values: Field | None) -> Field:
        """Extend values of the rings to all angles; None is zero."""
        if values is None:
            return np.zeros(self._shape)
        return np.broadcast_to(values if values.ndim == 2 else values[:, None], self._shape)

    def stretched(self, increment: Increment) -> Field:
        """Compute the displacement by the strain of the lower body, averaged over a ring
        [length]."""
        strain = 0.0 if increment.bulk_strain is None else increment.bulk_strain[0]
        hats = self.model.hats
        return np.stack([self.on_grid(strain * hats.arms / hats.weights), self.on_grid(None)])

    def shear(self, increment: Increment) -> Field:
        """Return q of an increment."""
        return self._vector(increment, "shear")

    def slip(self, increment: Increment) -> Field:
        """Return s of an increment."""
        return self._vector(increment, "slip")

    def _vector(self, increment: Increment, name: str) -> Field:
        along = getattr(increment, f"{name}_along_load")
        if along is not None:
            return np.stack([self.on_grid(along), self.on_grid(None)])
        around = (getattr(increment, f"{name}_{part}") for part in ("radial", "circumferential"))
        return np.stack([self.on_grid(component) for component in around])

    def integral(self, values: Field) -> float:
        """Integrate values that are linear between rings over the surface."""
        radii, on_ring = self.model.hats.radii, values @ self._around
        share, width = 0.5 * (1 + PLACES), np.diff(radii)[:, None]
        r = radii[:-1, None] + width * share
        at_points = on_ring[:-1, None] * (1 - share) + on_ring[1:, None] * share
        return float(np.sum(0.5 * width * PARTS * r * at_points))

    def displacement(self, p: Field, q: Field) -> tuple[Field, Field]:
        """Compute u along the surface and u_z of the lower body relative to the indenter
        [length]."""
        if self.path is Path.SHEARING:
            return np.stack([self._along_load(q[0]), self.on_grid(None)]), self._pressed(p)
        if self.path is Path.TWISTING:
            return np.stack([self.on_grid(None), self._around_axis(q[1])]), self._pressed(p)
        tractions, u = np.stack([*q, p]), np.zeros((3, *self._shape))
        for n in range(len(self.angles)):
            wave, loads = self._waves(n), self._amplitudes(n, tractions)
            if not np.any(loads):
                continue
            condensed = self.model.compliance(n)
            for i, a in enumerate(condensed.motion.components):
                for j, b in enumerate(condensed.motion.components):
                    u[a] += np.outer(self._means(condensed.matrix[i, :, j], loads[b]), wave[a])
        if len(self.angles) > 1:
            self._join_on_axis(u)
        return u[:2], u[2]

    @property
    def _shape(self) -> tuple[int, int]:
        return len(self.model.hats.radii), len(self.angles)

    @cached_property
    def _around(self) -> Field:
        """Weights of the angles: the trapezium rule."""
        if len(self.angles) == 1:
            return np.array([2 * np.pi])
        share = np.full(len(self.angles), 2 * self.angles[1])
        share[[0, -1]] /= 2
        return share

    def _waves(self, n: int) -> Field:
        """Return the angular functions of the r, θ and z components of harmonic n (3, angles)."""
        inner = (self.angles > 0) & (np.arange(len(self.angles)) < len(self.angles) - 1)
        cos, sin = np.cos(n * self.angles), np.where(inner, np.sin(n * self.angles), 0.0)
        # There are as many angles as harmonics, so that the last sine vanishes on all of them.
        return np.stack([cos, sin if n < len(self.angles) - 1 else 0.0 * sin, cos])

    def _amplitudes(self, n: int, tractions: Field) -> Field:
        """Compute the amplitudes (3, rings) of harmonic n, for which the trapezium rule is
        exact."""
        waves = self._waves(n)
        norms = np.sum(self._around * waves**2, axis=1)
        found = np.einsum("cra,ca,a->cr", tractions, waves, self._around)
        return found / np.where(norms > 0, norms, 1.0)[:, None]

    def _means(self, nodal: Field, amplitude: Field) -> Field:
        hats = self.model.hats
        displaced = nodal @ (hats.products @ amplitude)
        return np.asarray(hats.products.T @ displaced) / hats.weights

    def _pressed(self, p: Field) -> Field:
        return self._means(self.model.compliance(0).matrix[1, :, 1], p[:, 0])[:, None]

    def _along_load(self, q: Field) -> Field:
        """Compute the displacement along the load by shear along the load, averaged over a ring."""
        return self._means(along_load(self.model), q[:, 0])[:, None]

    def _around_axis(self, q: Field) -> Field:
        """Compute the circumferential displacement by circumferential shear."""
        return self._means(self.model.torsion().matrix[0, :, 0], q[:, 0])[:, None]

    def _join_on_axis(self, u: Field) -> None:
        """Replace the motions of the points on the axis by their common mean."""
        share, direction = self._around / (2 * np.pi), self.driven[:, 0]
        u[:2, 0] = np.sum(share * u[:2, 0] * direction) * direction
        u[2, 0] = np.sum(share * u[2, 0])
