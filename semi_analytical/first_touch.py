"""Cells that meet or part within an increment: for what part of it they are in contact."""

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_erosion

# So many cells at most are equally far from one, up to eight cells away.
EQUALLY_FAR = 12

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]


def touching_share(before: Field, after: Field, gap: Field) -> Field:
    """Part of an increment for which each cell is in contact, of those that are at either end.

    Particles slip past each other from their touch on and until they part. Behind an edge that
    moves on, p² grows as the way of the edge since, at all places alike (below a paraboloid
    p² ~ a² - r²). What a cell has of the growth of p² at the nearest cell that touches at both ends
    (the mean of those equally near, for mirrored contacts to have mirrored slip) is therefore its
    part of the motion: to first order in the increment, in which the motion follows the edge.
    Before first touch the nearest is the place of the largest pressure; there all that has no gap
    meets at once. Parting is meeting backwards.

    before, after  pressure at start and end (nx, ny)
    gap            undeformed (nx, ny)
    """
    share = np.ones_like(after)
    for less, more in ((before, after), (after, before)):
        touched = less > 0
        apart = ~touched if np.any(touched) else gap > 0
        changes = (more > 0) & apart
        if np.any(changes):
            share[changes] = _own_part(less, more, changes)
    return share


def _own_part(less: Field, more: Field, changes: Mask) -> Field:
    """Of cells that touch at one end only, with the pressure `more`: their p² over its growth."""
    touched, largest = less > 0, np.max(more)
    p, grown = more / largest, (more / largest) ** 2 - (less / largest) ** 2
    if np.any(touched):
        growth = _at_nearest(grown, touched & ~binary_erosion(touched), changes)
    else:
        growth = np.ones(np.count_nonzero(changes))
    own = p[changes] ** 2
    return np.divide(own, growth, out=np.ones_like(own), where=own < growth)


def _at_nearest(values: Field, known: Mask, wanted: Mask) -> Field:
    """The mean of the values at the known cells that are nearest to each wanted one (wanted,)."""
    from scipy.spatial import KDTree  # as long to import as a small contact takes

    tree = KDTree(np.argwhere(known))
    distance, which = tree.query(np.argwhere(wanted), k=EQUALLY_FAR)
    nearest = distance < distance[:, :1] * (1 + 1e-9)
    # Where fewer are known than asked for, the tree names one behind the last, infinitely far.
    found = np.where(nearest, np.append(values[known], 0.0)[which], 0.0)
    return np.asarray(np.sum(found, axis=1) / np.count_nonzero(nearest, axis=1))
