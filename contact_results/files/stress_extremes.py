"""The largest stresses of a body: in all of it, in each material and on each side of interfaces."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.frf.depth import Level
from semi_analytical.stress import Extreme, SubsurfaceField

# Name, and how it follows from the principal stresses, largest first on axis 1.
MEASURES = {
    "von_mises": "equivalent stress of von Mises",
    "max_principal": "largest principal stress, tension positive",
    "max_shear": "half the difference of the extreme principal stresses",
}


@dataclass(frozen=True)
class RegionalExtreme:
    """Where in a region a measure is largest."""

    region: str
    measure: str
    at: Extreme


def extremes(
    field: SubsurfaceField, sides: tuple[tuple[Level, ...], ...]
) -> tuple[RegionalExtreme, ...]:
    """Of every measure in every region.

    field  whole planes
    sides  both sides of every interface, as `interfaces` gives them
    """
    principal = field.principal()
    measures = {
        "von_mises": field.von_mises(),
        "max_principal": principal[:, 0],
        "max_shear": (principal[:, 0] - principal[:, 2]) / 2,
    }
    found = []
    for region, inside in _regions(field.levels, sides):
        for measure in MEASURES:
            values = np.where(inside[:, None, None], measures[measure], -np.inf)
            found.append(RegionalExtreme(region, measure, field.extreme(values)))
    return tuple(found)


def layer_name(layer: int, layers: int) -> str:
    """`layer 1` for the outermost, `base` below the last."""
    return f"layer {layer + 1}" if layer < layers else "base"


def _regions(
    levels: tuple[Level, ...], sides: tuple[tuple[Level, ...], ...]
) -> Iterator[tuple[str, NDArray[np.bool_]]]:
    """Names of the regions, and which levels belong to them."""
    layers = np.array([level.layer for level in levels])
    yield "body", np.ones(len(levels), dtype=bool)
    if not sides:
        return
    for layer in np.unique(layers):
        yield layer_name(int(layer), len(sides)), layers == layer
    for number, pair in enumerate(sides, 1):
        for name, side in zip(("above", "below"), pair, strict=False):
            yield f"interface {number} {name}", np.array([level == side for level in levels])
