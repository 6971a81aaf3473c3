"""What leads the indenter towards the body: a given force or a given approach.

A load says which motion closes a gap, which pressures carry it, and what the conjugate gradients of
`semi_analytical.normal.normal_problem` must leave as it is.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from contact_scene.array_types import Field, Mask, Vector

Map = Callable[[Field], Field]

Motion = float | Vector
# Takes a field and returns what of it is in contact, without its part along rigid motions whose
# force is given: orthogonal, so that the preconditioner between two of it stays symmetric.
Projection = Callable[[Field], Field]


class NormalLoad(Protocol):
    """What leads the indenter towards the body. Its motion is the approach, or a vector of that
    and what else it can do."""

    def touches(self, gap: Field) -> bool:
        """Whether some pressure below an undeformed gap can carry the load."""

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Below what gap the cells bear the load, by Hertz's law (see `initial_pressure`) [length].

        gaps       undeformed, of all cells, in ascending order [length]
        stiffness  Σp over the depth, where so many cells bear [force/length^3]
        """

    def motion(self, p: Field, s: Field) -> Motion:
        """The motion that closes a gap s best, as the pressure weighs it."""

    def closure(self, motion: Motion) -> float | Field:
        """By how much a motion closes the gap [length]."""

    def overlap(self, motion: Motion, gap: Field, allowed: Mask) -> float:
        """How far undeformed bodies would overlap: the measure of residual gaps [length]."""

    def admissible(self, p: Field) -> Field:
        """A pressure without tension that carries the load, near the one given."""

    def projection(self, inside: Field) -> Projection:
        """To changes of the pressure that keep given forces; `inside` is 1 in contact, else 0."""

    def less(self, carried: Field) -> NormalLoad:
        """The load without pressures (nx, ny) that cells beside its own carry."""

    def free_motions(self, shape: tuple[int, ...]) -> tuple[Field, ...]:
        """Closures by unit motions whose forces are given, fields of this shape (nx, ny)."""


@dataclass(frozen=True)
class PressureSum:
    """Force control: the sum Σp of all cell pressures, W / cell area [force/length^2]."""

    total: float

    def touches(self, gap: Field) -> bool:
        """Whether there is a body to press on."""
        return bool(np.isfinite(np.min(gap)))

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """As the area grows with the depth, so that both carry the sum."""
        bearing = int(np.searchsorted(stiffness * gaps, self.total))
        return float(self.total / stiffness[max(bearing - 1, 0)])

    def motion(self, p: Field, s: Field) -> Motion:
        """The approach: the multiplier of the sum."""
        return float(np.vdot(p, s) / p.sum())

    def closure(self, motion: Motion) -> float | Field:
        """The approach, everywhere the same."""
        return motion

    def overlap(self, motion: Motion, gap: Field, allowed: Mask) -> float:
        """The approach."""
        return abs(float(motion))

    def admissible(self, p: Field) -> Field:
        """Cut off at zero and scaled to the sum."""
        p = np.maximum(p, 0.0)
        return np.asarray(p * (self.total / p.sum()))

    def projection(self, inside: Field) -> Projection:
        """What is left without the mean: the approach is a rigid shift, and the sum of the
        pressure stays."""
        count = inside.sum()

        def projected(field: Field) -> Field:
            left = field - np.vdot(field, inside) / count
            left *= inside
            return left

        return projected

    def less(self, carried: Field) -> NormalLoad:
        """What is left of the sum."""
        return PressureSum(self.total - float(np.sum(carried)))

    def free_motions(self, shape: tuple[int, ...]) -> tuple[Field, ...]:
        """The approach."""
        return (np.ones(shape),)


@dataclass(frozen=True)
class FixedApproach:
    """Displacement control: the approach of the two bodies [length]."""

    approach: float

    def touches(self, gap: Field) -> bool:
        """Whether the approach closes the gap somewhere."""
        return float(np.min(gap)) < self.approach

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Half of the approach."""
        return 0.5 * self.approach

    def motion(self, p: Field, s: Field) -> Motion:
        """The approach."""
        return self.approach

    def closure(self, motion: Motion) -> float | Field:
        """The approach, everywhere the same."""
        return motion

    def overlap(self, motion: Motion, gap: Field, allowed: Mask) -> float:
        """The approach."""
        return abs(float(motion))

    def admissible(self, p: Field) -> Field:
        """Cut off at zero."""
        return np.maximum(p, 0.0)

    def projection(self, inside: Field) -> Projection:
        """All of it: no force is given."""
        return lambda field: field * inside

    def less(self, carried: Field) -> NormalLoad:
        """The same: no force is given."""
        return self

    def free_motions(self, shape: tuple[int, ...]) -> tuple[Field, ...]:
        """None."""
        return ()
