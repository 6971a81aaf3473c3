"""A body below pressure that is known at every radius: its parts, places and largest stresses."""

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
    from radial.below import Below
    from semi_analytical.frf.depth import Level

Field = NDArray[np.float64]

INSIDE, BESIDE, DOWN = 32, 32, 48  # points over the contact, outside and in depth
# About a largest stress: points to either side, by which their spacing is divided in every round.
ABOUT, ROUNDS = 3, 6


@dataclass(frozen=True)
class DiscBody:
    """One body below a disc.

    below  its fields
    parts  of it, and how deep
    """

    below: Below
    parts: BodyRegions

    @classmethod
    def of(cls, state: LoadedBodies, indenter: bool, fineness: int = 1) -> DiscBody:
        """Of a state, with so many times as many orders and points as it takes."""
        from contact_scene import Scene
        from radial.below import Below
        from radial.bodies import Bodies
        from radial.disc import disc
        from semi_analytical.frf.stack import stack_of

        assert state.pressed is not None
        shape, a, approach = state.pressed
        step = {"approach": approach}
        scene = Scene.model_validate({"indenter": shape, "body": state.body, "loading": [step]})
        asked = None if shape.rim is None else approach
        contact = disc(Bodies.of(scene), shape, a, asked, fineness)
        body = state.indenter if indenter else state.body
        infinite = contact.profile.apex or contact.edge != 0
        parts = BodyRegions.of(body, a, DOWN, infinite=infinite)
        return cls(Below(contact, stack_of(body), REACH, fineness), parts)

    @property
    def radii(self) -> Field:
        """Of the section, closer towards the edge [length]."""
        inside = np.sin(0.5 * np.pi * np.arange(INSIDE) / INSIDE)
        beside = 1 + (REACH - 1) * (np.arange(BESIDE + 1) / BESIDE) ** 2
        return np.asarray(self.parts.radius * np.concatenate([inside, beside]))

    def points(self, levels: Sequence[Level], r: Field) -> StressPoints:
        """At radii r (n,) of every level, along x (levels, n)."""
        u_r, u_z, rr, tt, zz, rz = np.moveaxis(self.below.at(levels, r), 1, 0)
        depth, layer = (
            np.array([getattr(level, name) for level in levels])[:, None]
            for name in ("depth", "layer")
        )
        nothing = np.zeros_like(rr)
        infinite = (depth == self.parts.first) & (self.parts.first > 0)
        return StressPoints(
            nothing + r,
            nothing,
            nothing + depth,
            np.broadcast_to(layer, rr.shape),
            np.stack([u_r, nothing, u_z]),
            np.stack([rr, tt, zz, nothing, rz, nothing]),
            at_edge=(r == self.radii[-1]) | (depth == self.parts.deepest) | infinite,
        )

    def largest(self, extreme: Extreme) -> StressPoints:
        """The point of its region where a measure is largest, and others about it (n,), from one of
        the section."""
        from semi_analytical.frf.depth import Level

        material, top, bottom = self.parts.named[extreme.region]
        r, z = extreme.x, extreme.depth
        across, down = spacing(self.radii, r), spacing(self.parts.depths, z)
        down = min(down, (bottom - top) / IN_LAYER)
        steps = np.arange(-ABOUT, ABOUT + 1) / ABOUT
        while True:
            radii = np.unique(np.clip(r + across * steps, 0, self.radii[-1]))
            depths = np.unique(np.clip(z + down * steps, top, bottom))
            found = self.points([Level(float(depth), material) for depth in depths], radii)
            at = int(np.argmax(found.measures[extreme.measure]))
            r, z = float(found.x.flat[at]), float(found.depth.flat[at])
            across, down = across / ABOUT, down / ABOUT
            if across < spacing(self.radii, r) / ABOUT**ROUNDS:
                return found.chosen(np.ones(found.x.shape, dtype=bool))
