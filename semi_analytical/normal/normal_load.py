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
from contact_scene.solver_errors import NotConverged

Map = Callable[[Field], Field]

Motion = float | Vector
# Restricts a field to the contact and removes its components along rigid motions of prescribed
# force. The projection is orthogonal, so that the projected preconditioner is symmetric.
Projection = Callable[[Field], Field]


class NormalLoad(Protocol):
    """Interface of the prescribed load of the normal problem: force or approach, and moments.

    The normal problem determines the pressure and the rigid motion of the indenter under this load.
    The rigid motion is the approach, or a vector (approach, tilt x, tilt y) under moments.
    """

    def touches(self, gap: Field) -> bool:
        """Return True if cells of finite gap can carry the prescribed normal load.

        Otherwise the grid is too coarse, or the bodies do not touch at the prescribed approach.

        gap  undeformed gap (nx, ny) [length]; infinite where contact is impossible
        """

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Return the bearing depth of the load, for the initial guess of the pressure [length].

        The guess follows from Hertz theory: cells whose undeformed gap is below the bearing depth
        are in contact.

        gaps       distinct finite undeformed gaps of the cells, ascending (k,) [length]
        stiffness  Σp divided by the bearing depth, if all cells up to each of these gaps are in
                   contact (k,) [force/length^3]
        """

    def motion(self, p: Field, s: Field) -> Motion:
        """Compute the rigid motion of the indenter that closes the gap under the present pressure.

        A prescribed component of the motion is returned unchanged. The other components minimise
        the sum of the squared gaps of all cells, weighted by the pressure.

        p  pressure (nx, ny)
        s  gap before the rigid motion (nx, ny) [length]: undeformed gap plus displacement
        """

    def closure(self, motion: Motion) -> float | Field:
        """Compute the reduction of the gap by a rigid motion of the indenter [length].

        By default the rigid motion is the approach, which reduces the gap equally in all cells.

        motion  approach, or vector (approach, tilt x, tilt y)
        """
        return motion

    def overlap(self, motion: Motion, gap: Field, allowed: Mask) -> float:
        """Return the overlap of the undeformed bodies at a rigid motion of the indenter [length].

        Residual gaps are divided by this overlap. By default the overlap is the magnitude of the
        approach.

        motion   rigid motion of the indenter
        gap      undeformed gap (nx, ny) [length]
        allowed  cells of finite gap (nx, ny)
        """
        return abs(float(motion))

    def admissible(self, p: Field) -> Field:
        """Return a non-negative pressure near a given one with the prescribed force and moments.

        p  given pressure (nx, ny)
        """

    def projection(self, inside: Field) -> Projection:
        """Return a linear projection of pressure changes, for conjugate gradients on a contact set.

        A projected change is zero outside the contact and does not change the prescribed force and
        moments.

        inside  1 in contact, 0 elsewhere (nx, ny)
        """

    def less(self, carried: Field) -> NormalLoad:
        """Return the normal load reduced by the force and the moments of given cell pressures.

        The edge correction fixes the pressure of edge cells and solves for the other cells, which
        carry the reduced load. By default the load is not changed.

        carried  fixed pressure of the edge cells, zero in other cells (nx, ny)
        """
        return self

    def free_motions(self, shape: tuple[int, ...]) -> tuple[Field, ...]:
        """Return the closures of the gap by the unit rigid motions that the load leaves free.

        A rigid motion (approach, tilt) is free if its conjugate force or moment is prescribed. Its
        closure is a field (nx, ny). By default there is none.

        shape  number of cells (nx, ny)
        """
        return ()


@dataclass(frozen=True)
class PressureSum(NormalLoad):
    """Force control of the normal problem: the normal force is prescribed.

    The force is the sum Σp of the pressure over all cells times the cell area.

    total  normal force over cell area [force/length^2]
    """

    total: float

    def touches(self, gap: Field) -> bool:
        """Return True if the prescribed normal force can be carried: a cell has a finite gap.

        The gap is infinite where contact is impossible, as outside the indenter.

        gap  undeformed gap (nx, ny) [length]
        """
        return bool(np.isfinite(np.min(gap)))

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Return the depth at which cells carry the prescribed force by Hertz theory [length].

        In the initial guess of the pressure, cells whose undeformed gap is below this depth are in
        contact.

        gaps       distinct finite undeformed gaps of the cells, ascending (k,) [length]
        stiffness  Σp divided by the bearing depth, if all cells up to each of these gaps are in
                   contact (k,) [force/length^3]
        """
        bearing = int(np.searchsorted(stiffness * gaps, self.total))
        return float(self.total / stiffness[max(bearing - 1, 0)])

    def motion(self, p: Field, s: Field) -> Motion:
        """Compute the approach of the bodies at which the gap is zero on average [length].

        The average over the cells is weighted by the pressure.

        p  pressure (nx, ny)
        s  gap before the approach (nx, ny) [length]: undeformed gap plus displacement
        """
        return float(np.vdot(p, s) / p.sum())

    def admissible(self, p: Field) -> Field:
        """Set negative pressures to zero and scale the sum of the pressure to the prescribed force.

        Raise NotConverged without any positive pressure.

        p  given pressure (nx, ny)
        """
        p = np.maximum(p, 0.0)
        carried = p.sum()
        if not carried > 0:
            raise NotConverged("the normal force", 0, np.inf, 0.0)
        return np.asarray(p * (self.total / carried))

    def projection(self, inside: Field) -> Projection:
        """Return a linear projection of pressure changes that keeps the sum Σp, the normal force.

        The projection restricts a change to the contact and subtracts its mean over the contact.
        Conjugate gradients on a contact set use it.

        inside  1 in contact, 0 elsewhere (nx, ny)
        """
        count = inside.sum()

        def projected(field: Field) -> Field:
            left = field - np.vdot(field, inside) / count
            left *= inside
            return left

        return projected

    def less(self, carried: Field) -> NormalLoad:
        """Return the normal force reduced by the sum of given cell pressures.

        The edge correction fixes the pressure of edge cells and solves for the other cells, which
        carry the reduced force.

        carried  fixed pressure of the edge cells, zero in other cells (nx, ny)
        """
        return PressureSum(self.total - float(np.sum(carried)))

    def free_motions(self, shape: tuple[int, ...]) -> tuple[Field, ...]:
        """Return the closure of the gap by a unit approach, a field (nx, ny) of ones.

        The field is the only entry of a tuple. The approach is free under a prescribed normal
        force.

        shape  number of cells (nx, ny)
        """
        return (np.ones(shape),)


