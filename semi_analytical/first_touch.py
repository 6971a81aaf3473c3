"""Cells that meet within an increment: for what part of it they are in contact."""

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

Field = NDArray[np.float64]


def touching_share(before: Field, after: Field, gap: Field) -> Field:
    """Part of an increment for which each cell is in contact, of those that are at its end.

    Particles slip past each other from their touch on. Behind an edge that moves on, p² grows as
    the way of the edge since, at all places alike (below a paraboloid p² ~ a² - r²). What a cell
    has of the growth of p² at the nearest cell that touched before is therefore its part of the
    motion: to first order in the increment, in which the motion follows the edge. Before first
    touch the nearest is the place of the largest pressure; there all that has no gap meets at once.

    before, after  pressure at start and end (nx, ny)
    gap            undeformed (nx, ny)
    """
    share = np.ones_like(after)
    touched = before > 0
    apart = ~touched if np.any(touched) else gap > 0
    meets = (after > 0) & apart
    if not np.any(meets):
        return share
    largest = np.max(after)
    p, grown = after / largest, (after / largest) ** 2 - (before / largest) ** 2
    if np.any(touched):
        nearest = distance_transform_edt(~touched, return_distances=False, return_indices=True)
        growth = grown[tuple(part[meets] for part in nearest)]
    else:
        growth = np.ones(np.count_nonzero(meets))
    own = p[meets] ** 2
    share[meets] = np.divide(own, growth, out=np.ones_like(own), where=own < growth)
    return share
