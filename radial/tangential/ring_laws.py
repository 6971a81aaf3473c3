"""Contact and friction laws of one increment at points, as a nonsmooth system of equations.

`ring_friction` solves the system.
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
    """Iterate of Newton's method, with the terms of the contact and friction laws. N points.

    x         tractions q_r, q_θ, p and rigid motion (3 N + 4,)
    residual  error of the laws (3 N,) [force/length²]
    z         trial pressure p - g/d with the gap g and the compliance d of the point (N,)
    y         trial shear q - Δs/d with the slip Δs of the increment (2, N)
    limit     friction limit of the trial pressure (N,)
    u         displacements by the tractions, times areas of the points (3 N,) [length³]
    worst     largest dimensionless residual of laws, loads and motions
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

    points    points of the contact and their compliance
    friction  friction law
    loads     prescribed loads and motions at the end
    moved     tangential displacements times areas at the start of the increment (2 N,) [length³]
    motion    rigid motion at the start of the increment (4,)
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
    ) -> ContactLaws:
        """Create the equations of contact and friction of one increment.

        points    points of the contact and their compliance
        friction  friction law
        loads     prescribed loads and motions at the end
        before    state at the start of the increment; None before first contact
        """
        if before is None:
            return cls(points, friction, loads, np.zeros(2 * len(points.areas)), np.zeros(4))
        return cls(points, friction, loads, before.moved, before.motion)

    def guess_closed_gap(self) -> Array:
        """Return an initial guess of tractions and rigid motion for the first contact (3 N + 4,).

        The approach closes the gap at all points where the load may cause contact. Under a
        prescribed force the pressure is uniform.
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
        """Return initial guesses: the extrapolated last increment, then the state at the start.

        The last increment is extrapolated only if the loads continue in its direction.

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
        """Evaluate the contact and friction laws and their residuals at a Newton iterate.

        x  tractions q_r, q_θ, p and rigid motion (3 N + 4,)
        u  displacements by these tractions, times areas of the points (3 N,) [length³]
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
        """Return the slip of the increment at all points, times their areas (2 N,) [length³].

        It is the change of the tangential surface displacement minus that of the rigid motion.

        u       displacements times areas at the end (3 N,) [length³]
        motion  rigid motion at the end (4,)
        """
        tangential = motion[:NORMAL] - self.motion[:NORMAL]
        return u[: 2 * len(self.points.areas)] - self.moved - tangential @ self.points.rigid_motions


def _reduction_factors(y: Array, limit: Array) -> Array:
    """Return factors that reduce trial shear vectors to the friction limit (…).

    A factor is 1 for a vector below the limit, otherwise the limit over the length of the vector.

    y      trial shear vectors (2, …) [force/length²]
    limit  friction limit (…) [force/length²]
    """
    length = np.hypot(*y)
    longer = length > limit
    return np.where(longer, limit / np.where(longer, length, 1.0), 1.0)
