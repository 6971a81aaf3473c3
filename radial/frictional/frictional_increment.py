"""Slip, stick radius and energies of an increment of normal loading with friction."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np

from contact_scene import CoulombFriction
from contact_scene.array_types import Array
from radial.frictional.contact_growth import (
    front,
    touched,
)
from radial.frictional.stick_slip import Rubbed
from radial.normal.pressing import Target


@dataclass(frozen=True)
class FrictionalState:
    """Contact with friction at the end of an increment.

    end        the contact, with the slip of the increment
    target     prescribed normal force or approach
    slip       since first contact of two particles, at the output radii, which are equal in all
               increments: sticking particles keep their slip exactly [length]
    begun      contact radius at the start of the increment; 0 for the first one [length]
    middling   stick radius of the increment as a whole, which is that in its middle [length]
    front      stick radius at the end [length]
    worked     work of the load since the start of the history [force length]
    lost       energy dissipated since the start of the history [force length]
    uncertain  uncertainty of `lost` by finite increments [force length]
    power      exponent of the prescribed quantity as a power of the contact radius
    tried      number of contact radii
    strain     of the lower body since first contact, equal in all directions
    """

    end: Rubbed
    target: Target
    slip: Array
    begun: float
    middling: float
    front: float
    worked: float
    lost: float
    uncertain: float
    power: float
    tried: int
    strain: float

    @property
    def normal_force(self) -> float:
        """Prescribed or computed normal force [force]."""
        return self.end.load if self.target.force is None else self.target.force

    @property
    def approach(self) -> float:
        """Prescribed or computed approach [length]."""
        asked = self.target.approach
        return self.target.moved(self.end) if asked is None else asked

    def at(self, field: Array, r: Array) -> Array:
        """Interpolate a field of the nodes to radii r, zero outside of the contact."""
        return np.asarray(np.interp(r, self.end.radius * self.end.rings.x, field, right=0.0))


def sheared(
    friction: CoulombFriction,
    end: Rubbed,
    target: Target,
    radii: Array,
    before: FrictionalState | None,
    power: float,
    tried: int,
    strain: float,
) -> FrictionalState:
    """Compute slip, stick radius and energies of an increment.

    radii         of the output [length]
    power, tried  see `FrictionalState`
    """
    x, a = end.rings.x, end.radius
    begun, force, depth = 0.0, 0.0, 0.0
    if before is not None:
        begun, force, depth = before.end.radius, before.end.load, before.end.approach
    r, nothing = a * x, np.zeros_like(x)
    shear, limit = nothing, nothing
    if before is not None:
        shear = before.at(before.end.shear, r)
        limit = friction.limit(before.at(finite_pressure(before.end), r))
    slipped = touched(r, begun, a) * end.slipped * (end.sliding != 0)
    slip = np.interp(radii, r, slipped, right=0.0)
    if before is not None:
        slip += before.slip * (radii < a)
    rubbing = 0.5 * (limit + friction.limit(finite_pressure(end))) * np.abs(slipped)
    open_ = np.abs(end.shear - shear) * np.abs(slipped)
    stuck = middling = stick_share(end) * a
    if before is not None:
        stuck = front(a, begun, middling, before.begun, before.middling)
    # The strain displaces the lower body against its shear.
    more = strain - (before.strain if before else 0.0)
    work = 0.5 * (force + end.load) * (end.approach - depth)
    work -= 0.5 * more * end.over((shear + end.shear) * r)
    return FrictionalState(
        end, target, slip, begun, middling, stuck,
        (before.worked if before else 0.0) + work,
        (before.lost if before else 0.0) + end.over(rubbing),
        (before.uncertain if before else 0.0) + end.over(open_),
        power,
        tried,
        strain,
    )  # fmt: skip


def stick_share(end: Rubbed) -> float:
    """Return the radius of the circle of the stick area over the contact radius [1].

    Slip is proportional to the power 3/2 of the distance from the border of the stick zone.
    """
    x, slides = end.rings.x, end.sliding != 0
    slides[0] = False
    if not slides[1:-1].any():
        return 1.0
    rise = np.abs(end.slipped) ** (2 / 3)
    area, sign = 0.0, 1.0
    for i in np.flatnonzero(slides[1:] != slides[:-1]):
        near, next_ = (i + 1, i + 2) if slides[i + 1] else (i, i - 1)
        front = 0.5 * (x[i] + x[i + 1])
        if 0 < next_ < len(x) and slides[next_] and rise[next_] > rise[near]:
            slope = (x[next_] - x[near]) / (rise[next_] - rise[near])
            front = min(max(x[near] - rise[near] * slope, x[i]), x[i + 1])
        area, sign = area + sign * front**2, -sign
    return sqrt(max(area + (1.0 if sign > 0 else 0.0), 0.0))


def finite_pressure(end: Rubbed) -> Array:
    """Return the pressure, at an apex that of the next node."""
    p = end.pressure
    return p if np.isfinite(p[0]) else np.concatenate([p[1:2], p[1:]])
