"""Rigid motions of the indenter, and the forces and moments conjugate to them.

A rigid motion m displaces the points of the indenter by m R, with the shape R of the motion. Its
conjugate force is Σ R·t over the points, with the tractions t: forces and moments are divided by
the area of a point. Approach and tilts reduce the gap of the points. Shifts and twist displace them
tangentially. Shapes should be of the order 1, so that forces and moments are comparable.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field, Indices, Mask, Matrix, Vector


@dataclass(frozen=True)
class RigidMotion:
    """Rigid motion of the indenter: shape, and prescribed force or prescribed value.

    shape   displacement of the points by the unit motion (c, n), or (c, 1) if it is uniform, with c
            = 1 component of the gap or 2 tangential components
    force   prescribed conjugate force; None where the motion is prescribed
    value   prescribed motion; with a spring, the motion of its far end
    spring  extension per conjugate force of a spring between a prescribed motion and the indenter,
            which `displace` contains; 0 without one
    """

    shape: Field
    force: float | None = None
    value: float = 0.0
    spring: float = 0.0


@dataclass(frozen=True)
class RigidMotions:
    """Several rigid motions of the indenter, the uniform ones first; vectors are in this order.

    components  number of components of tractions and shapes, 1 or 2
    each        the motions (k,)
    """

    components: int
    each: tuple[RigidMotion, ...] = ()

    def __len__(self) -> int:
        return len(self.each)

    @cached_property
    def shapes(self) -> MotionShapes:
        """Shapes of the motions."""
        uniform = [one.shape[:, 0] for one in self.each if one.shape.shape[1] == 1]
        varying = [one.shape for one in self.each if one.shape.shape[1] > 1]
        return MotionShapes(
            np.array(uniform).reshape(len(uniform), self.components),
            np.array(varying) if varying else np.empty((0, self.components, 1)),
        )

    @cached_property
    def values(self) -> Vector:
        """Prescribed motions (k,); 0 where the force is prescribed."""
        return np.array([one.value if one.force is None else 0.0 for one in self.each])

    @cached_property
    def springs(self) -> Vector:
        """Extensions of the springs per force (k,); 0 without a spring."""
        return np.array([one.spring for one in self.each])

    @cached_property
    def prescribed_forces(self) -> Vector:
        """Prescribed forces (k,) of motions with a prescribed force; an error for other motions."""
        return np.array([one.force for one in self.each], dtype=float)

    @cached_property
    def is_held(self) -> Mask:
        """Mask (k,) of the motions whose force is prescribed."""
        return np.array([one.force is not None for one in self.each], dtype=bool)

    @cached_property
    def is_free(self) -> Mask:
        """Mask (k,) of the motions of the contact that are not prescribed.

        Their force is prescribed, or a spring connects the indenter with a prescribed motion.
        """
        return self.is_held | (self.springs > 0)

    @cached_property
    def held(self) -> RigidMotions:
        """Motions whose force is prescribed: multipliers of these forces."""
        return self._where(self.is_held)

    @cached_property
    def free(self) -> RigidMotions:
        """Motions of the contact that are not prescribed."""
        return self._where(self.is_free)

    def _where(self, chosen: Mask) -> RigidMotions:
        each = tuple(one for one, is_chosen in zip(self.each, chosen, strict=True) if is_chosen)
        return RigidMotions(self.components, each)

    def less(self, tractions: Field) -> RigidMotions:
        """Return the motions with their prescribed forces reduced by those of given tractions.

        tractions  tractions of points that are excluded from the problem (c, n)
        """
        each = (
            one if one.force is None else replace(one, force=one.force - float(force))
            for one, force in zip(self.each, self.forces(tractions), strict=True)
        )
        return RigidMotions(self.components, tuple(each))

    def displacement(self, motion: Vector) -> Field:
        """Compute the displacement of the points by a motion: (c, n), or (c, 1) if it is uniform.

        motion  components of the motion (k,)
        """
        return self.shapes.displacement(motion)

    def forces(self, tractions: Field) -> Vector:
        """Compute the forces (k,) of tractions (c, n), conjugate to the motions."""
        return self.shapes.forces(tractions)


@dataclass(frozen=True, eq=False)
class MotionShapes:
    """Displacements of the points by unit motions of the indenter, the uniform ones first.

    uniform  displacement of all points by uniform motions (k, c)
    varying  displacement of each point by the other motions (k, c, n)
    """

    uniform: Matrix
    varying: Field

    def __len__(self) -> int:
        return len(self.uniform) + len(self.varying)

    def at(self, points: Indices) -> MotionShapes:
        """Return the same motions of a selection of points.

        points  indices of the points
        """
        if not len(self.varying):
            return self
        return MotionShapes(self.uniform, self.varying.take(points, axis=2))

    def displacement(self, motion: Vector) -> Field:
        """Compute the displacement of the points by a motion: (c, n), or (c, 1) if it is uniform.

        motion  components of the motion (k,)
        """
        count = len(self.uniform)
        moved = (motion[:count] @ self.uniform)[:, None]
        for size, shape in zip(motion[count:], self.varying, strict=True):
            moved = moved + size * shape
        return np.asarray(moved)

    def forces(self, tractions: Field) -> Vector:
        """Compute the forces (k,) of tractions (c, n), conjugate to the motions."""
        if not len(self.varying):
            return np.asarray(self.uniform @ tractions.sum(axis=1))
        varying = (self.varying * tractions).sum(axis=(1, 2))
        if not len(self.uniform):
            return np.asarray(varying)
        return np.concatenate([self.uniform @ tractions.sum(axis=1), varying])

    def along(self, vectors: Field) -> Field:
        """Compute the scalar products (k, n) of the unit motions with a vector (c, n) per point."""
        if not len(self.varying):
            return np.asarray(self.uniform @ vectors)
        return np.concatenate([self.uniform @ vectors, (self.varying * vectors).sum(axis=1)])

    def products(self, weight: Vector) -> Matrix:
        """Compute the scalar products (k, k) of the unit motions, with a weight of each point.

        weight  weights (n,)
        """
        uniform = weight.sum() * (self.uniform @ self.uniform.T)
        if not len(self.varying):
            return np.asarray(uniform)
        weighted = self.varying * weight
        varying = np.einsum("kcn,lcn->kl", weighted, self.varying)
        if not len(self.uniform):
            return np.asarray(varying)
        mixed = self.uniform @ weighted.sum(axis=2).T
        return np.block([[uniform, mixed], [mixed.T, varying]])
