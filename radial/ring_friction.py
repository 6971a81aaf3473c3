"""Pressure and shear of one increment under Coulomb's law at points (r, θ), pushed along one line.

The law holds in the mean over the hat of every node,

    p = max(p - g/d, 0),    q = P(q - Δs/d),

with P the nearest vector no longer than µ max(p - g/d, 0); its zero is found by Newton's method,
for one in which all that is projected is projected as it is now (Alart and Curnier 1991). Of its
equations those remain that nobody can do without: no traction where there is a gap, and where a
point slips along w, w·q = µp, so that q across w is left.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
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
LEAST_FRICTION = 1e-2  # of which the limit is more than round-off of the pressure
AT_ONCE = 12  # steps that are taken whole: what slips is found sooner than by shorter ones


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
    missed     of the laws, over the largest pressure, limit and load
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
    raises  NotConverged; GrossSliding from T = µW on, where the approach is led of the W without T;
            ContactAtZoneEdge at the last ring
    """
    if loads.drag and loads.force is not None and abs(loads.drag) >= friction * loads.force:
        raise _slides(loads.drag, friction * loads.force)
    laws = _Laws.of(points, friction, loads, before)
    x = laws.closed() if before is None else np.append(before.tractions, laws.motion)
    at = laws.at(x, points.compliance @ x[:-2])
    for step in range(MOST_STEPS):
        if at.worst <= tolerance:
            return _ended(laws, at, step)
        # Where nothing carries the force steps grow without end, until a number is none.
        with np.errstate(over="ignore", invalid="ignore"):
            aim = laws.next(at)
            if aim is None:
                break
            at = _nearer(laws, at, aim, SHORTEST if step >= AT_ONCE else 1.0)
    if loads.drag and loads.force is None:
        pressed = held(points, friction, replace(loads, drag=0.0), before, tolerance)
        carried = friction * float(points.areas @ pressed.pressure)
        if abs(loads.drag) >= carried:
            raise _slides(loads.drag, carried)
    raise NotConverged("contact and friction on rings", MOST_STEPS, at.worst, tolerance)


def _nearer(laws: _Laws, at: _At, aim: Array, shortest: float) -> _At:
    """At the aim, or on the way to it, where less is left."""
    moved = laws.points.compliance @ aim[:-2]
    size, length = np.linalg.norm(at.missed), 1.0
    tried = laws.at(aim, moved)
    while tried.worst >= at.worst and np.linalg.norm(tried.missed) >= size and length > shortest:
        length /= 2
        tried = laws.at(at.x + length * (aim - at.x), at.u + length * (moved - at.u))
    return tried


def _slides(drag: float, carried: float) -> GrossSliding:
    return GrossSliding(f"T = {abs(drag):g} N is not below µW = {carried:g} N: the indenter slides")


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

    def at(self, x: Array, u: Array) -> _At:
        """What is left of the laws.

        u  displacements times areas by the tractions of x
        """
        points, size, loads = self.points, len(self.points.areas), self.loads
        t, (shift, approach) = x[:-2], x[-2:]
        q, p = t[: 2 * size], t[2 * size :]
        gap = u[2 * size :] + points.bare - approach * points.areas
        slipped = u[: 2 * size] - self.moved - (shift - self.motion[0]) * points.along
        z = p - gap / self.d[2 * size :]
        y = (q - slipped / self.d[: 2 * size]).reshape(2, -1)
        limit = self.friction * np.maximum(z, 0.0)
        missed = np.concatenate([q - (_shortened(y, limit) * y).ravel(), p - np.maximum(z, 0.0)])
        # Shear is to be as near to its limit as pressure to itself.
        beyond = np.max(np.abs(missed[: 2 * size])) / max(self.friction, LEAST_FRICTION)
        peak = np.max(np.abs(p))
        worst = max(beyond, np.max(np.abs(missed[2 * size :]))) / peak if peak > 0 else np.inf
        if not np.isfinite(worst):
            return _At(x, missed, z, y, limit, u, np.inf)
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
        # Columns, and rows alike: q_r and q_θ of what sticks, q across w of what slips, p; motion.
        a, r, s = len(stuck), slid, n + slid
        held, side, press = slice(0, 2 * a), slice(2 * a, 2 * a + len(slid)), 2 * a + len(slid)
        share = limit[slid] / length[slid]
        if np.any(share <= 0):
            return None
        A = points.compliance[np.ix_(every, every)]
        columns = np.zeros((3 * n, press + n + 2))
        columns[:, :a], columns[:, a : 2 * a] = A[:, stuck], A[:, n + stuck]
        columns[:, side] = A[:, s] * w[0, slid] - A[:, r] * w[1, slid]
        columns[:, press:-2] = A[:, 2 * n :]
        along = A[:, r] * w[0, slid] + A[:, s] * w[1, slid]
        columns[:, press + slid] += self.friction * along
        columns[: 2 * n, -2] = -points.along[every[: 2 * n]]
        columns[2 * n :, -1] = -points.areas[inside]
        known = np.concatenate([
            (self.moved - self.motion[0] * points.along)[every[: 2 * n]], -points.bare[inside],
        ])  # fmt: skip

        def rows(field: Array, found: Array) -> None:
            across = slid_ways if field.ndim > 1 else slid_ways[:, :, 0]
            found[:a], found[a : 2 * a] = field[stuck], field[n + stuck]
            found[side] = across[0] * field[s] - across[1] * field[r]
            found[press:-2] = field[2 * n :]

        slid_ways = w[:, slid, None]
        whole, right = np.zeros((press + n + 2,) * 2), np.zeros(press + n + 2)
        rows(columns, whole)
        rows(known, right)
        own = np.arange(2 * a, press)
        d = self.d[inside[slid]]
        whole[own, own] += d * (1 - share) / share
        ways = points.along[every[: 2 * n]].reshape(2, n)
        if loads.drag is None:
            whole[-2, -2], right[-2] = 1.0, loads.shift
        else:
            whole[-2, held] = ways[:, stuck].ravel()
            whole[-2, own] = ways[1, slid] * w[0, slid] - ways[0, slid] * w[1, slid]
            whole[-2, press + slid] = self.friction * np.sum(ways[:, slid] * w[:, slid], axis=0)
            right[-2] = loads.drag
        if loads.force is None:
            whole[-1, -1], right[-1] = 1.0, loads.approach
        else:
            whole[-1, press:-2] = points.areas[inside]
            right[-1] = loads.force
        # Small rings beside large ones, in units in which they are alike.
        units = np.ones(len(whole))
        units[held] = np.tile(self.d[inside[stuck]], 2)
        units[side], units[press:-2] = d, self.d[2 * size + inside]
        units = 1 / np.sqrt(units)
        whole *= units
        whole[:-2] *= units[:-2, None]
        right[:-2] *= units[:-2]
        LU, places, failed = lapack.dgetrf(whole.T)
        if failed:
            return None
        found = lapack.dgetrs(LU, places, right, trans=1)[0]
        found += lapack.dgetrs(LU, places, right - whole @ found, trans=1)[0]
        found *= units
        if not np.all(np.isfinite(found)):
            return None
        x = np.zeros_like(at.x)
        p = found[press:-2]
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
