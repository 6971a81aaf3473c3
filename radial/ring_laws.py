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
    share      of the limit: |q - Δs/d| over it, ≤ 1 where a point sticks, infinite out of contact
    energy     ½ ∫ (p u_z + q·u) dA [force length]
    missed     of the laws, over the largest pressure, limit and load
    steps      of Newton's method
    """

    tractions: Array
    moved: Array
    slipped: Array
    motion: Array
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
        return np.append(points.ways @ self.shear.ravel(), points.areas @ self.pressure)

    def every_angle(self, points: Points) -> Held:
        """The same at points, of a state that is the same all around."""

        def parts(field: Array, count: int) -> Array:
            return points.every_angle(field.reshape(count, -1)).ravel()

        return replace(
            self,
            tractions=parts(self.tractions, 3),
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
        carried = np.append(points.ways @ q, points.areas @ p)
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
        columns = np.zeros((3 * n, press + n + 4))
        columns[:, :a], columns[:, a : 2 * a] = A[:, stuck], A[:, n + stuck]
        columns[:, side] = A[:, s] * w[0, slid] - A[:, r] * w[1, slid]
        columns[:, press:-4] = A[:, 2 * n :]
        along = A[:, r] * w[0, slid] + A[:, s] * w[1, slid]
        columns[:, press + slid] += self.friction * along
        ways = points.ways[:, every[: 2 * n]]
        columns[: 2 * n, -4:-1] = -ways.T
        columns[2 * n :, -1] = -points.areas[inside]
        known = np.concatenate([
            self.moved[every[: 2 * n]] - self.motion[:DOWN] @ ways, -points.bare[inside],
        ])  # fmt: skip

        def rows(field: Array, found: Array) -> None:
            across = slid_ways if field.ndim > 1 else slid_ways[:, :, 0]
            found[:a], found[a : 2 * a] = field[stuck], field[n + stuck]
            found[side] = across[0] * field[s] - across[1] * field[r]
            found[press:-4] = field[2 * n :]

        slid_ways = w[:, slid, None]
        whole, right = np.zeros((press + n + 4,) * 2), np.zeros(press + n + 4)
        rows(columns, whole)
        rows(known, right)
        own = np.arange(2 * a, press)
        d = self.d[inside[slid]]
        whole[own, own] += d * (1 - share) / share
        ways = ways.reshape(3, 2, n)
        # Of what a load leads the row is its equilibrium, else its motion.
        for i, (force, motion) in enumerate(zip(loads.forces, loads.motions, strict=True)):
            row = whole[i - 4]
            if force is None:
                row[i - 4], right[i - 4] = 1.0, motion
                continue
            right[i - 4] = force
            if i == DOWN:
                row[press:-4] = points.areas[inside]
                continue
            outward, around = ways[i]
            row[held] = ways[i][:, stuck].ravel()
            row[own] = around[slid] * w[0, slid] - outward[slid] * w[1, slid]
            row[press + slid] = self.friction * np.sum(ways[i][:, slid] * w[:, slid], axis=0)
        # Small rings beside large ones, in units in which they are alike.
        units = np.ones(len(whole))
        units[held] = np.tile(self.d[inside[stuck]], 2)
        units[side], units[press:-4] = d, self.d[2 * size + inside]
        units = 1 / np.sqrt(units)
        whole *= units
        whole[:-4] *= units[:-4, None]
        right[:-4] *= units[:-4]
        LU, places, failed = lapack.dgetrf(whole.T)
        if failed:
            return None
        found = lapack.dgetrs(LU, places, right, trans=1)[0]
        found += lapack.dgetrs(LU, places, right - whole @ found, trans=1)[0]
        found *= units
        if not np.all(np.isfinite(found)):
            return None
        x = np.zeros_like(at.x)
        p = found[press:-4]
        q = np.zeros((2, n))
        q[:, stuck] = found[:a], found[a : 2 * a]
        v, most = found[own], self.friction * p[slid]
        q[:, slid] = most * w[:, slid] + v * np.stack([-w[1, slid], w[0, slid]])
        x[every] = np.concatenate([*q, p])
        x[-4:] = found[-4:]
        return x


def _shortened(y: Array, limit: Array) -> Array:
    """By what vectors (2, …) are multiplied to be no longer than the limit."""
    length = np.hypot(*y)
    longer = length > limit
    return np.where(longer, limit / np.where(longer, length, 1.0), 1.0)
