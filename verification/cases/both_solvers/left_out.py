"""Where two solvers are not compared: near the axis, near the edge, and at kinks of the shear.

What sticks keeps the differences of shear that it had when it began to stick. An edge of stick that
moves outward steadily leaves no more than the ripple of its increments; one that comes back and
turns outward again, or that lay still when the load turned, leaves its kink until slip passes over
it. Where it lies follows from the loads; cells and elements round it, each in its way.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from verification.observed.ring_errors import judged_within

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]

MARGIN = 1.15  # half a window in contact radii without friction
JUDGED_WITHIN = 0.9  # contact radii; nearer the edge everything is steep
# In cells or elements, whichever is larger.
AXIS = 2.0  # nearer, the outward shear turns round within a cell
KINK = 2.0
FRONT = 1.5  # on a line through the contact, where fronts are known to half a place
EVEN = 1e-9
# Contacts grow uniformly in radius. While they are a few elements wide the shear is locked as
# coarsely as these are: an error that goes with the number of elements to the axis, is the same on
# every mesh, and at a given radius falls.
FEW = 8  # elements of the coarser mesh
# Without friction the edge of the contact is on a ring, from where its ripple reaches one further.
EDGE_ON_RING = 1  # element


def width(cells: int, elements: int) -> float:
    """Of a cell or an element, whichever is larger, over the contact radius."""
    return max(2 * MARGIN / cells, 1 / elements)


def radii(elements: int, cells: int, within: float = JUDGED_WITHIN) -> Field:
    """The rings of a mesh that are off the axis and not beyond a radius, over that of contact."""
    rings = np.arange(AXIS, elements + 1) / elements
    judged = (rings >= AXIS * 2 * MARGIN / cells) & (rings <= within * (1 + EVEN))
    return np.asarray(rings[judged])


def radii_of_meshes(elements: int, cells: int) -> Field:
    """The same for two meshes, the coarser of so many elements, that have no kink at the axis: away
    from it, and where the ripple of the coarser one at the edge does not reach."""
    rings = radii(elements, cells, judged_within(elements) - EDGE_ON_RING / elements)
    return np.asarray(rings[rings >= FEW / elements])


def clear_of_axis(at: Field, edges: Sequence[float], resolution: float) -> Field:
    """The radii further from the axis than two of the resolution; all of them unless stick ends, or
    turned, within one. For cells and elements the outward shear then jumps at the axis, which the
    pressure answers with a logarithmic peak: as many elements away its error is the same on every
    mesh."""
    if not any(edge <= resolution for edge in edges):
        return at
    return np.asarray(at[at > AXIS * resolution * (1 + EVEN)])


def away_from_kinks(at: Field, edges: Sequence[float], resolution: float) -> Mask:
    """Which radii are further from all kinks than two of the resolution."""
    away = np.ones(len(at), dtype=bool)
    for edge in edges:
        away &= np.abs(at - edge) > KINK * resolution
    return away


def kept_edges(stick_radii: Sequence[float], resolution: float) -> tuple[float, ...]:
    """Radii at which shear has a kink after these increments: where the edge of stick turned
    outward and never came back, and last where it is now.

    stick_radii  after every increment [length]
    resolution   how well they are known: coming back by less is none [length]
    """
    c = np.asarray(stick_radii)
    least_later = np.minimum.accumulate(c[::-1])[::-1][1:]
    passed_for_good = np.flatnonzero(c[:-1] < least_later)
    since = [0, *(passed_for_good[:-1] + 1)]
    turned = (
        float(c[k])
        for start, k in zip(since, passed_for_good, strict=False)
        if np.max(c[start : k + 1]) - c[k] > resolution
    )
    return (*turned, float(c[-1]))


def kept_fronts(x: Field, stuck: Mask, turns: Sequence[int]) -> list[float]:
    """Places on a line at which shear has a kink after these increments: where stick began or ended
    when the load turned, if both sides have stuck ever since.

    x      places of the solution on the line [length]
    stuck  (increments, places)
    turns  increments after which the load turned; the last is not later than the last of `stuck`,
           where fronts are as they are now
    """
    middles = 0.5 * (x[1:] + x[:-1])
    fronts: list[float] = []
    for turn in turns:
        kept = np.all(stuck[turn + 1 :], axis=0)
        between = (stuck[turn, 1:] != stuck[turn, :-1]) & kept[1:] & kept[:-1]
        fronts.extend(middles[between].tolist())
    return fronts
