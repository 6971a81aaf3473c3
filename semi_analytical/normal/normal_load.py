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
    """Interface of the load of the normal problem: prescribed force, approach or moments.

    The rigid motion of a load is the approach, or a vector (approach, tilt x, tilt y).
    """

    def touches(self, gap: Field) -> bool:
        """Return True if a pressure on the cells of finite gap can carry the load.

        Otherwise the grid is too coarse, or the bodies do not touch.

        gap  undeformed gap (nx, ny) [length]; infinite where contact is impossible
        """

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Return the depth below which cells carry the load in the initial guess of the pressure
        [length].

        The initial guess applies Hertz theory: cells with an undeformed gap below this depth are in
        contact.

        gaps       undeformed gaps of all cells, in ascending order [length]
        stiffness  Σp over the depth, as a function of the number of these cells [force/length^3]
        """

    def motion(self, p: Field, s: Field) -> Motion:
        """Compute the rigid motion that closes a gap in the least-squares sense, weighted by the
        pressure.

        p  pressure (nx, ny)
        s  gap before the rigid motion (nx, ny) [length]
        """

    def closure(self, motion: Motion) -> float | Field:
        """Return the closure of the gap by a rigid motion [length]; by default the approach."""
        return motion

    def overlap(self, motion: Motion, gap: Field, allowed: Mask) -> float:
        """Return the overlap of the undeformed bodies, the scale of residual gaps [length].

        By default the overlap is the magnitude of the approach.

        motion   rigid motion of the load
        gap      undeformed gap (nx, ny)
        allowed  cells of finite gap (nx, ny)
        """
        return abs(float(motion))

    def admissible(self, p: Field) -> Field:
        """Return a non-negative pressure near p (nx, ny) that carries the prescribed load."""

    def projection(self, inside: Field) -> Projection:
        """Return the projection of pressure changes on changes that preserve the prescribed forces.

        inside  1 in contact, 0 elsewhere (nx, ny)
        """

    def less(self, carried: Field) -> NormalLoad:
        """Return the load that remains for the solver if other cells carry given pressures.

        carried  pressures of the other cells (nx, ny)
        """
        return self

    def free_motions(self, shape: tuple[int, ...]) -> tuple[Field, ...]:
        """Return the closures of the gap (nx, ny) by unit rigid motions whose conjugate forces are
        prescribed.

        Without a prescribed force or moment there is none.

        shape  number of cells (nx, ny)
        """
        return ()


@dataclass(frozen=True)
class PressureSum(NormalLoad):
    """Force control of the normal problem: the sum Σp of the pressure over all cells is prescribed.

    total  normal force over cell area [force/length^2]
    """

    total: float

    def touches(self, gap: Field) -> bool:
        """Return True if the gap of at least one cell is finite, so that this cell can carry the
        force."""
        return bool(np.isfinite(np.min(gap)))

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Return the depth below which cells carry the prescribed force in the initial guess
        [length].

        gaps       undeformed gaps of all cells, in ascending order [length]
        stiffness  Σp over the depth, as a function of the number of these cells [force/length^3]
        """
        bearing = int(np.searchsorted(stiffness * gaps, self.total))
        return float(self.total / stiffness[max(bearing - 1, 0)])

    def motion(self, p: Field, s: Field) -> Motion:
        """Return the approach that closes the gap on average [length]: mean of s, weighted by the
        pressure p.

        p  pressure (nx, ny)
        s  gap before the rigid motion (nx, ny) [length]
        """
        return float(np.vdot(p, s) / p.sum())

    def admissible(self, p: Field) -> Field:
        """Set negative pressures to zero and scale the pressure to the prescribed sum."""
        p = np.maximum(p, 0.0)
        return np.asarray(p * (self.total / p.sum()))

    def projection(self, inside: Field) -> Projection:
        """Return the projection of pressure changes on changes that preserve the sum Σp.

        The projection restricts a change to the contact and subtracts its mean over the contact.

        inside  1 in contact, 0 elsewhere (nx, ny)
        """
        count = inside.sum()

        def projected(field: Field) -> Field:
            left = field - np.vdot(field, inside) / count
            left *= inside
            return left

        return projected

    def less(self, carried: Field) -> NormalLoad:
        """Return the load less the sum of the pressures that other cells carry.

        carried  pressures of the other cells (nx, ny)
        """
        return PressureSum(self.total - float(np.sum(carried)))

    def free_motions(self, shape: tuple[int, ...]) -> tuple[Field, ...]:
        """Return the unit approach as a field (nx, ny) of ones."""
        return (np.ones(shape),)


@dataclass(frozen=True)
class FixedApproach(NormalLoad):
    """Displacement control of the normal problem: the approach of the two bodies is prescribed.

    approach  approach [length]
    """

    approach: float

    def touches(self, gap: Field) -> bool:
        """Return True if the approach closes the undeformed gap of at least one cell."""
        return float(np.min(gap)) < self.approach

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Return half of the approach, the bearing depth of Hertz theory [length]."""
        return 0.5 * self.approach

    def motion(self, p: Field, s: Field) -> Motion:
        """Return the prescribed approach [length], which does not depend on pressure and gap."""
        return self.approach

    def admissible(self, p: Field) -> Field:
        """Return the pressure with negative values set to zero."""
        return np.maximum(p, 0.0)

    def projection(self, inside: Field) -> Projection:
        """Return the projection of pressure changes: the restriction to the cells in contact.

        No force is prescribed that the projection must preserve.
        """
        return lambda field: field * inside
