"""The largest stresses of a body: in all of it, in each material and on each side of interfaces."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from contact_results.stress.points import ON_INTERFACES, StressField, StressPoints
from contact_scene import Body, IsotropicMaterial

# Its largest principal stress is that at the trailing edge, if the body is pushed.
SURFACE = "surface"


@dataclass(frozen=True)
class Extreme:
    """Where in a region a measure is largest: a point itself, nothing interpolated.

    at_window_edge  whether it is on the edge of what was computed, and there may be more beyond
    on_edge         whether it is on the fitted edge of the contact
    """

    region: str
    measure: str
    value: float
    x: float
    y: float
    depth: float
    at_window_edge: bool
    on_edge: bool = False


def extremes(field: StressField, body: Body) -> tuple[Extreme, ...]:
    """Of every measure in every region."""
    found = {(e.region, e.measure): e for e in _extremes(field.points, field.direction, body)}
    if field.edge is not None:
        for extreme in _extremes(field.edge.points, field.direction, body):
            key = extreme.region, extreme.measure
            if extreme.value > found[key].value:
                found[key] = replace(extreme, on_edge=True)
    return tuple(found.values())


def _extremes(
    points: StressPoints, direction: tuple[float, float], body: Body
) -> Iterator[Extreme]:
    along, across = direction
    for region, inside in _regions(points, body):
        if not np.any(inside):
            continue
        for measure, values in points.measures.items():
            # Both are continuous across an interface, and of no other plane.
            if measure in ON_INTERFACES and not region.endswith("above"):
                continue
            k = int(np.argmax(np.where(inside, values, -np.inf)))
            value, x, y, depth = (
                float(field.flat[k]) for field in (values, points.x, points.y, points.depth)
            )
            x, y = along * x - across * y + 0.0, across * x + along * y + 0.0
            at_edge = bool(points.at_edge.flat[k])
            yield Extreme(region, measure, value, x, y, depth, at_edge)


def layer_name(layer: int, layers: int) -> str:
    """`layer 1` for the outermost, `base` below the last."""
    return f"layer {layer + 1}" if layer < layers else "base"


def interface_sides(body: Body) -> list[tuple[int, str, float, int]]:
    """Number, side, depth and material of both sides of every interface; of a rigid base one."""
    depths = np.cumsum([layer.thickness for layer in body.layers])
    sides = []
    for k, depth in enumerate(depths.tolist()):
        sides.append((k + 1, "above", depth, k))
        if k + 1 < len(depths) or isinstance(body.material, IsotropicMaterial):
            sides.append((k + 1, "below", depth, k + 1))
    return sides


def _regions(points: StressPoints, body: Body) -> Iterator[tuple[str, NDArray[np.bool_]]]:
    """Names of the regions, and which points belong to them."""
    yield "body", np.ones(points.x.shape, dtype=bool)
    if not body.layers:
        return
    yield SURFACE, points.depth == np.min(points.depth)
    for material in np.unique(points.material).tolist():
        yield layer_name(material, len(body.layers)), points.material == material
    for number, side, depth, material in interface_sides(body):
        yield f"interface {number} {side}", points.on_side(depth, material)
