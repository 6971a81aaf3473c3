"""Surfaces that meet or part within an increment: for what part of it they are in contact."""

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]


def touching_share(
    radii: Field, apart_before: Mask, apart: Mask, edge_before: float, edge: float
) -> Field:
    """Part of an increment for which each ring is in contact.

    Particles slip past each other from their touch on and until they part. Where the edge of the
    contact passes a ring at r on its way from a₀ to a₁, they touch for |a - r|/|a₁ - a₀| of their
    motion, with a the larger of both: to first order in the increment, in which the motion follows
    the radius.

    radii                of the rings [length]
    apart_before, apart  rings with a gap at start and end
    edge_before, edge    a₀ and a₁ [length]; without contact 0
    """
    widest, way = max(edge_before, edge), abs(edge - edge_before)
    passed = apart_before != apart
    share = np.where(apart, 0.0, 1.0)
    if way > 0:
        share[passed] = np.clip((widest - radii[passed]) / way, 0.0, 1.0)
    return share
