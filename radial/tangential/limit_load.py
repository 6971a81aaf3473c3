"""Limit load of a contact under tangential force and torque."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space
from scipy.optimize import minimize

from contact_scene.array_types import Array
from radial.tangential.ring_points import Points

DIGITS = 1e-9


def limit_load_factor(points: Points, limit: Array, given: Array, free: NDArray[np.bool_]) -> float:
    """Return the factor of the given loads at gross slip.

    It is the least dissipation of a rigid slip on which the given loads do unit work (upper bound
    theorem; Goyal, Ruina and Papadopoulos 1991).

    limit  µp at the points (N,)
    given  T along and across, and M, not all zero (3,)
    free   true for motions that are not prescribed (3,)
    """
    free = free & np.any(points.rigid_motions, axis=1)
    # Scale the twist by its displacement at the last ring, so that all motions have equal units.
    units = np.array([1.0, 1.0, 1 / points.radii[-1]])[free]
    loads, motions = units * given[free], units[:, None] * points.rigid_motions[free]
    loads_size = np.linalg.norm(loads)
    across = null_space(loads[None])

    def dissipated(part: Array) -> float:
        motion = loads / loads_size**2 + across @ part / loads_size
        return float(limit @ np.hypot(*(motion @ motions).reshape(2, -1)))

    start = np.zeros(across.shape[1])
    if not len(start):
        return dissipated(start)
    found = minimize(
        dissipated, start, method="Nelder-Mead", options={"xatol": DIGITS, "fatol": DIGITS}
    )
    return float(found.fun)
