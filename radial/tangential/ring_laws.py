"""Contact and friction laws of one increment at points, as a nonsmooth system of equations.

The unknowns are the tractions of all points and the rigid motion of the indenter. The module
`ring_friction` solves the system by Newton's method.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from contact_scene import CoulombFriction
from contact_scene.array_types import Array
from radial.tangential.ring_points import ContactPoints
from radial.tangential.ring_state import (
    ALONG,
    NORMAL,
    TORSION,
    Loads,
    PointState,
    resultant_loads,
)

# Least µ in the relative error of the shear. With less friction the limit µp is round-off of p.
LEAST_FRICTION = 1e-4
# Predictor from the last increment. REST: relative change of the loads that is round-off. FURTHEST:
# largest ratio of this increment to the last one (above 2, so that round-off does not decide at 2).
# ASIDE: largest relative deviation from the direction of the last increment.
REST, FURTHEST, ASIDE = 1e-6, 2.1, 0.5


class NewtonIterate(NamedTuple):
    """Iterate of Newton's method for contact with friction at N points on rings, with its residual.

    The laws are p = max(z, 0) and q = y reduced to the friction limit of max(z, 0), with the trial
    pressure z and the trial shear y.

    x         radial shear, circumferential shear and pressure (q_r, q_θ, p) of the points
              [force/length²], then the rigid motion: shifts along θ = 0 and across it, twist,
              approach (3 N + 4,)
    residual  errors of the contact and friction laws (3 N,) [force/length²]
    z         trial pressure p - g/d with the gap g and the compliance d of the point (N,)
              [force/length²]
    y         trial shear q - Δs/d with the slip Δs of the increment (2, N) [force/length²]
    limit     friction limit of the trial pressure (N,) [force/length²]
    u         displacements r, θ, z by the tractions, times the areas of the points (3 N,) [length³]
    worst     largest dimensionless residual of laws, loads and motions [1]
    """

    x: Array
    residual: Array
    z: Array
    y: Array
    limit: Array
    u: Array
    worst: float


@dataclass(frozen=True)
class ContactLaws:
    """Contact and friction laws of an increment, as equations for tractions and rigid motion.

    The equations hold at N points on rings. Newton's method evaluates their residual.

    points    points of the contact (rings × angles) and their compliance matrix
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
    ) -> ContactLaws:
        """Create the equations of contact and friction of one increment at points on rings.

        points    points of the contact (rings × angles) and their compliance matrix
        friction  friction law
        loads     prescribed loads and rigid motions of the indenter at the end of the increment
        before    state at the start of the increment; None before first contact
        free      free motion of points until their contact, times areas (2 N,); None without
        """
        moved = np.zeros(2 * len(points.areas)) if free is None else free
        if before is None:
            return cls(points, friction, loads, moved, np.zeros(4))
        return cls(points, friction, loads, before.moved + moved, before.motion)

    def guess_closed_gap(self) -> Array:
        """Return an initial guess of tractions and rigid motion for the first contact (3 N + 4,).

        The shear is zero. Under a prescribed normal force the pressure is uniform, and the approach
        closes the gap at all N points. Under a prescribed approach the pressure of a point is
        proportional to the overlap of the undeformed surfaces at the point, divided by its
        compliance.
        """
        points, size, loads = self.points, len(self.points.areas), self.loads
        depth = points.gap_areas / points.areas
        force, approach = loads.forces[NORMAL], loads.motions[NORMAL]
        if approach is not None:
            p = np.maximum(approach - depth, 0.0) / np.diag(points.compliance)[2 * size :]
            t = np.concatenate([np.zeros(2 * size), 0.1 * p * points.areas])
            return np.append(t, [0.0, 0.0, 0.0, approach])
        assert force is not None
        t = np.concatenate([np.zeros(2 * size), np.full(size, force / points.areas.sum())])
        open_by = (points.compliance @ t)[2 * size :] / points.areas + depth
        return np.append(t, [0.0, 0.0, 0.0, np.max(open_by)])

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

    def evaluate(self, x: Array, u: Array) -> NewtonIterate:
        """Evaluate the contact and friction laws and their residuals at given tractions.

        x  tractions q_r, q_θ, p of the N points and rigid motion of the indenter (3 N + 4,)
        u  displacements r, θ, z by these tractions, times the areas of the points (3 N,) [length³]
        """
        points, size, loads = self.points, len(self.points.areas), self.loads
        t, motion = x[:-4], x[-4:]
        q, p = t[: 2 * size], t[2 * size :]
        gap = u[2 * size :] + points.gap_areas - motion[NORMAL] * points.areas
        slip_increment = self.slip_increment(u, motion)
        z = p - gap / points.diagonal_compliance[2 * size :]
        y = (q - slip_increment / points.diagonal_compliance[: 2 * size]).reshape(2, -1)
        limit = self.friction.limit(np.maximum(z, 0.0))
        residual = np.concatenate(
            [q - (_reduction_factors(y, limit) * y).ravel(), p - np.maximum(z, 0.0)]
        )
        # The error of the shear is relative to the friction limit, that of the pressure to the
        # pressure.
        beyond = np.max(np.abs(residual[: 2 * size])) / max(self.friction.largest, LEAST_FRICTION)
        peak = np.max(np.abs(p))
        worst = max(beyond, np.max(np.abs(residual[2 * size :]))) / peak if peak > 0 else np.inf
        if not np.isfinite(worst):
            return NewtonIterate(x, residual, z, y, limit, u, np.inf)
        forces = resultant_loads(points, t)
        most, depth = points.areas @ np.abs(p), abs(motion[NORMAL])
        sizes = (most, most, points.levers @ np.abs(p), most)
        reaches = (depth, depth, depth / points.radii[-1], depth)
        for prescribed, now, of in (
            (loads.forces, forces, sizes),
            (loads.motions, motion, reaches),
        ):
            for wanted, found, size_of in zip(prescribed, now, of, strict=True):
                if wanted is not None:
                    worst = max(worst, abs(found - wanted) / size_of)
        return NewtonIterate(x, residual, z, y, limit, u, float(worst))

    def slip_increment(self, u: Array, motion: Array) -> Array:
        """Return the slip of the increment at all N points, times their areas (2 N,) [length³].

        The slip is the change of the tangential surface displacement (components r, θ) minus the
        change of the rigid shift and twist, and minus the free motion.

        u       displacements r, θ, z times areas at the end of the increment (3 N,) [length³]
        motion  rigid motion at the end: shifts along θ = 0 and across it, twist, approach (4,)
        """
        tangential = motion[:NORMAL] - self.motion[:NORMAL]
        return u[: 2 * len(self.points.areas)] - self.moved - tangential @ self.points.rigid_motions


def _reduction_factors(y: Array, limit: Array) -> Array:
    """Return the factors that reduce trial shear vectors to the friction limit (…) [1].

    A factor is 1 for a vector below the friction limit. For a longer vector the factor is the
    friction limit over the length of the vector.

    y      trial shear vectors of points, two components on the first axis (2, …) [force/length²]
    limit  friction limit µp of the points (…) [force/length²]
    """
    length = np.hypot(*y)
    longer = length > limit
    return np.where(longer, limit / np.where(longer, length, 1.0), 1.0)
