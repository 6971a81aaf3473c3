"""Pressure and shear of one increment under Coulomb's law at points (r, θ), pushed one way.

Points are where nodes of rings meet angles between 0 and π; of the other half circle everything is
the mirror image. The law holds in the mean over the hat of every node,

    p = max(p - g/d, 0),    q = P(q - Δs/d),

with P the nearest vector no longer than µ max(p - g/d, 0); its zero is found by Newton's method,
for one in which all that is projected is projected as it is now (Alart and Curnier 1991).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dct, dst
from scipy.interpolate import CubicSpline

from contact_scene.solver_errors import ContactAtZoneEdge, GrossSliding, NotConverged

Array = NDArray[np.float64]

MOST_STEPS = 60
SHORTEST = 2.0**-6  # of a step of Newton's method
FINER, AROUND = 16, 180  # places per element and angles, where a front is looked for


@dataclass(frozen=True, eq=False)
class Points:
    """Nodes of rings times angles, and what tractions at them do.

    energies  of `ring_compliance` up to harmonic J, of the bodies (J + 1, 3, 3, n, n)
    weights   ∫ φ r dr (n,) [length²]
    gap       ∫ φ f r dr at first touch (n,) [length³]

    Fields of points are (n J,), angle by angle within a node; vectors (3 n J,), r, θ, z outermost.
    """

    energies: Array
    weights: Array
    gap: Array

    @property
    def count(self) -> int:
        """J, angles on the half circle."""
        return len(self.energies) - 1

    @property
    def angles(self) -> Array:
        """θ_j = π(j + ½)/J."""
        return np.pi * (np.arange(self.count) + 0.5) / self.count

    @cached_property
    def areas(self) -> Array:
        """Of every point and its mirror image."""
        return np.repeat(self.weights, self.count) * (2 * np.pi / self.count)

    @cached_property
    def bare(self) -> Array:
        """f times the area of a point."""
        return np.repeat(self.gap, self.count) * (2 * np.pi / self.count)

    @cached_property
    def along(self) -> Array:
        """Areas times the direction of the load, in r and θ (2 n J,)."""
        nodes = len(self.weights)
        ways = np.tile(np.cos(self.angles), nodes), -np.tile(np.sin(self.angles), nodes)
        return np.concatenate([self.areas * way for way in ways])

    @cached_property
    def compliance(self) -> Array:
        """Displacements times areas by tractions (3 n J, 3 n J) [length^5/force]."""
        J, nodes = self.count, len(self.weights)
        cosines, sines = np.zeros((J + 1, J)), np.zeros((J + 1, J))
        cosines[:J] = dct(np.eye(J), type=2, axis=0) / J
        sines[1:] = dst(np.eye(J), type=2, axis=0) / J
        cosines[0] /= 2
        sines[J] /= 2
        norms = np.full(J + 1, np.pi)
        norms[[0, J]] = 2 * np.pi
        ways = np.stack([cosines, sines, cosines])
        whole = np.einsum(
            "m,amj,mabik,bml->aijbkl", norms, ways, self.energies, ways, optimize=True
        )
        return whole.reshape(3 * nodes * J, -1)


@dataclass(frozen=True)
class Held:
    """The state at the end of an increment.

    tractions  q_r, q_θ, p (3 n J,) [force/length²]
    moved      u_r, u_θ times area (2 n J,) [length³]
    share      of the limit: |q - Δs/d| over it, ≤ 1 where a point sticks, infinite out of contact
    missed     of the laws, over the largest pressure and the load
    """

    tractions: Array
    moved: Array
    shift: float
    approach: float
    share: Array
    missed: float


def held(
    points: Points, friction: float, load: float, drag: float, before: Held | None, tolerance: float
) -> Held:
    """The state under W = load and T_x = drag [force].

    before  the state from which surfaces slip; None: they have not touched
    raises  NotConverged; GrossSliding from T = µW on; ContactAtZoneEdge at the last ring
    """
    if abs(drag) >= friction * load:
        raise GrossSliding(
            f"T = {drag:g} is not below µW = {friction * load:g}: the indenter slides"
        )
    laws = _Laws.of(points, friction, load, drag, before)
    x = laws.closed() if before is None else np.append(before.tractions, laws.motion)
    at = laws.at(x)
    for _ in range(MOST_STEPS):
        if at.worst <= tolerance:
            return _ended(points, at)
        try:
            change = np.linalg.solve(laws.derivative(at), at.missed)
        except np.linalg.LinAlgError:
            break
        step, size = 1.0, np.linalg.norm(at.missed[:-2])
        tried = laws.at(at.x - change)
        while (
            tried.worst >= at.worst
            and np.linalg.norm(tried.missed[:-2]) >= size
            and step > SHORTEST
        ):
            step /= 2
            tried = laws.at(at.x - step * change)
        at = tried
    raise NotConverged("contact and friction on rings", MOST_STEPS, at.worst, tolerance)


def _ended(points: Points, at: _At) -> Held:
    pressed = at.limit.reshape(-1, points.count) > 0
    if np.any(pressed[-1]):
        raise ContactAtZoneEdge("the contact reaches the last ring; lay rings further out")
    length = np.hypot(*at.y)
    inside = at.z > 0
    share = np.where(inside, length / np.where(inside, at.limit, 1.0), np.inf)
    shift, approach = at.x[-2:]
    return Held(at.x[:-2], at.u, float(shift), float(approach), share, at.worst)


def stick_area(points: Points, radii: Array, state: Held) -> float:
    """Where the share of the limit is below 1, linear in r, a spline in θ [length²]: no count of
    points.

    radii  of the nodes (n,)
    """
    left = np.clip(1 - state.share, -1.0, 1.0).reshape(-1, points.count)
    angles = np.concatenate([points.angles, 2 * np.pi - points.angles[::-1]])
    angles, left = np.append(angles, angles[0] + 2 * np.pi), np.hstack([left, left[:, ::-1]])
    around = CubicSpline(angles, np.hstack([left, left[:, :1]]), axis=1, bc_type="periodic")
    turned = around(np.pi * (np.arange(AROUND) + 0.5) / AROUND)
    nodes = np.arange(len(radii))
    edges = np.interp(np.linspace(0, nodes[-1], FINER * nodes[-1] + 1), nodes, radii)
    middle = (edges[1:] + edges[:-1]) / 2
    sticks = np.array([np.interp(middle, radii, values) > 0 for values in turned.T])
    return float(np.pi * np.mean(sticks, axis=0) @ np.diff(edges**2))


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
    """The laws of an increment as equations; those of the loads come last.

    moved, motion  of the state before
    d              of every traction: what it moves where it acts [length^5/force]
    """

    points: Points
    friction: float
    load: float
    drag: float
    moved: Array
    motion: Array
    d: Array

    @classmethod
    def of(
        cls, points: Points, friction: float, load: float, drag: float, before: Held | None
    ) -> _Laws:
        d = np.diagonal(points.compliance).reshape(3, -1)
        beside = (d[0] + d[1]) / 2
        moved, motion = np.zeros(2 * d.shape[1]), np.zeros(2)
        if before is not None:
            moved, motion = before.moved, np.array([before.shift, before.approach])
        d = np.concatenate([beside, beside, d[2]])
        return cls(points, friction, load, drag, moved, motion, d)

    def closed(self) -> Array:
        """Tractions and motion so deep that all points are closed."""
        points, size = self.points, len(self.points.areas)
        t = np.concatenate([np.zeros(2 * size), np.full(size, self.load / points.areas.sum())])
        open_by = (points.compliance @ t)[2 * size :] + points.bare
        return np.append(t, [0.0, np.max(open_by / points.areas)])

    def at(self, x: Array) -> _At:
        points, size = self.points, len(self.points.areas)
        t, (shift, approach) = x[:-2], x[-2:]
        u = points.compliance @ t
        q, p = t[: 2 * size], t[2 * size :]
        gap = u[2 * size :] + points.bare - approach * points.areas
        slipped = u[: 2 * size] - self.moved - (shift - self.motion[0]) * points.along
        z = p - gap / self.d[2 * size :]
        y = (q - slipped / self.d[: 2 * size]).reshape(2, -1)
        limit = self.friction * np.maximum(z, 0.0)
        missed = np.concatenate([
            q - (_shortened(y, limit) * y).ravel(), p - np.maximum(z, 0.0),
            [(points.along @ q - self.drag) / self.load, points.areas @ p / self.load - 1],
        ])  # fmt: skip
        laws = np.max(np.abs(missed[:-2])) / np.max(np.abs(p))
        worst = float(max(laws, np.max(np.abs(missed[-2:]))))
        return _At(x, missed, z, y, limit, u[: 2 * size], worst)

    def derivative(self, at: _At) -> Array:
        """Of what is left by x."""
        points, size = self.points, len(at.z)
        every = np.arange(3 * size)
        by_x = np.zeros((3 * size, 3 * size + 2))  # of y and z
        by_x[:, :-2] = -points.compliance / self.d[:, None]
        by_x[every, every] += 1
        by_x[: 2 * size, -2] = points.along / self.d[: 2 * size]
        by_x[2 * size :, -1] = points.areas / self.d[2 * size :]
        length = np.hypot(*at.y)
        slips = length > at.limit
        way = np.where(slips, at.y / np.where(slips, length, 1.0), 0.0)
        by_x[2 * size :] *= (at.z > 0)[:, None]
        pair = by_x[: 2 * size].reshape(2, size, -1)
        further = np.einsum("ai,aix->ix", way, pair)
        limit = self.friction * by_x[2 * size :]
        pair -= way[..., None] * further
        pair *= _shortened(at.y, at.limit)[:, None]
        pair += way[..., None] * limit
        whole = np.zeros((3 * size + 2, 3 * size + 2))
        whole[:-2] = -by_x
        whole[every, every] += 1
        whole[-2, : 2 * size] = points.along / self.load
        whole[-1, 2 * size : -2] = points.areas / self.load
        return whole


def _shortened(y: Array, limit: Array) -> Array:
    """By what vectors (2, …) are multiplied to be no longer than the limit."""
    length = np.hypot(*y)
    longer = length > limit
    return np.where(longer, limit / np.where(longer, length, 1.0), 1.0)
