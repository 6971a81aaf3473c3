"""State of a contact with friction under a normal load at the end of an increment.

The module computes slip, stick radius and energies from the solved tractions.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np

from contact_scene import CoulombFriction
from contact_scene.array_types import Array
from radial.frictional.contact_growth import (
    contact_fraction,
    extrapolate_stick_radius,
)
from radial.frictional.stick_slip import FrictionalContact
from radial.normal.pressing import Target


@dataclass(frozen=True)
class FrictionalState:
    """State of a contact with friction under a normal load at the end of an increment.

    The next increment starts from this state.

    end               solved contact, with the slip of the increment
    target            prescribed normal force or approach
    slip              radial slip since first contact of two particles, at the output rings (n,)
                      [length]; the rings are equal in all increments, so sticking particles keep
                      their slip exactly
    start_radius      contact radius at the start of the increment; 0 for the first increment
                      [length]
    mid_stick_radius  radius of the zone that sticks throughout the increment, which is the stick
                      radius at its middle [length]
    front             stick radius at the end of the increment [length]
    work              work of the load since the start of the history [force length]
    dissipated        energy dissipated since the start of the history [force length]
    uncertainty       uncertainty of `dissipated` by finite increments [force length]
    power             exponent b of the local power law: force (or approach) ∝ contact radius to the
                      b
    iterations        number of contact radii tried
    strain            bulk strain of the lower body since first contact, equal in all directions [1]
    """

    end: FrictionalContact
    target: Target
    slip: Array
    start_radius: float
    mid_stick_radius: float
    front: float
    work: float
    dissipated: float
    uncertainty: float
    power: float
    iterations: int
    strain: float

    @property
    def normal_force(self) -> float:
        """Normal force on the indenter [force].

        The value is the prescribed force, or the computed force under a prescribed approach.
        """
        return self.end.load if self.target.force is None else self.target.force

    @property
    def approach(self) -> float:
        """Approach of the indenter since first contact, prescribed or computed [length].

        With a spring in the rig (test machine) the value is the approach of the far end of the
        spring.
        """
        prescribed = self.target.approach
        return self.target.actuator_approach(self.end) if prescribed is None else prescribed

    def interpolate_nodes(self, field: Array, r: Array) -> Array:
        """Interpolate a nodal field of this contact linearly to given radii (n,).

        Used because the contacts of successive increments have different nodes along the radius.
        The field is zero outside the contact.

        field  values at the nodes of this contact (nodes,)
        r      radii (n,) [length]
        """
        return np.asarray(np.interp(r, self.end.radius * self.end.rings.x, field, right=0.0))


def frictional_state(
    friction: CoulombFriction,
    end: FrictionalContact,
    target: Target,
    radii: Array,
    before: FrictionalState | None,
    power: float,
    iterations: int,
    strain: float,
) -> FrictionalState:
    """Compute slip, stick radius and energies at the end of an increment with friction.

    friction    friction law
    end         solved contact at the end of the increment
    target      prescribed normal force or approach
    radii       radii of the output rings (n,) [length]
    before      state at the start of the increment; None before first contact
    power       exponent b of the local power law: force (or approach) ∝ contact radius to the b
    iterations  number of contact radii tried
    strain      bulk strain of the lower body since first contact, equal in all directions [1]
    """
    x, a = end.rings.x, end.radius
    start_radius = 0.0
    force = 0.0
    depth = 0.0
    if before is not None:
        start_radius, force, depth = before.end.radius, before.end.load, before.end.approach
    r, nothing = a * x, np.zeros_like(x)
    shear, limit = nothing, nothing
    if before is not None:
        shear = before.interpolate_nodes(before.end.shear, r)
        limit = friction.limit(before.interpolate_nodes(finite_pressure(before.end), r))
    slip_increment = contact_fraction(r, start_radius, a) * end.slip_increment * (end.sliding != 0)
    slip = np.interp(radii, r, slip_increment, right=0.0)
    if before is not None:
        slip += before.slip * (radii < a)
    rubbing = 0.5 * (limit + friction.limit(finite_pressure(end))) * np.abs(slip_increment)
    open_ = np.abs(end.shear - shear) * np.abs(slip_increment)
    stick_radius = mid_stick_radius = stick_radius_ratio(end) * a
    if before is not None:
        stick_radius = extrapolate_stick_radius(
            a, start_radius, mid_stick_radius, before.start_radius, before.mid_stick_radius
        )
    # The bulk strain displaces the lower body against its shear, which changes the work.
    more = strain - (before.strain if before else 0.0)
    work = 0.5 * (force + end.load) * (end.approach - depth)
    work -= 0.5 * more * end.integrate_over_contact((shear + end.shear) * r)
    return FrictionalState(
        end,
        target,
        slip,
        start_radius,
        mid_stick_radius,
        stick_radius,
        (before.work if before else 0.0) + work,
        (before.dissipated if before else 0.0) + end.integrate_over_contact(rubbing),
        (before.uncertainty if before else 0.0) + end.integrate_over_contact(open_),
        power,
        iterations,
        strain,
    )


def stick_radius_ratio(end: FrictionalContact) -> float:
    """Compute the stick radius over the contact radius from the slip at the nodes [1].

    The stick radius is that of a circle with the area of the stick zone. Near the border of the
    stick zone, slip is proportional to the power 3/2 of the distance from the border. This law
    determines the position of the border between two nodes.

    end  solved contact at the end of the increment
    """
    x, slides = end.rings.x, end.sliding != 0
    slides[0] = False
    if not slides[1:-1].any():
        return 1.0
    rise = np.abs(end.slip_increment) ** (2 / 3)
    area, sign = 0.0, 1.0
    for i in np.flatnonzero(slides[1:] != slides[:-1]):
        near, next_ = (i + 1, i + 2) if slides[i + 1] else (i, i - 1)
        front = 0.5 * (x[i] + x[i + 1])
        if 0 < next_ < len(x) and slides[next_] and rise[next_] > rise[near]:
            slope = (x[next_] - x[near]) / (rise[next_] - rise[near])
            front = min(max(x[near] - rise[near] * slope, x[i]), x[i + 1])
        area, sign = area + sign * front**2, -sign
    return sqrt(max(area + (1.0 if sign > 0 else 0.0), 0.0))


def finite_pressure(end: FrictionalContact) -> Array:
    """Return the nodal pressure of a contact, with a finite value at the axis [force/length²].

    Below a tip the pressure at the axis is infinite. It is replaced by the pressure at the adjacent
    node. The shape is (n + 1,). Used for friction limits.

    end  solved contact
    """
    p = end.pressure
    return p if np.isfinite(p[0]) else np.concatenate([p[1:2], p[1:]])
