"""Pressure and shear of one increment under Coulomb's law at points (r, θ), pushed along one line.

The law holds in the mean over the hat of every node,

    p = max(p - g/d, 0),    q = P(q - Δs/d),

with P the nearest vector no longer than µ max(p - g/d, 0); its zero is found by Newton's method,
for one in which all that is projected is projected as it is now (Alart and Curnier 1991). Of its
equations those remain that nobody can do without: no traction where there is a gap, and where a
point slips along w, w·q = µp, so that q across w is left.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from contact_scene.solver_errors import ContactAtZoneEdge, GrossSliding, NotConverged
from radial.ring_points import Points

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

MOST_STEPS = 60
SHORTEST = 2.0**-6  # of a step of Newton's method


@dataclass(frozen=True)
class Loads:
    """What an increment ends with, of either pair the one that is prescribed: W or the approach,
    T or the shift [force, length]."""

    force: float | None
    approach: float | None
    drag: float | None
    shift: float | None


@dataclass(frozen=True)
class Held:
    """The state at the end of an increment.

    tractions  q_r, q_θ, p (3 n J,) [force/length²]
    moved      u_r, u_θ times area (2 n J,) [length³]
    slipped    Δs of the increment times area (2 n J,) [length³]
    share      of the limit: |q - Δs/d| over it, ≤ 1 where a point sticks, infinite out of contact
    energy     ½ ∫ (p u_z + q·u) dA [force length]
    missed     of the laws, over the largest pressure and the load
    steps      of Newton's method
    """

    tractions: Array
    moved: Array
    slipped: Array
    shift: float
    approach: float
    share: Array
    energy: float
    missed: float
    steps: int

    @property
    def pressure(self) -> Array:
        """p (n J,)."""
        return self.tractions[2 * len(self.share) :]

    @property
    def shear(self) -> Array:
        """q_r and q_θ (2, n J)."""
        return self.tractions[: 2 * len(self.share)].reshape(2, -1)

    def every_angle(self, points: Points) -> Held:
        """The same at points, of a state that is the same all around."""

        def parts(field: Array, count: int) -> Array:
            return points.every_angle(field.reshape(count, -1)).ravel()

        return Held(
            parts(self.tractions, 3), parts(self.moved, 2) / points.count,
            parts(self.slipped, 2) / points.count, self.shift, self.approach,
            parts(self.share, 1), self.energy, self.missed, self.steps,
        )  # fmt: skip


def held(
    points: Points, friction: float, loads: Loads, before: Held | None, tolerance: float
) -> Held:
    """The state under loads.

    before  the state from which surfaces slip; None: they have not touched
    raises  NotConverged; GrossSliding from T = µW on; ContactAtZoneEdge at the last ring
    """
    if loads.drag and loads.force is not None and abs(loads.drag) >= friction * loads.force:
        raise _slides(loads.drag, friction * loads.force)
    laws = _Laws.of(points, friction, loads, before)
    x = laws.closed() if before is None else np.append(before.tractions, laws.motion)
    at = laws.at(x)
    for step in range(MOST_STEPS):
        if at.worst <= tolerance:
            return _ended(laws, at, step)
        aim = laws.next(at)
        if aim is None:
            break
        size = np.linalg.norm(at.missed)
        length, tried = 1.0, laws.at(aim)
        while (
            tried.worst >= at.worst and np.linalg.norm(tried.missed) >= size and length > SHORTEST
        ):
            length /= 2
            tried = laws.at(at.x + length * (aim - at.x))
        at = tried
    raise NotConverged("contact and friction on rings", MOST_STEPS, at.worst, tolerance)


def _slides(drag: float, carried: float) -> GrossSliding:
    return GrossSliding(f"T = {drag:g} N is not below µW = {carried:g} N: the indenter slides")


def _ended(laws: _Laws, at: _At, steps: int) -> Held:
    points, size = laws.points, len(at.z)
    if np.any(at.limit.reshape(-1, points.count)[-1] > 0):
        raise ContactAtZoneEdge("the contact reaches the last ring; lay rings further out")
    inside = at.z > 0
    length = np.hypot(*at.y)
    share = np.where(inside, length / np.where(inside, at.limit, 1.0), np.inf)
    if laws.friction == 0:
        share = np.where(inside, 1.0, np.inf)
    t, (shift, approach) = at.x[:-2], at.x[-2:]
    slipped = at.u[: 2 * size] - laws.moved - (shift - laws.motion[0]) * points.along
    return Held(
        t, at.u[: 2 * size], slipped, float(shift), float(approach), share,
        0.5 * float(t @ at.u), at.worst, steps,
    )  # fmt: skip


class _At(NamedTuple):
    """Tractions, shift and approach x; what is left of the laws; and what is projected."""

    x: Array
    missed: Array
    z: Array
    y: Array
    limit: Array
    u: Array
    worst: float


@dataclass(frozen=True)
class _Laws:
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
    def of(cls, points: Points, friction: float, loads: Loads, before: Held | None) -> _Laws:
        d = np.diagonal(points.compliance).reshape(3, -1)
        beside = (d[0] + d[1]) / 2
        moved, motion = np.zeros(2 * d.shape[1]), np.zeros(2)
        if before is not None:
            moved, motion = before.moved, np.array([before.shift, before.approach])
        d = np.concatenate([beside, beside, d[2]])
        return cls(points, friction, loads, moved, motion, d)

    def closed(self) -> Array:
        """Tractions and motion so deep that what a load may press is closed."""
        points, size, loads = self.points, len(self.points.areas), self.loads
        depth = points.bare / points.areas
        if loads.approach is not None:
            p = np.maximum(loads.approach - depth, 0.0) / np.diag(points.compliance)[2 * size :]
            t = np.concatenate([np.zeros(2 * size), 0.1 * p * points.areas])
            return np.append(t, [0.0, loads.approach])
        assert loads.force is not None
        t = np.concatenate([np.zeros(2 * size), np.full(size, loads.force / points.areas.sum())])
        open_by = (points.compliance @ t)[2 * size :] / points.areas + depth
        return np.append(t, [0.0, np.max(open_by)])

    def at(self, x: Array) -> _At:
        points, size, loads = self.points, len(self.points.areas), self.loads
        t, (shift, approach) = x[:-2], x[-2:]
        u = points.compliance @ t
        q, p = t[: 2 * size], t[2 * size :]
        gap = u[2 * size :] + points.bare - approach * points.areas
        slipped = u[: 2 * size] - self.moved - (shift - self.motion[0]) * points.along
        z = p - gap / self.d[2 * size :]
        y = (q - slipped / self.d[: 2 * size]).reshape(2, -1)
        limit = self.friction * np.maximum(z, 0.0)
        missed = np.concatenate([q - (_shortened(y, limit) * y).ravel(), p - np.maximum(z, 0.0)])
        worst = np.max(np.abs(missed)) / np.max(np.abs(p))
        for now, wanted, size_of in (
            (points.areas @ p, loads.force, loads.force),
            (approach, loads.approach, loads.approach),
            (points.along @ q, loads.drag, points.areas @ np.abs(p)),
            (shift, loads.shift, abs(approach)),
        ):
            if wanted is not None:
                assert size_of is not None
                worst = max(worst, abs(now - wanted) / size_of)
        return _At(x, missed, z, y, limit, u, float(worst))

    def next(self, at: _At) -> Array | None:
        """Where the laws would hold if they went on as they are here; None where nowhere."""
        points, size, loads = self.points, len(at.z), self.loads
        inside = np.flatnonzero(at.z > 0)
        n, length = len(inside), np.hypot(*at.y)[inside]
        limit = at.limit[inside]
        slips = length > limit
        stuck, slid = np.flatnonzero(~slips), np.flatnonzero(slips)
        safe = np.where(length > 0, length, 1.0)
        w = at.y[:, inside] / safe
        every = np.concatenate([inside, size + inside, 2 * size + inside])
        # Rows and columns: q_r and q_θ of what sticks, q across w of what slips, p.
        A = points.compliance[np.ix_(every, every)]
        r, s = slid, n + slid
        side = -A[:, r] * w[1, slid] + A[:, s] * w[0, slid]
        driven = A[:, 2 * n :]
        driven[:, slid] += self.friction * (A[:, r] * w[0, slid] + A[:, s] * w[1, slid])
        columns = np.hstack([A[:, stuck], A[:, n + stuck], side, driven])
        motion = np.zeros((3 * n, 2))
        motion[: 2 * n, 0] = -points.along[every[: 2 * n]]
        motion[2 * n :, 1] = -points.areas[inside]
        wanted = np.concatenate([
            (self.moved - self.motion[0] * points.along)[every[: 2 * n]], -points.bare[inside],
        ])  # fmt: skip
        whole = np.hstack([columns, motion, wanted[:, None]])
        across = -whole[r] * w[1, slid, None] + whole[s] * w[0, slid, None]
        whole = np.vstack([whole[stuck], whole[n + stuck], across, whole[2 * n :]])
        a = len(stuck)
        own = 2 * a + np.arange(len(slid))
        share = limit[slid] / length[slid]
        d = self.d[inside[slid]]
        if np.any(share <= 0):
            return None
        whole[own, own] += d * (1 - share) / share
        ends = np.zeros((2, whole.shape[1]))
        ways = points.along[every[: 2 * n]].reshape(2, n)
        if loads.drag is None:
            ends[0, -3], ends[0, -1] = 1.0, loads.shift
        else:
            ends[0, :a], ends[0, a : 2 * a] = ways[:, stuck]
            ends[0, own] = -ways[0, slid] * w[1, slid] + ways[1, slid] * w[0, slid]
            by_limit = self.friction * np.sum(ways[:, slid] * w[:, slid], axis=0)
            ends[0, 2 * a + len(slid) + slid] = by_limit
            ends[0, -1] = loads.drag
        if loads.force is None:
            ends[1, -2], ends[1, -1] = 1.0, loads.approach
        else:
            ends[1, 2 * a + len(slid) : -3] = points.areas[inside]
            ends[1, -1] = loads.force
        whole = np.vstack([whole, ends])
        # Small rings beside large ones, in units in which they are alike.
        units = np.ones(len(whole))
        units[:-2] = 1 / np.sqrt(
            np.concatenate([self.d[inside[stuck]]] * 2 + [d, self.d[2 * size + inside]])
        )
        whole[:, :-1] *= units
        whole[:-2] *= units[:-2, None]
        LU, places, found, failed = lapack.dgesv(whole[:, :-1], whole[:, -1])
        if not failed:
            found = found + lapack.dgetrs(LU, places, whole[:, -1] - whole[:, :-1] @ found)[0]
        found = found * units
        if failed or not np.all(np.isfinite(found)):
            return None
        x = np.zeros_like(at.x)
        p = found[2 * a + len(slid) : -2]
        q = np.zeros((2, n))
        q[:, stuck] = found[:a], found[a : 2 * a]
        v, most = found[own], self.friction * p[slid]
        q[:, slid] = most * w[:, slid] + v * np.stack([-w[1, slid], w[0, slid]])
        x[every] = np.concatenate([*q, p])
        x[-2:] = found[-2:]
        return x


def _shortened(y: Array, limit: Array) -> Array:
    """By what vectors (2, …) are multiplied to be no longer than the limit."""
    length = np.hypot(*y)
    longer = length > limit
    return np.where(longer, limit / np.where(longer, length, 1.0), 1.0)
