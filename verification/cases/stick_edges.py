"""Where shear has a kink: at the edge of stick, and where that edge once rested.

What sticks keeps the differences of shear that it had when it began to stick. An edge of stick that
moves outward steadily leaves no more than the ripple of its increments; one that comes back and
turns outward again, or that lay still when the load turned, leaves its kink until slip passes over
it. Where it lies follows from the loads; cells and elements round it, each in its way.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]


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
