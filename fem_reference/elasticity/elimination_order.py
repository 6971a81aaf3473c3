"""In which order the unknowns of a mesh are eliminated: nested dissection, by where elements lie.

A section is cut in two along a line of nodes, the halves again, and so on. The nodes of a cut are
eliminated after both halves, which they separate: no fill between the halves (George 1973, SIAM
Journal on Numerical Analysis 10, 345-363).
"""

import numpy as np
from numpy.typing import NDArray

Indices = NDArray[np.int64]

LEAF = 4
"""Elements that are not cut further."""


def elimination_keys(points: NDArray[np.float64], quads: Indices, elements: Indices) -> Indices:
    """(2, n) sort keys of the nodes, the second the more important one.

    points, quads  corners (2, k) and elements (4, e)
    elements       (e, 9) nodes of the elements
    """
    leaf = _leaves(points, quads)
    count = int(elements.max()) + 1
    first, last = np.full(count, leaf.max()), np.zeros(count, dtype=np.int64)
    np.minimum.at(first, elements, leaf[:, None])
    np.maximum.at(last, elements, leaf[:, None])
    # Leaves are numbered so that a subtree is what agrees in the leading bits. The node belongs to
    # the cut of the smallest subtree with all its elements, and comes after that subtree's leaves.
    height = np.frexp((first ^ last).astype(np.float64))[1].astype(np.int64)
    end = ((last >> height) + 1) << height
    return np.stack([height, end])


def _leaves(points: NDArray[np.float64], quads: Indices) -> Indices:
    """(e,) number of the leaf of every element, by repeated halving of all subtrees at once."""
    corners = points[:, quads]
    low, high = corners.min(axis=1), corners.max(axis=1)
    middle = 0.5 * (low + high)
    depth = max(0, int(np.ceil(np.log2(quads.shape[1] / LEAF))))
    leaf = np.zeros(quads.shape[1], dtype=np.int64)
    outwards = np.argsort(middle, axis=1)
    for level in reversed(range(depth)):
        _, group, size = np.unique(leaf, return_inverse=True, return_counts=True)
        median_at = np.cumsum(size) - size + size // 2
        below, price = [], []
        for a, by_place in enumerate(outwards):
            by_group = by_place[np.argsort(group[by_place], kind="stable")]
            median = middle[a, by_group[median_at]][group]
            below.append(middle[a] < median)
            cut = np.bincount(group, (low[a] < median) & (high[a] >= median))
            unequal = np.abs(2 * np.bincount(group, below[a]) - size) / size
            price.append(cut * (1.0 + unequal) + size * (unequal == 1.0))
        # Across the axis along which fewer elements stand in the way of the cut.
        side = np.where((price[0] <= price[1])[group], *below)
        leaf += (~side & (size > 1)[group]) * (1 << level)
    return leaf
