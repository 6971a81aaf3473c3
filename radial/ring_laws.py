"""The laws of one increment at points as equations, and where their linearisation leads."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from radial.ring_points import Points

Array = NDArray[np.float64]

LEAST_FRICTION = 1e-2  # of which the limit is more than round-off of the pressure
# Of rigid motions and what does work on them: T along and across, M about the axis, W.
ALONG, ACROSS, ABOUT, DOWN = range(4)
# Of loads that go on as in the last increment: what is round-off of them, how many times as far
# they go at most (more than twice, so that round-off does not decide about twice), and how much of
# it aside.
REST, FURTHEST, ASIDE = 1e-6, 2.1, 0.5
Led = tuple[float | None, ...]


@dataclass(frozen=True)
class Loads:
    """What an increment ends with, of every pair the one that is prescribed, the other None.

    forces   T along θ = 0 and across it, M about the axis, W [force, force length]
    motions  in the same order: shifts, twist, approach [length, radian]
    """

    forces: Led
    motions: Led

    @property
    def without_shear(self) -> Loads:
        """The same with what led T and M at zero."""
        beside = (None if force is None else 0.0 for force in self.forces[:DOWN])
        return Loads((*beside, self.forces[DOWN]), self.motions)


@dataclass(frozen=True)
class Held:
    """The state at the end of an increment. N points.

    tractions  q_r, q_θ, p (3 N,) [force/length²]
    moved      u_r, u_θ times area (2 N,) [length³]
    slipped    Δs of the increment times area (2 N,) [length³]
    motion     shifts along and across, twist, approach (4,) [length, radian]
    changed    by the increment, tractions and motion (3 N + 4,)
    share      of the limit: |q - Δs/d| over it, ≤ 1 where a point sticks, infinite out of contact
    energy     ½ ∫ (p u_z + q·u) dA [force length]
    missed     of the laws, over the largest pressure, limit and load
    steps      of Newton's method
    """

    tractions: Array
    moved: Array
    slipped: Array
    motion: Array
    changed: Array
    share: Array
    energy: float
    missed: float
    steps: int

    @property
    def pressure(self) -> Array:
        """p (N,)."""
        return self.tractions[2 * len(self.share) :]

    @property
    def shear(self) -> Array:
        """q_r and q_θ (2, N)."""
        return self.tractions[: 2 * len(self.share)].reshape(2, -1)

    @property
    def approach(self) -> float:
        """[length]."""
        return float(self.motion[DOWN])

    def forces(self, points: Points) -> Array:
        """T along and across, M and W that the tractions carry (4,)."""
        return _carried(points, self.tractions)

    def every_angle(self, points: Points) -> Held:
        """The same at points, of a state that is the same all around."""

        def parts(field: Array, count: int) -> Array:
            return points.every_angle(field.reshape(count, -1)).ravel()

        return replace(
            self,
            tractions=parts(self.tractions, 3),
            changed=np.append(parts(self.changed[:-4], 3), self.changed[-4:]),
            moved=parts(self.moved, 2) / points.count,
            slipped=parts(self.slipped, 2) / points.count,
            share=parts(self.share, 1),
        )


class At(NamedTuple):
    """Tractions and motion x; what is left of the laws; and what is projected."""

    x: Array
    missed: Array
    z: Array
    y: Array
    limit: Array
    u: Array
    worst: float


@dataclass(frozen=True)
class Laws:
    """The laws of an increment as equations.

    moved, motion  of the state before
    d              of every traction: what it moves where it acts [length^5/force]
    """

    points: Points
    friction: float
    loads: Loads
    moved: Array
    motion: Array
    d: Array

    @classmethod
    def of(cls, points: Points, friction: float, loads: Loads, before: Held | None) -> Laws:
        d = np.diagonal(points.compliance).reshape(3, -1)
        beside = (d[0] + d[1]) / 2
        moved, motion = np.zeros(2 * d.shape[1]), np.zeros(4)
        if before is not None:
            moved, motion = before.moved, before.motion
        d = np.concatenate([beside, beside, d[2]])
        return cls(points, friction, loads, moved, motion, d)

    def closed(self) -> Array:
        """Tractions and motion so deep that what a load may press is closed."""
        points, size, loads = self.points, len(self.points.areas), self.loads
        depth = points.bare / points.areas
        force, approach = loads.forces[DOWN], loads.motions[DOWN]
        if approach is not None:
            p = np.maximum(approach - depth, 0.0) / np.diag(points.compliance)[2 * size :]
            t = np.concatenate([np.zeros(2 * size), 0.1 * p * points.areas])
            return np.append(t, [0.0, 0.0, 0.0, approach])
        assert force is not None
        t = np.concatenate([np.zeros(2 * size), np.full(size, force / points.areas.sum())])
        open_by = (points.compliance @ t)[2 * size :] / points.areas + depth
        return np.append(t, [0.0, 0.0, 0.0, np.max(open_by)])

    def starts(self, before: Held) -> list[Array]:
        """Tractions and motion gone on from the state before as in its increment, where the loads
        do so, and those of that state."""
        leads = [force is not None for force in self.loads.forces]
        ends = zip(self.loads.forces, self.loads.motions, strict=True)
        led = np.array([motion if force is None else force for force, motion in ends], dtype=float)
        x = np.append(before.tractions, before.motion)
        now, last = (
            np.where(leads, _carried(self.points, of[:-4]), of[-4:]) for of in (x, before.changed)
        )
        further = led - now
        for way in (slice(ALONG, ABOUT), slice(ABOUT, DOWN), slice(DOWN, None)):
            size = max(np.linalg.norm(further[way]), np.linalg.norm(last[way]))
            rests = size <= REST * np.linalg.norm(led[way])
            further[way], last[way] = (0.0 if rests else of[way] / size for of in (further, last))
        if not np.any(last):
            return [x]
        share = float(further @ last) / float(last @ last)
        aside = np.linalg.norm(further - share * last)
        if not REST < share <= FURTHEST or aside > ASIDE * np.linalg.norm(further):
            return [x]
        return [x + share * before.changed, x]

    def at(self, x: Array, u: Array) -> At:
        """What is left of the laws.

        u  displacements times areas by the tractions of x
        """
        points, size, loads = self.points, len(self.points.areas), self.loads
        t, motion = x[:-4], x[-4:]
        q, p = t[: 2 * size], t[2 * size :]
        gap = u[2 * size :] + points.bare - motion[DOWN] * points.areas
        slipped = self.slipped(u, motion)
        z = p - gap / self.d[2 * size :]
        y = (q - slipped / self.d[: 2 * size]).reshape(2, -1)
        limit = self.friction * np.maximum(z, 0.0)
        missed = np.concatenate([q - (_shortened(y, limit) * y).ravel(), p - np.maximum(z, 0.0)])
        # Shear is to be as near to its limit as pressure to itself.
        beyond = np.max(np.abs(missed[: 2 * size])) / max(self.friction, LEAST_FRICTION)
        peak = np.max(np.abs(p))
        worst = max(beyond, np.max(np.abs(missed[2 * size :]))) / peak if peak > 0 else np.inf
        if not np.isfinite(worst):
            return At(x, missed, z, y, limit, u, np.inf)
        carried = _carried(points, t)
        most, depth = points.areas @ np.abs(p), abs(motion[DOWN])
        sizes = (most, most, points.levers @ np.abs(p), most)
        reaches = (depth, depth, depth / points.radii[-1], depth)
        for led, now, of in (
            (loads.forces, carried, sizes),
            (loads.motions, motion, reaches),
        ):
            for wanted, found, size_of in zip(led, now, of, strict=True):
                if wanted is not None:
                    worst = max(worst, abs(found - wanted) / size_of)
        return At(x, missed, z, y, limit, u, float(worst))

    def slipped(self, u: Array, motion: Array) -> Array:
        """Δs of the increment times area (2 N,) [length³]."""
        beside = motion[:DOWN] - self.motion[:DOWN]
        return u[: 2 * len(self.points.areas)] - self.moved - beside @ self.points.ways

    def next(self, at: At) -> Array | None:
        """Where the laws would hold if they went on as they are here; None where nowhere."""
        points, size = self.points, len(at.z)
        if self.loads.forces[DOWN] is not None and not np.any(at.z > 0):
            return None
        # No ring further out carries anything; of these K knows tractions by displacements.
        rings = int(np.max(np.flatnonzero(at.z > 0), initial=0)) // points.count + 1
        K, m = points.tractions(rings), rings * points.count
        inside, y, limit = at.z[:m] > 0, at.y[:, :m], at.limit[:m]
        length = np.hypot(*y)
        # Displacements that nothing holds: along w and across it where a point slips, anywhere
        # where it is open.
        free, apart = np.flatnonzero(~inside | (length > limit)), np.flatnonzero(~inside)
        n, slips = len(free), inside[free]
        safe = np.where(slips, length[free], 1.0)
        c, s = np.where(slips, y[:, free] / safe, [[1.0], [0.0]])
        share, friction = np.where(slips, [limit[free] / safe, np.full(n, self.friction)], 0.0)
        own = np.concatenate([free, m + free, 2 * m + apart])
        # Small rings beside large ones, in units in which they are alike.
        units = np.sqrt(self.d[np.concatenate([free, free, 2 * size + apart])])
        # All is told from here on, so that round-off goes with what is left of the way: tractions
        # and displacements here, what motion leads, and what displacements miss.
        t = np.zeros_like(at.x[:-4])
        t.reshape(3, size)[:, :m] = at.x[:-4].reshape(3, size)[:, :m]
        u = at.u if np.array_equal(t, at.x[:-4]) else points.compliance @ t
        t, u = t.reshape(3, size)[:, :m].ravel(), u.reshape(3, size)[:, :m].ravel()
        tied = points.ways.reshape(3, 2, size)[:, :, :m].reshape(3, -1)
        moved = self.moved.reshape(2, size)[:, :m].ravel() - self.motion[:DOWN] @ tied
        led = np.zeros((3 * m, 5))
        led[: 2 * m, :3], led[2 * m :, 3] = tied.T, points.areas[:m]
        missed = np.append(moved, -points.bare[:m]) + led[:, :4] @ at.x[-4:] - u
        led[:, 4] = missed
        led[own, 4] = 0.0
        carried = K @ led
        by_motion = led.T @ carried
        by_motion[4] += led.T @ t
        carried[:, 4] += t

        def turn(rows: Array, sense: float = 1.0) -> None:
            """From outward and around the axis to along w and across it; -1: back."""
            outward, around = rows[:n].copy(), rows[n : 2 * n].copy()
            rows[:n] = c[:, None] * outward + sense * s[:, None] * around
            rows[n : 2 * n] = c[:, None] * around - sense * s[:, None] * outward

        # K is symmetric: of everything unknown, tractions where displacements are free.
        every = np.concatenate([own[: 2 * n], 2 * m + free])
        by = np.concatenate([K[np.ix_(own, every)], carried[every].T])
        turn(by)
        by[: len(own)] *= units[:, None]
        by = np.ascontiguousarray(by.T)
        turn(by)
        # Rows: µp along w, across it what the law leaves, nothing of what is open; loads.
        by[:n] -= friction[:, None] * by[2 * n :]
        by[n : 2 * n] *= (1 - share)[:, None]
        rows = np.concatenate([by[: 2 * n], by[2 * n :][~slips]]) * units[:, None]
        across = np.arange(n, 2 * n)
        rows[across, across] += share
        slipped = -missed[own[: 2 * n], None]
        turn(slipped)
        rows[across, -1] += share * slipped[n:, 0] / units[across]
        loads = np.concatenate([carried[own], by_motion]).T[:4]
        turn(loads.T)
        loads[:, : len(own)] *= units
        ends = zip(self.loads.forces, self.loads.motions, strict=True)
        for i, (force, motion) in enumerate(ends):
            # Of what a load leads the row is its equilibrium, else its motion.
            if force is None:
                loads[i], loads[i, i - 5], loads[i, -1] = 0.0, -1.0, motion
                loads[i, -1] -= at.x[i - 4]
            else:
                loads[i, -1] -= force
        whole = np.concatenate([rows, loads])
        LU, places, failed = lapack.dgetrf(whole[:, :-1].T)
        if failed:
            return None
        found = lapack.dgetrs(LU, places, -whole[:, -1], trans=1)[0]
        if not np.all(np.isfinite(found)):
            return None
        further = (found[:-4] * units)[:, None]
        turn(further, -1.0)
        u = led @ np.append(found[-4:], 1.0)
        u[own] += further[:, 0]
        t = (t + K @ u).reshape(3, m)
        t[:, ~inside] = 0.0
        x = np.append(np.zeros(3 * size), at.x[-4:] + found[-4:])
        x[:-4].reshape(3, size)[:, :m] = t
        return x


def _carried(points: Points, tractions: Array) -> Array:
    """T along and across, M and W (4,)."""
    q, p = np.split(tractions, [2 * len(points.areas)])
    return np.append(points.ways @ q, points.areas @ p)


def _shortened(y: Array, limit: Array) -> Array:
    """By what vectors (2, …) are multiplied to be no longer than the limit."""
    length = np.hypot(*y)
    longer = length > limit
    return np.where(longer, limit / np.where(longer, length, 1.0), 1.0)
