"""Regions of a body below a contact of the radial solver, and the depths of the stress points."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from contact_results.stress.points import layer_name
from contact_results.stress.stress_maxima import (
    SURFACE,
    interface_sides,
)
from contact_scene import Body, IsotropicMaterial
from contact_scene.array_types import Field

if TYPE_CHECKING:
    from semi_analytical.frf.depth import Level


REACH = 5.0  # extent of the points to the sides and in depth, in contact radii
IN_LAYER = 8  # smallest number of depth intervals in a layer
FIRST = 1e-3  # first depth below infinite pressure, relative to radius or outer layer


@dataclass(frozen=True)
class BodyRegions:
    """Regions of one body below a contact, and the depths at which the stress is computed.

    radius   contact radius [length]
    layers   number of layers
    named    material index, smallest and largest depth [length] of each region, by name
    deepest  largest depth in the base [length]; None if the base is rigid
    first    smallest depth [length]; positive if the pressure is infinite at a point
    down     number of depth intervals within `REACH` radii
    """

    radius: float
    layers: int
    named: Mapping[str, tuple[int, float, float]]
    deepest: float | None
    first: float
    down: int

    @classmethod
    def from_body(
        cls, body: Body, radius: float, down: int, *, infinite: bool = False
    ) -> BodyRegions:
        """Determine the regions of a body and the depths at which the stress is computed.

        body      layers and base
        radius    contact radius [length]
        down      number of depth intervals within `REACH` radii
        infinite  True if the pressure is infinite at a point
        """
        count = len(body.layers)
        tops = [0.0, *np.cumsum([layer.thickness for layer in body.layers]).tolist()]
        elastic = isinstance(body.material, IsotropicMaterial)
        deepest = max(REACH * radius, 2 * tops[-1]) if elastic else None
        first = FIRST * min([radius, *tops[1:2]]) if infinite else 0.0
        tops[0] = first
        bottoms = tops[1:] if deepest is None else [*tops[1:], deepest]
        named = {
            layer_name(layer, count) if count else "body": (layer, tops[layer], bottom)
            for layer, bottom in enumerate(bottoms)
        }
        if count and not infinite:
            named[SURFACE] = (0, first, first)
        for number, side, depth, material in interface_sides(body):
            named[f"interface {number} {side}"] = (material, depth, depth)
        return cls(radius, count, named, deepest, first, down)

    @property
    def depths(self) -> Field:
        """Default depths of the stress points, denser towards the surface (n,) [length]."""
        near = REACH * self.radius * (np.arange(self.down + 1) / self.down) ** 2
        if self.deepest is None:
            return np.asarray(near)
        return np.concatenate([near, np.linspace(near[-1], self.deepest, IN_LAYER + 1)[1:]])

    def stress_levels(self, depths: Sequence[float] | None) -> Iterator[Level]:
        """Yield the depths at which the stress is computed, each with its material, downward.

        The result contains the given depths and both sides of every interface.

        depths  depths [length]; None chooses them from the contact radius and the layers

        Raises ValueError for a depth outside the body.
        """
        from semi_analytical.frf.depth import Level

        lowest = max(bottom for _, _, bottom in self.named.values())
        for depth in depths or ():
            if not (depth >= 0 and isfinite(depth) and (self.deepest or depth <= lowest)):
                raise ValueError(
                    f"got a depth of {depth!r} m, expected one in the body, which starts at 0"
                )
        chosen = self.depths if depths is None else np.asarray(depths)
        chosen = np.maximum(chosen, self.first)
        for material, top, bottom in self.named.values():
            if top == bottom:
                continue
            is_base = material == self.layers
            here = {*chosen[(chosen > top) & (is_base | (chosen < bottom))].tolist()}
            here |= set() if is_base else {bottom}
            here |= {top} if material or top in chosen else set()
            if depths is None and not is_base:
                here |= set(np.linspace(top, bottom, IN_LAYER + 1).tolist())
            for depth in sorted(here):
                yield Level(depth, material)


def adjacent_spacing(places: Field, at: float) -> float:
    """Return the larger of the two grid intervals that are adjacent to a coordinate [length].

    places  ascending grid coordinates (n,) [length]
    at      the coordinate [length]
    """
    k = int(np.clip(np.searchsorted(places, at), 1, len(places) - 2))
    return float(np.max(np.diff(places[k - 1 : k + 2])))
