"""Slip and the stick zone of a contact that grows or shrinks within an increment."""

from __future__ import annotations

import numpy as np

from contact_scene.array_types import Array


def touched(r: Array, begun: float, radius: float) -> Array:
    """Return the fraction of an increment in which points at these radii are in contact.

    Particles that a growing contact reaches slip from the passage of the edge on.

    begun, radius  of the contact at start and end of the increment [length]
    """
    share = np.ones_like(r)
    if radius > begun:
        share = np.clip((radius - r) / (radius - begun), 0.0, 1.0)
        share[r <= begun] = 1.0
    return share


def front(radius: float, begun: float, through: float, first: float, before: float) -> float:
    """Return the stick radius at the end of an increment [length].

    The disc that sticks throughout an increment is that of its middle. The radius half an increment
    later is extrapolated linearly from this disc and the preceding one. After a load reversal it is
    the radius of this disc.

    through, before  of the discs that stick throughout this and the preceding increment [length]
    first, begun     radius of the contact at the start of the preceding and of this one [length]
    """
    half, last = 0.5 * (radius - begun), 0.5 * (begun - first)
    if half * last <= 0:
        return through
    return min(max(through + (through - before) * half / (half + last), 0.0), radius)