@dataclass(frozen=True)
class FixedApproach(NormalLoad):
    """Displacement control of the normal problem: the approach of the bodies is prescribed.

    The normal force follows from the solution.

    approach  approach, counted from first contact [length]
    """

    approach: float

    def touches(self, gap: Field) -> bool:
        """Return True if the prescribed approach closes the undeformed gap of at least one cell.

        gap  undeformed gap (nx, ny) [length]; infinite where contact is impossible
        """
        return float(np.min(gap)) < self.approach

    def bearing_depth(self, gaps: Vector, stiffness: Vector) -> float:
        """Return half of the prescribed approach, the bearing depth of Hertz theory [length].

        In the initial guess of the pressure, cells whose undeformed gap is below this depth are in
        contact. The arguments have no effect.
        """
        return 0.5 * self.approach

    def motion(self, p: Field, s: Field) -> Motion:
        """Return the prescribed approach [length], which does not depend on pressure and gap."""
        return self.approach

    def admissible(self, p: Field) -> Field:
        """Set negative pressures of a field (nx, ny) to zero; no force is prescribed.

        p  given pressure (nx, ny)
        """
        return np.maximum(p, 0.0)

    def projection(self, inside: Field) -> Projection:
        """Return the projection that restricts pressure changes to the cells in contact.

        Under a prescribed approach there is no prescribed force that the projection must keep.

        inside  1 in contact, 0 elsewhere (nx, ny)
        """
        return lambda field: field * inside
