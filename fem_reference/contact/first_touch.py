"""Surfaces that meet within an increment: for what part of it they are in contact."""

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]


def touching_share(radii: Field, apart: Mask, edge_before: float, edge: float) -> Field:
    """Part of an increment for which each ring is in contact, of those that are at its end.

    Particles slip past each other from their touch on. Where the edge of the contact passes a ring
    at r on its way from a₀ to a₁, the last (a₁ - r)/(a₁ - a₀) of their motion is slip: to first
    order in the increment, in which the motion follows the radius.

    radii              of the rings [length]
    apart              rings with a gap before the increment
    edge_before, edge  a₀ and a₁ [length]; without contact 0
    """
    grown = edge - edge_before
    if grown <= 0:
        return np.ones_like(radii)
    return np.where(apart, np.clip((edge - radii) / grown, 0.0, 1.0), 1.0)
