"""Contact problem of one increment at points on rings, solved by `contact_solver`.

Points represent different areas, see `contact_solver.unequal_areas`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene import CoulombFriction
from contact_scene.array_types import Array
from contact_solver.coupled_problem import CoupledProblem, CoupledSolution
from contact_solver.dense_inverse import DenseInverse
from contact_solver.rigid_motion import RigidMotion
from radial.tangential.ring_points import ContactPoints
from radial.tangential.ring_state import (
    ALONG,
    NORMAL,
    TORSION,
    Loads,
    PointState,
    resultant_loads,
)
from radial.tangential.stiffness_inverse import StiffnessInverse

# Predictor from the last increment. REST: relative change of the loads that is round-off. FURTHEST:
# largest ratio of this increment to the last one (above 2, so that round-off does not decide at 2).
# ASIDE: largest relative deviation from the direction of the last increment.
REST = 1e-6
FURTHEST = 2.1
ASIDE = 0.5


@dataclass(frozen=True)
class RingProblem:
    """Contact problem of one increment at N points on rings, with its loads.

    points    points of the contact (rings × angles) and their compliance
    friction  friction law
    loads     prescribed loads and rigid motions of the indenter at the end of the increment
    moved     displacements u_r, u_θ times areas at the start of the increment, plus the free motion
              of points until their contact (2 N,) [length³]
    motion    rigid motion at the start of the increment: shifts along θ = 0 and across it, twist,
              approach (4,) [length, radian]
    """

    points: ContactPoints
    friction: CoulombFriction
    loads: Loads
    moved: Array
    motion: Array

    @classmethod
    def of(
        cls,
        points: ContactPoints,
        friction: CoulombFriction,
        loads: Loads,
        before: PointState | None,
        free: Array | None = None,
    ) -> RingProblem:
        """Create the contact problem of one increment at points on rings.

        points    points of the contact (rings × angles) and their compliance
        friction  friction law
        loads     prescribed loads and rigid motions of the indenter at the end of the increment
        before    state at the start of the increment; None before first contact
        free      free motion of points until their contact, times areas (2 N,); None without
        """
        moved = np.zeros(2 * len(points.areas)) if free is None else free
        if before is None:
            return cls(points, friction, loads, moved, np.zeros(4))
        return cls(points, friction, loads, before.moved + moved, before.motion)

    @cached_property
    def units(self) -> Array:
        """Displacement of the last ring by the unit shifts, twist and approach (4,)."""
        return np.array([1.0, 1.0, self.points.radii[-1], 1.0])

    @cached_property
    def moving(self) -> list[int]:
        """Numbers of the tangential motions that symmetry does not exclude."""
        return [k for k, one in enumerate(self.points.rigid_motions) if np.any(one)]

    @cached_property
    def coupled(self) -> CoupledProblem:
        """The problem of pressure and shear for points of equal area."""
        points, loads, n = self.points, self.loads, len(self.points.areas)
        compliance = points.equal_compliance
        shapes = points.rigid_motions.reshape(3, 2, n) / points.areas
        target = self.moved.reshape(2, n) / points.areas
        target = target - np.tensordot(self.motion[:NORMAL], shapes, axes=1)

        def rigid(number: int, shape: Array) -> RigidMotion:
            return points.scale.rigid_motion(
                shape, self.units[number], loads.forces[number], loads.motions[number]
            )

        return points.scale.problem(
            product=compliance,
            inverse=StiffnessInverse(compliance, points.stiffness, points.count),
            dense=lambda: DenseInverse(compliance.matrix),
            own=compliance.diagonal[: 2 * n],
            gap=points.gap_areas / points.areas,
            friction_limit=self.friction.limit,
            friction_slope=self.friction.slope,
            target=target,
            closing=rigid(NORMAL, np.ones((1, n))),
            shifting=tuple(rigid(k, shapes[k]) for k in self.moving),
        )

    def start(self, x: Array) -> tuple[Array, Array, Array]:
        """Convert tractions and rigid motion to initial guesses of the solver.

        x  tractions q_r, q_θ, p and rigid motion (3 N + 4,)
        """
        t = self.points.scale.roots * np.reshape(x[:-4], (3, -1))
        return t[2], t[:2], (x[-4:] * self.units)[self.moving]

    def reached(self, found: CoupledSolution) -> Array:
        """Convert a solution to tractions q_r, q_θ, p and rigid motion (3 N + 4,).

        found  solution for points of equal area
        """
        motion = np.array([value or 0.0 for value in self.loads.motions])
        motion[self.moving] = found.motion / self.units[self.moving]
        motion[NORMAL] = found.closing[0]
        t = np.concatenate([found.shear, found.pressure[None]]) / self.points.scale.roots
        return np.append(t, motion)

    def slip_increment(self, u: Array, motion: Array) -> Array:
        """Return the slip of the increment at all N points, times their areas (2 N,) [length³].

        The slip is the change of the tangential surface displacement (components r, θ) minus the
        change of the rigid shift and twist, and minus the free motion.

        u       displacements r, θ, z times areas at the end of the increment (3 N,) [length³]
        motion  rigid motion at the end: shifts along θ = 0 and across it, twist, approach (4,)
        """
        tangential = motion[:NORMAL] - self.motion[:NORMAL]
        return u[: 2 * len(self.points.areas)] - self.moved - tangential @ self.points.rigid_motions

    def guess_closed_gap(self) -> Array:
        """Return an initial guess of tractions and rigid motion for the first contact (3 N + 4,).

        The shear is zero. Under a prescribed normal force the pressure is uniform, and the approach
        closes the gap at all N points. Under a prescribed approach the pressure of a point is
        proportional to the overlap of the undeformed surfaces at the point, divided by its
        compliance.
        """
        points, size, loads = self.points, len(self.points.areas), self.loads
        approach, p = loads.motions[NORMAL], np.ones(size)
        if approach is not None:
            overlap = np.maximum(approach - points.gap_areas / points.areas, 0.0)
            p = 0.1 * overlap * points.areas / points.operator.diagonal[2 * size :]
        return np.concatenate([np.zeros(2 * size), p, np.zeros(NORMAL), [approach or 0.0]])

    def initial_guesses(self, before: PointState) -> list[Array]:
        """Return initial guesses of tractions and rigid motion for Newton's method, best first.

        The first guess is the linear extrapolation of the last increment. It is omitted if the
        loads do not continue in the direction of that increment. The last guess is the state at the
        start of this increment. Each guess has the shape (3 N + 4,) for N points.

        before  state at the start of the increment
        """
        leads = [force is not None for force in self.loads.forces]
        ends = zip(self.loads.forces, self.loads.motions, strict=True)
        prescribed = np.array(
            [motion if force is None else force for force, motion in ends], dtype=float
        )
        x = np.append(before.tractions, before.motion)
        now, last = (
            np.where(leads, resultant_loads(self.points, of[:-4]), of[-4:])
            for of in (x, before.changed)
        )
        further = prescribed - now
        for group in (slice(ALONG, TORSION), slice(TORSION, NORMAL), slice(NORMAL, None)):
            size = max(np.linalg.norm(further[group]), np.linalg.norm(last[group]))
            rests = size <= REST * np.linalg.norm(prescribed[group])
            further[group], last[group] = (
                0.0 if rests else of[group] / size for of in (further, last)
            )
        if not np.any(last):
            return [x]
        share = float(further @ last) / float(last @ last)
        aside = np.linalg.norm(further - share * last)
        if not REST < share <= FURTHEST or aside > ASIDE * np.linalg.norm(further):
            return [x]
        return [x + share * before.changed, x]
