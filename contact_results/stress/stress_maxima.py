"""Largest stresses of a body, of its materials, and on each side of its interfaces."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from contact_results.largest import index_of_largest
from contact_results.number_text import number_text, uncertainty
from contact_results.stress.points import (
    ON_INTERFACES,
    StressField,
    StressPoints,
    layer_name,
)
from contact_scene import Body, IsotropicMaterial
from contact_scene.array_types import Field
from contact_scene.discretised import PRECISION
from contact_scene.quantities.stated_error import StatedError
from contact_scene.reading.engineering_units import engineering_unit

# Region of all surface points. A shear load has its largest principal stress at the trailing edge.
SURFACE = "surface"


@dataclass(frozen=True)
class Extreme:
    """Largest value of a stress measure in a region of a body, at a computed point.

    region          whole body, surface, a layer, the base, or a side of an interface
    measure         name of the stress measure, see `points.MEASURES`
    value           largest value [force/length^2]
    x, y, depth     place of the point [length]
    at_window_edge  True if the point is at the edge of the computed region, so that the true
                    maximum may lie outside
    on_edge         True if the point is on the fitted edge of the contact
    """

    region: str
    measure: str
    value: float
    x: float
    y: float
    depth: float
    at_window_edge: bool
    on_edge: bool = False


def extremes(field: StressField) -> tuple[Extreme, ...]:
    """Find the largest value of every stress measure in every region of a body.

    Points on the fitted edge of the contact are included. A measure without a positive value has
    no largest value if its highest value lies at the edge of the computed region: stresses decay to
    zero beyond this edge.
    """
    found = {(e.region, e.measure): e for e in _largest_in_regions(field, field.points)}
    if field.edge is not None:
        for extreme in _largest_in_regions(field, field.edge.points):
            key = extreme.region, extreme.measure
            if key not in found or extreme.value > found[key].value:
                found[key] = replace(extreme, on_edge=True)
    return tuple(found.values())


def excess_between_depths(
    points: StressPoints, values: Field, extreme: Extreme
) -> tuple[float, tuple[float, ...]]:
    """Estimate how much the largest stress exceeds the value found at discrete depths.

    The estimate is that of a parabola through the largest values at the depth of this stress and at
    the next depths above and below.

    points   points of the stress field
    values   stress measure at these points
    extreme  largest value of this measure

    Returns the excess and the three depths [length]; 0 and no depths on an interface and at the end
    of a material.
    """
    here = (points.depth == extreme.depth) & (values == extreme.value)
    inside = points.material == points.material.flat[int(np.argmax(here))]
    levels = np.unique(points.depth[inside])
    round_off = PRECISION * levels[-1]  # of equal depths in two refinements of a maximum
    above = levels[levels < extreme.depth - round_off]
    below = levels[levels > extreme.depth + round_off]
    if extreme.region.startswith("interface") or not (above.size and below.size):
        return 0.0, ()
    three = float(above[-1]), extreme.depth, float(below[0])
    largest = [float(np.max(values[inside & (points.depth == z)])) for z in three]
    bend, slope, _ = np.polyfit(np.array(three) - extreme.depth, largest, 2)
    return (float(slope**2 / (-4 * bend)) if bend < 0 else 0.0), three


def _largest_in_regions(field: StressField, points: StressPoints) -> Iterator[Extreme]:
    """Yield the largest value of every stress measure in every region at some points of a field.

    The measures of interfaces are evaluated on the upper side of each interface only. The places
    are transformed to the axes of the scene.
    """
    along, across = field.direction
    for region, inside in _region_masks(points, field.body):
        if not np.any(inside):
            continue
        for measure, values in points.measures.items():
            # These measures are continuous across an interface: one side suffices.
            if measure in ON_INTERFACES and not region.endswith("above"):
                continue
            k = index_of_largest(np.where(inside, values, -np.inf))
            value, x, y, depth = (
                float(of.flat[k]) for of in (values, points.x, points.y, points.depth)
            )
            x, y = along * x - across * y + 0.0, across * x + along * y + 0.0
            at_edge = bool(points.at_edge.flat[k])
            if not at_edge or value >= 0:
                yield Extreme(region, measure, value, x, y, depth, at_edge)


def interface_sides(body: Body) -> list[tuple[int, str, float, int]]:
    """Return number, side, depth and material index of each elastic side of every interface.

    Interfaces count from 1 for the outermost. A rigid base has no elastic side.
    """
    depths = np.cumsum([layer.thickness for layer in body.layers])
    sides = []
    for k, depth in enumerate(depths.tolist()):
        sides.append((k + 1, "above", depth, k))
        if k + 1 < len(depths) or isinstance(body.material, IsotropicMaterial):
            sides.append((k + 1, "below", depth, k + 1))
    return sides


def _region_masks(points: StressPoints, body: Body) -> Iterator[tuple[str, NDArray[np.bool_]]]:
    """Yield each region of a body by name, with the mask of the given points that lie in it.

    The regions are the whole body, the surface, each material, and both sides of every interface. A
    body without layers has the region "body" only.
    """
    yield "body", np.ones(points.x.shape, dtype=bool)
    if not body.layers:
        return
    yield SURFACE, points.depth == 0
    for material in np.unique(points.material).tolist():
        yield layer_name(material, len(body.layers)), points.material == material
    for number, side, depth, material in interface_sides(body):
        yield f"interface {number} {side}", points.is_on_side(depth, material)


def stress_doubts(
    found: Sequence[Extreme], errors: Sequence[StatedError] | None
) -> tuple[str, ...]:
    """Return one line for each reason why errors of the largest stresses have not converged.

    found   largest stresses
    errors  stated errors of `found`; None if they were not computed
    """
    groups: dict[str, list[str]] = {}
    for extreme, error in zip(found, errors or (), strict=bool(errors)):
        if error.reason:
            groups.setdefault(error.reason, []).append(f"{extreme.measure} of {extreme.region}")
    return tuple(
        f"? {'all' if len(of) == len(found) else ', '.join(of)}: {reason}"
        for reason, of in groups.items()
    )


def maxima_columns(
    found: Sequence[Extreme], errors: Sequence[StatedError] | None
) -> dict[str, list[str]]:
    """Return a table of the largest stresses, as columns by heading.

    Regions with the same maximum share a row.

    found   largest stresses
    errors  stated errors of `found`; None if they were not computed
    """
    unit = engineering_unit(max(abs(e.value) for e in found), "Pa")
    length = engineering_unit(max(abs(x) for e in found for x in (e.x, e.y, e.depth)), "m")
    headings = ["region", "measure", f"largest\n{unit.name}"]
    headings += [f"{name}\n{length.name}" for name in ("x", "y", "depth")]
    rows: dict[tuple[str, ...], list[str]] = {}
    stated: Sequence[StatedError | None] = errors or [None] * len(found)
    for e, error in zip(found, stated, strict=True):
        places = (round(x / length.size, 4) + 0.0 for x in (e.x, e.y, e.depth))
        value = number_text(e.value, uncertainty(error), unit.size)
        rows.setdefault((e.measure, value, *(f"{x:.4g}" for x in places)), []).append(e.region)
    regions = [", ".join(names) for names in rows.values()]
    return dict(zip(headings, [regions, *map(list, zip(*rows, strict=True))], strict=True))
