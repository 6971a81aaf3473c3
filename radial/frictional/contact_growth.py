"""Slip and the stick zone of a contact that grows or shrinks within an increment."""

from __future__ import annotations

import numpy as np

from contact_scene.array_types import Array


def contact_fraction(r: Array, start_radius: float, radius: float) -> Array:
    """Return the fraction of an increment in which points at these radii are in contact.

    Particles that a growing contact reaches slip from the passage of the edge on.

    start_radius, radius  of the contact at start and end of the increment [length]
    """
    share = np.ones_like(r)
    if radius > start_radius:
        share = np.clip((radius - r) / (radius - start_radius), 0.0, 1.0)
        share[r <= start_radius] = 1.0
    return share


def front(
    radius: float, start_radius: float, stick_through: float, first: float, before: float
) -> float:
    """Return the stick radius at the end of an increment [length].

    The disc that sticks throughout an increment is that of its middle. The radius half an increment
    later is extrapolated linearly from this disc and the preceding one. After a load reversal it is
    the radius of this disc.

    stick_through, before  of the discs that stick throughout this and the preceding increment
                           [length]
    first, start_radius    radius of the contact at the start of the preceding and of this one
                           [length]
    """
    half, last = 0.5 * (radius - start_radius), 0.5 * (start_radius - first)
    if half * last <= 0:
        return stick_through
    return min(max(stick_through + (stick_through - before) * half / (half + last), 0.0), radius)
