"""A body below pressure and shear on a circle: its parts, places and largest stresses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from contact_results.stress.body_regions import IN_LAYER, REACH, BodyRegions, spacing
from contact_results.stress.extremes import Extreme
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import StressPoints

if TYPE_CHECKING:
    from radial.below_circle import BelowCircle
    from semi_analytical.frf.depth import Level

Field = NDArray[np.float64]

INSIDE, BESIDE, DOWN = 20, 16, 28  # points over the radius, outside and in depth
# Points beside the plane of the section, where a layer's base has its largest tension: radii of the
# circle, angles, and every so many levels.
RADII, ANGLES, EVERY = np.array([0.3, 0.6, 0.8, 0.95, 1.0, 1.15, 1.5]), 7, 2
# About a largest stress: points to either side, by which their spacing is divided in every round.
ABOUT, ROUNDS = 2, 5


@dataclass(frozen=True)
class CircleBody:
    """One body below a circle, in axes in which x points along the load.

    below      its fields
    parts      of it, and how deep
    direction  of the load in the scene, unit vector
    """

    below: BelowCircle
    parts: BodyRegions
    direction: tuple[float, float]

    @classmethod
    def of(cls, state: LoadedBodies, indenter: bool, fineness: int = 1) -> CircleBody:
        """Of a state, with so many times as many points as it takes, and another fit of the edge
        where there are more; raises UnsupportedScene on too few rings."""
        from radial.below_circle import BelowCircle
        from radial.circle_fit import ANOTHER, USUAL, pushed_circle, round_circle
        from semi_analytical.frf.stack import stack_of

        assert state.pressed is not None
        radii, angles, p = (
            state.axes["radii"],
            state.axes.get("angles"),
            state.tractions["pressure"],
        )
        names = ("shear_radial", "shear_circumferential")
        outward, around = (state.tractions.get(name, np.zeros_like(p)) for name in names)
        if angles is None:
            circle, highest = round_circle(radii, state.pressed[1], outward, around, p), 1
        else:
            fit = USUAL if fineness == 1 else ANOTHER
            circle, highest = pushed_circle(radii, angles, outward, around, p, fit), len(angles)
        body = state.body
        if indenter:
            body, circle = state.indenter, circle.reversed()
        parts = BodyRegions.of(body, circle.radius, DOWN)
        below = BelowCircle(circle, stack_of(body), REACH, highest, fineness)
        return cls(below, parts, state.direction)

    @property
    def is_round(self) -> bool:
        """Whether a half of the section says all."""
        return self.below.circle.is_round

    @property
    def section(self) -> Field:
        """Places of the section (n,), closer towards the edge; of a round circle those from the
        axis on [length]."""
        inside = np.sin(0.5 * np.pi * np.arange(INSIDE) / INSIDE)
        beside = 1 + (REACH - 1) * (np.arange(BESIDE + 1) / BESIDE) ** 2
        ahead = self.parts.radius * np.concatenate([inside, beside])
        if self.is_round:
            return np.asarray(ahead)
        centre = self.below.circle.centre
        return np.unique(np.concatenate([centre - ahead, [0.0], centre + ahead]))

    def points(self, levels: Sequence[Level], x: Field, y: Field) -> StressPoints:
        """At places (n,) of every level (levels, n)."""
        fields = self.below.at(levels, x, y)
        depth, layer = (
            np.array([getattr(level, name) for level in levels])[:, None]
            for name in ("depth", "layer")
        )
        nothing = np.zeros_like(fields[:, 0])
        furthest = (1 - 1e-9) * REACH * self.parts.radius
        away = np.hypot(x - self.below.circle.centre, y) >= furthest
        return StressPoints(
            nothing + x,
            nothing + y,
            nothing + depth,
            np.broadcast_to(layer, nothing.shape),
            np.moveaxis(fields[:, :3], 1, 0),
            np.moveaxis(fields[:, 3:], 1, 0),
            at_edge=away | (depth == self.parts.deepest),
        )

    def beside(self, levels: Sequence[Level]) -> StressPoints | None:
        """At places beside the plane of the section; None where it says all."""
        if self.is_round:
            return None
        angles = np.pi * np.arange(1, ANGLES + 1) / (ANGLES + 1)
        r = self.parts.radius * RADII[:, None]
        x, y = self.below.circle.centre + r * np.cos(angles), r * np.sin(angles)
        last = len(levels) - 1
        sides = [
            n for n, level in enumerate(levels)
            if n % EVERY == 0 or n in (0, last)
            or level.depth in (levels[n - 1].depth, levels[min(n + 1, last)].depth)
        ]  # fmt: skip
        return self.points([levels[n] for n in sides], x.ravel(), y.ravel())

    def largest(self, extreme: Extreme) -> StressPoints:
        """The point of its region where a measure is largest, and others about it (n,), from one of
        those that were looked at."""
        from semi_analytical.frf.depth import Level

        material, top, bottom = self.parts.named[extreme.region]
        c, s = self.direction
        x, y, z = c * extreme.x + s * extreme.y, c * extreme.y - s * extreme.x, extreme.depth
        centre, radius = self.below.circle.centre, self.parts.radius
        r, theta = np.hypot(x - centre, y), np.arctan2(y, x - centre)
        ahead = self.section if self.is_round else self.section[self.section > centre] - centre
        across, down = spacing(ahead, r), spacing(self.parts.depths, z)
        down = min(down, (bottom - top) / IN_LAYER)
        # In the plane it stays there, by symmetry.
        around = np.pi / (ANGLES + 1) if abs(y) > 1e-9 * radius else 0.0
        steps = np.arange(-ABOUT, ABOUT + 1) / ABOUT
        for _ in range(ROUNDS + 1):
            radii = np.clip(r + across * steps, 0, REACH * radius)
            if radii[0] < radius < radii[-1]:  # where there may be a peak
                radii = np.append(radii, radius)
            depths = np.unique(np.clip(z + down * steps, top, bottom))
            angles = np.unique(np.clip(theta + around * steps, -np.pi, np.pi))
            at, to = (part.ravel() for part in np.meshgrid(np.unique(radii), angles))
            levels = [Level(float(depth), material) for depth in depths]
            found = self.points(levels, centre + at * np.cos(to), at * np.sin(to))
            k = int(np.argmax(found.measures[extreme.measure]))
            r, theta = float(at[k % len(at)]), float(to[k % len(at)])
            z = float(found.depth.flat[k])
            across, down, around = across / ABOUT, down / ABOUT, around / ABOUT
        return found.chosen(np.ones(found.x.shape, dtype=bool))
