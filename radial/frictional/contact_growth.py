"""Contact fraction and stick radius of an increment in which the contact grows or shrinks.

The contact area is a disc.
"""

from __future__ import annotations

import numpy as np

from contact_scene.array_types import Array


def contact_fraction(r: Array, start_radius: float, radius: float) -> Array:
    """Compute the fraction of an increment during which points are in contact (n,) [1].

    The contact radius changes linearly in the increment. In a growing contact, a point slips only
    after the contact edge has reached the point. The caller multiplies the slip of the increment by
    this fraction. The fraction is 1 in a shrinking contact.

    r                     radii of the points (n,) [length]
    start_radius, radius  contact radius at the start and at the end of the increment [length]
    """
    share = np.ones_like(r)
    if radius > start_radius:
        share = np.clip((radius - r) / (radius - start_radius), 0.0, 1.0)
        share[r <= start_radius] = 1.0
    return share


def extrapolate_stick_radius(
    radius: float, start_radius: float, stick_through: float, first: float, before: float
) -> float:
    """Extrapolate the stick radius to the end of an increment of the normal load [length].

    The solve of an increment gives only the radius of the zone that sticks throughout, which is the
    stick radius at the middle of the increment. The stick radius half an increment later is
    extrapolated linearly in the contact radius, from the middles of this and of the preceding
    increment. After a reversal of the load, the stick radius at the middle is returned.

    radius         contact radius at the end of this increment [length]
    start_radius   contact radius at the start of this increment [length]
    stick_through  radius of the zone that sticks throughout this increment [length]
    first          contact radius at the start of the preceding increment [length]
    before         radius of the zone that sticks throughout the preceding increment [length]
    """
    half, last = 0.5 * (radius - start_radius), 0.5 * (start_radius - first)
    if half * last <= 0:
        return stick_through
    return min(max(stick_through + (stick_through - before) * half / (half + last), 0.0), radius)
