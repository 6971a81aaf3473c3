"""Pressure that closes the gap in given cells.

With its edge inside the cells a contact is where the edge says, and what is left is linear: no cell
comes or goes while it is solved.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semi_analytical.normal import close_gap
from semi_analytical.normal_load import Map, Motion, NormalLoad

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]


class Closed(NamedTuple):
    """Pressure (nx, ny), the gap that it leaves (nx, ny) and the motion of the load."""

    pressure: Field
    gap: Field
    motion: Motion


def closed(
    displace: Map,
    precondition: Map,
    gap: Field,
    load: NormalLoad,
    contact: Mask,
    start: Field,
    beside: Field,
    enough: float,
) -> Closed:
    """By conjugate gradients, until the part `enough` of what is not closed is left.

    gap      without the pressure (nx, ny) [length]
    load     that the cells of the contact carry
    contact  cells whose gap closes (nx, ny)
    start    a first pressure, not zero in all of them
    beside   pressure of other cells, which stays (nx, ny)
    """
    p = load.admissible(np.where(contact, start, 0.0))
    u = displace(p + beside)
    h = np.where(contact, gap, 0.0)  # without what is infinite
    motion = load.motion(p, u + h)
    projected = load.projection(contact.astype(np.float64))
    g = u + h - load.closure(motion)
    p, u, _ = close_gap(displace, precondition, projected, p, u, g, enough)
    motion = load.motion(p, u + h)
    return Closed(np.maximum(p, 0.0) + beside, u + gap - load.closure(motion), motion)
