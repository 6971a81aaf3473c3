"""A body below pressure that is known at every radius: its parts, places and largest stresses."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from contact_results.stress.extremes import Extreme, interface_sides, layer_name
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.points import StressPoints

if TYPE_CHECKING:
    from radial.below import Below
    from semi_analytical.frf.depth import Level

Field = NDArray[np.float64]

REACH = 5.0  # contact radii to the sides and in depth
INSIDE, BESIDE, DOWN = 32, 32, 48  # points over the contact, outside and in depth
IN_LAYER = 8  # spaces of a layer at the least
FIRST = 1e-3  # contact radii below the surface where the pressure is infinite
# About a largest stress: points to either side, by which their spacing is divided in every round.
ABOUT, ROUNDS = 3, 6


@dataclass(frozen=True)
class DiscBody:
    """One body below a disc.

    below    its fields
    radius   of the contact [length]
    regions  names of its parts, and what of each is looked at: material, least and largest depth
             [length]
    deepest  place in the base; None where that is rigid [length]
    first    least depth: that of the surface, unless the pressure is infinite there [length]
    """

    below: Below
    radius: float
    regions: dict[str, tuple[int, float, float]]
    deepest: float | None
    first: float

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
        stack, count = stack_of(body), len(body.layers)
        tops = [0.0, *np.cumsum([layer.thickness for layer in body.layers]).tolist()]
        deepest = None if stack.base is None else max(REACH * a, 2 * tops[-1])
        infinite = contact.profile.apex or contact.edge != 0
        first = FIRST * min([a, *tops[1:2]]) if infinite else 0.0
        tops[0] = first
        bottoms = tops[1:] if deepest is None else [*tops[1:], deepest]
        regions = {
            layer_name(layer, count) if count else "body": (layer, tops[layer], bottom)
            for layer, bottom in enumerate(bottoms)
        }
        for number, side, depth, material in interface_sides(body):
            regions[f"interface {number} {side}"] = (material, depth, depth)
        return cls(Below(contact, stack, REACH, fineness), a, regions, deepest, first)

    @property
    def radii(self) -> Field:
        """Of the section, closer towards the edge [length]."""
        inside = np.sin(0.5 * np.pi * np.arange(INSIDE) / INSIDE)
        beside = 1 + (REACH - 1) * (np.arange(BESIDE + 1) / BESIDE) ** 2
        return np.asarray(self.radius * np.concatenate([inside, beside]))

    @property
    def depths(self) -> Field:
        """Of the section, closer towards the surface [length]."""
        near = REACH * self.radius * (np.arange(DOWN + 1) / DOWN) ** 2
        if self.deepest is None:
            return np.asarray(near)
        return np.concatenate([near, np.linspace(near[-1], self.deepest, IN_LAYER + 1)[1:]])

    def levels(self, depths: Sequence[float] | None) -> Iterator[Level]:
        """Downward: depths [length], None for what fits contact and layers, and both sides of every
        interface; raises ValueError for a depth that is not in the body."""
        from semi_analytical.frf.depth import Level

        layers = len(self.below.stack.layers)
        lowest = max(bottom for _, _, bottom in self.regions.values())
        for depth in depths or ():
            if not (depth >= 0 and isfinite(depth) and (self.deepest or depth <= lowest)):
                raise ValueError(f"{depth!r} m is not in the body, which begins at 0")
        chosen = self.depths if depths is None else np.asarray(depths)
        chosen = np.maximum(chosen, self.first)
        for material, top, bottom in self.regions.values():
            if top == bottom:
                continue
            is_base = material == layers
            here = {*chosen[(chosen > top) & (is_base | (chosen < bottom))].tolist()}
            here |= set() if is_base else {bottom}
            here |= {top} if material or top in chosen else set()
            if depths is None and not is_base:
                here |= set(np.linspace(top, bottom, IN_LAYER + 1).tolist())
            for depth in sorted(here):
                yield Level(depth, material)

    def points(self, levels: Sequence[Level], r: Field) -> StressPoints:
        """At radii r (n,) of every level, along x (levels, n)."""
        u_r, u_z, rr, tt, zz, rz = np.moveaxis(self.below.at(levels, r), 1, 0)
        depth, layer = (
            np.array([getattr(level, name) for level in levels])[:, None]
            for name in ("depth", "layer")
        )
        nothing = np.zeros_like(rr)
        infinite = (depth == self.first) & (self.first > 0)
        return StressPoints(
            nothing + r,
            nothing,
            nothing + depth,
            np.broadcast_to(layer, rr.shape),
            np.stack([u_r, nothing, u_z]),
            np.stack([rr, tt, zz, nothing, rz, nothing]),
            at_edge=(r == self.radii[-1]) | (depth == self.deepest) | infinite,
        )

    def largest(self, extreme: Extreme) -> StressPoints:
        """The point of its region where a measure is largest, and others about it (n,), from one of
        the section."""
        from semi_analytical.frf.depth import Level

        material, top, bottom = self.regions[extreme.region]
        r, z = extreme.x, extreme.depth
        across, down = _spacing(self.radii, r), _spacing(self.depths, z)
        down = min(down, (bottom - top) / IN_LAYER)
        steps = np.arange(-ABOUT, ABOUT + 1) / ABOUT
        while True:
            radii = np.unique(np.clip(r + across * steps, 0, self.radii[-1]))
            depths = np.unique(np.clip(z + down * steps, top, bottom))
            found = self.points([Level(float(depth), material) for depth in depths], radii)
            at = int(np.argmax(found.measures[extreme.measure]))
            r, z = float(found.x.flat[at]), float(found.depth.flat[at])
            across, down = across / ABOUT, down / ABOUT
            if across < _spacing(self.radii, r) / ABOUT**ROUNDS:
                return found.chosen(np.ones(found.x.shape, dtype=bool))


def _spacing(places: Field, at: float) -> float:
    """Of the wider space beside a place [length]."""
    k = int(np.clip(np.searchsorted(places, at), 1, len(places) - 2))
    return float(np.max(np.diff(places[k - 1 : k + 2])))
