"""Load of the normal problem: prescribed force or prescribed approach.

A load defines the closure of the gap by its rigid motion, the set of admissible pressures, and the
projection used by the conjugate gradients of `semi_analytical.normal.normal_problem`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from contact_scene.array_types import Field, Mask, Vector

Map = Callable[[Field], Field]

Motion = float | Vector
# Restricts a field to the contact and removes its components along rigid motions of prescribed
# force. The projection is orthogonal, so that the projected preconditioner is symmetric.
Projection = Callable[[Field], Field]


class NormalLoad(Protocol):
    """Load of the normal problem. Its motion is the approach, or a vector (approach, tilt x, tilt
    y)."""

    def touches(self, gap: Field) -> bool:
        """Return whether an admissible pressure on cells of finite closure can carry the load."""

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Return the depth below which cells bear the load in Hertz theory (`initial_pressure`)
        [length].

        gaps       undeformed, of all cells, in ascending order [length]
        stiffness  Σp over the depth, as a function of the number of bearing cells [force/length^3]
        """

    def motion(self, p: Field, s: Field) -> Motion:
        """Compute the motion that closes a gap s in the least-squares sense, weighted by the
        pressure."""

    def closure(self, motion: Motion) -> float | Field:
        """Return the closure of the gap by a motion, by default the approach [length]."""
        return motion

    def overlap(self, motion: Motion, gap: Field, allowed: Mask) -> float:
        """Return the overlap of the undeformed bodies, the scale of residual gaps [length].

        By default it is the magnitude of the approach.
        """
        return abs(float(motion))

    def admissible(self, p: Field) -> Field:
        """Return a non-negative pressure near the given one that carries the load."""

    def projection(self, inside: Field) -> Projection:
        """Return the projection on pressure changes that preserve prescribed forces.

        inside  1 in contact, 0 elsewhere
        """

    def less(self, carried: Field) -> NormalLoad:
        """Subtract the prescribed resultants of pressures (nx, ny) carried by other cells."""
        return self

    def free_motions(self, shape: tuple[int, ...]) -> tuple[Field, ...]:
        """Return the closures (nx, ny) by unit motions whose forces are prescribed."""
        return ()


@dataclass(frozen=True)
class PressureSum(NormalLoad):
    """Force control: sum Σp of all cell pressures, W / cell area [force/length^2]."""

    total: float

    def touches(self, gap: Field) -> bool:
        """Return whether the gap is finite anywhere."""
        return bool(np.isfinite(np.min(gap)))

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Determine the depth whose bearing cells carry the sum."""
        bearing = int(np.searchsorted(stiffness * gaps, self.total))
        return float(self.total / stiffness[max(bearing - 1, 0)])

    def motion(self, p: Field, s: Field) -> Motion:
        """Return the approach, the multiplier of the sum."""
        return float(np.vdot(p, s) / p.sum())

    def admissible(self, p: Field) -> Field:
        """Cut the pressure off at zero and scale it to the sum."""
        p = np.maximum(p, 0.0)
        return np.asarray(p * (self.total / p.sum()))

    def projection(self, inside: Field) -> Projection:
        """Return the projection on the contact that removes the mean and thus preserves the sum."""
        count = inside.sum()

        def projected(field: Field) -> Field:
            left = field - np.vdot(field, inside) / count
            left *= inside
            return left

        return projected

    def less(self, carried: Field) -> NormalLoad:
        """Subtract the sum carried by other cells."""
        return PressureSum(self.total - float(np.sum(carried)))

    def free_motions(self, shape: tuple[int, ...]) -> tuple[Field, ...]:
        """Return the unit approach."""
        return (np.ones(shape),)


@dataclass(frozen=True)
class FixedApproach(NormalLoad):
    """Displacement control: the approach of the two bodies [length]."""

    approach: float

    def touches(self, gap: Field) -> bool:
        """Return whether the approach closes the gap at a cell."""
        return float(np.min(gap)) < self.approach

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Return half of the approach."""
        return 0.5 * self.approach

    def motion(self, p: Field, s: Field) -> Motion:
        """Return the approach."""
        return self.approach

    def admissible(self, p: Field) -> Field:
        """Return the pressure cut off at zero."""
        return np.maximum(p, 0.0)

    def projection(self, inside: Field) -> Projection:
        """Return the restriction to the contact: no force is prescribed."""
        return lambda field: field * inside
