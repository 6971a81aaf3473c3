"""How much of loads friction carries until all slides."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space
from scipy.optimize import minimize

from contact_scene.array_types import Array
from radial.tangential.ring_points import Points

DIGITS = 1e-9


def carried_times(points: Points, limit: Array, given: Array, free: NDArray[np.bool_]) -> float:
    """By what the given loads are multiplied when all slides: the least that a rigid slip on which
    they do unit work loses to friction (upper bound theorem; Goyal, Ruina and Papadopoulos 1991).

    limit  µp at the points (N,)
    given  T along and across, and M, not all zero (3,)
    free   which of the motions they go with is not prescribed (3,)
    """
    free = free & np.any(points.ways, axis=1)
    # A turn as what it moves at the last ring, so that all are alike.
    units = np.array([1.0, 1.0, 1 / points.radii[-1]])[free]
    loads, ways = units * given[free], units[:, None] * points.ways[free]
    loads_size = np.linalg.norm(loads)
    across = null_space(loads[None])

    def lost(part: Array) -> float:
        motion = loads / loads_size**2 + across @ part / loads_size
        return float(limit @ np.hypot(*(motion @ ways).reshape(2, -1)))

    start = np.zeros(across.shape[1])
    if not len(start):
        return lost(start)
    found = minimize(lost, start, method="Nelder-Mead", options={"xatol": DIGITS, "fatol": DIGITS})
    return float(found.fun)
