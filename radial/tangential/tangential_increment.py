"""State of a contact with tangential load or torsion at the end of an increment.

The module computes slip, stick area, energies and residuals from the solved tractions at points
(rings × angles).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from contact_scene import CoulombFriction
from contact_scene.array_types import Array
from contact_scene.friction import sliding_friction
from contact_scene.friction_limit import SLIDING
from contact_scene.quantities.residuals import Residuals
from contact_scene.quantities.summary import ContactStatus
from contact_solver.residuals import (
    complementarity,
    equilibrium,
    friction_cone,
    penetration,
    slip_direction,
)
from radial.angular_grid import RingAngles
from radial.frictional.contact_growth import (
    contact_fraction,
    extrapolate_stick_radius,
)
from radial.tangential.ring_points import ContactPoints
from radial.tangential.ring_state import (
    NORMAL,
    TORSION,
    Loads,
    PointState,
    resultant_loads,
)

REST = 1e-11  # slip below this multiple of the approach is round-off


@dataclass(frozen=True)
class TangentialState:
    """State of a contact at N points on rings at the end of an increment, with slip and energies.

    The next increment starts from this state.

    end            solved tractions, rigid motion and slip of the increment
    circle         angles of the points on a ring: one angle, half a circle or the full circle
    prescribed     prescribed loads and rigid motions
    radius         radius of the circle of equal contact area [length]; that of the frictionless
                   contact if the rings do not resolve the contact
    start_radius   contact radius at the start of the increment [length]
    stick_through  radius of a circle with the area that sticks throughout the increment [length];
                   None if the rings do not resolve the contact
    stick_radius   radius of a circle with the stick area at the end [length]; None if the rings do
                   not resolve the contact
    slip           slip since first contact of the particles (2, N) [length]
    carried        resultants of the tractions: tangential force along θ = 0 and across it, torque,
                   normal force (4,)
    dissipated     energy dissipated since the start of the history [force length]; None after an
                   increment at the friction limit under force control, where the shift is undefined
    uncertainty    uncertainty of `dissipated` by finite increments [force length]
    slides         true if the tangential load reaches the friction limit
    """

    end: PointState
    circle: RingAngles
    prescribed: Loads
    radius: float
    start_radius: float
    stick_through: float | None
    stick_radius: float | None
    slip: Array
    carried: Array
    dissipated: float | None
    uncertainty: float
    slides: bool

    @property
    def forces(self) -> tuple[float, ...]:
        """Four loads on the indenter: prescribed, or computed from the tractions.

        They are the tangential forces along and across θ = 0 [force], the torque [force length] and
        the normal force [force].
        """
        return _prescribed_or_computed(self.prescribed.forces, self.carried)

    @property
    def motions(self) -> tuple[float, ...]:
        """Four rigid motions of the indenter: prescribed, or computed.

        They are the shifts along and across θ = 0 [length], the twist [radian] and the approach
        [length].
        """
        return _prescribed_or_computed(self.prescribed.motions, self.end.motion)

    @property
    def status(self) -> ContactStatus:
        """Contact status: full stick, partial slip, gross slip, or no stick area left.

        If points slip and the rings do not resolve the stick zone, the status is partial slip. If
        all points slip, the status is gross slip at the friction limit, otherwise no stick area
        left: a stick zone may be hidden within a ring.
        """
        if self.end.slides:
            return ContactStatus.GROSS_SLIDING
        share = self.end.share[np.isfinite(self.end.share)]
        if np.all(share <= 1):
            return ContactStatus.FULL_STICK
        if np.any(share <= 1) or self.stick_radius is None or self.stick_radius > 0:
            return ContactStatus.PARTIAL_SLIP
        return ContactStatus.GROSS_SLIDING if self.slides else ContactStatus.NO_STICK_AREA_LEFT


def _prescribed_or_computed(
    prescribed: tuple[float | None, ...], found: Array
) -> tuple[float, ...]:
    return tuple(
        float(came) if value is None else value
        for value, came in zip(prescribed, found, strict=True)
    )


def tangential_state(
    points: ContactPoints,
    friction: CoulombFriction,
    end: PointState,
    last: PointState | None,
    slip: Array,
    prescribed: Loads,
    before: TangentialState | None,
    smooth: float | None,
) -> TangentialState:
    """Compute slip, stick area and energies at the end of an increment from its solved tractions.

    points      points of the contact (rings × angles)
    friction    friction law
    end         solved tractions and rigid motion at the end of the increment
    last        tractions and rigid motion at the start of the increment; None before first contact
    slip        slip until the start of the increment, at the N points (2, N) [length]
    prescribed  prescribed loads and rigid motions
    before      state at the start of the increment; None before first contact
    smooth      radius of the frictionless contact if the rings do not resolve the contact, else
                None [length]
    """
    areas, nothing = points.areas, np.zeros(len(points.areas))
    radius = sqrt(points.contact_area(end.pressure) / pi) if smooth is None else smooth
    start_radius = before.radius if before else 0.0
    share = contact_fraction(np.repeat(points.radii, points.count), start_radius, radius) * (
        end.pressure > 0
    )
    slips = end.share > 1
    passed = np.zeros((2, len(areas)))
    if not end.slides:
        passed = -end.slip_increment.reshape(2, -1) / areas * np.where(slips, share, 0.0)
    start = last.shear if last else np.zeros((2, len(nothing)))
    limits = (friction.limit(last.pressure) if last else nothing), friction.limit(end.pressure)
    rubbing = sliding_friction(start, end.shear, passed, *limits)
    forces, motion = resultant_loads(points, end.tractions), last.motion if last else np.zeros(4)
    stick_through = None
    if end.slides:
        stick_through = 0.0
    elif smooth is None:
        area = points.stick_area(end.share, end.shear, limits[1])
        all_stick = not np.any(slips & (end.pressure > 0))
        stick_through = radius if all_stick else sqrt(min(area / pi, radius**2))
    turned = (
        end.slides or points.circle is not RingAngles.ONE or end.motion[TORSION] != motion[TORSION]
    )
    stick_radius = stick_through
    if not (turned or stick_through is None or before is None or before.stick_through is None):
        stick_radius = extrapolate_stick_radius(
            radius, start_radius, stick_through, before.start_radius, before.stick_through
        )
    dissipated = before.dissipated if before else 0.0
    if end.slides or dissipated is None:
        dissipated = None
    else:
        dissipated += float(np.sum(rubbing * passed, axis=0) @ areas)
    open_ = np.hypot(*(end.shear - start)) * np.hypot(*passed)
    return TangentialState(
        end,
        points.circle,
        prescribed,
        radius,
        start_radius,
        stick_through,
        stick_radius,
        slip - passed,
        forces,
        dissipated,
        (before.uncertainty if before else 0.0) + float(open_ @ areas),
        end.slides or _reaches_limit(points, end.motion - motion, forces, limits[1]),
    )


def _reaches_limit(points: ContactPoints, moved: Array, forces: Array, limit: Array) -> bool:
    """Return true if the resultants `forces` (4,) of the tractions do as much work on the rigid
    motion `moved` (4,) of an increment as friction at its limit (N,)."""
    everywhere = (moved[:NORMAL] @ points.rigid_motions).reshape(2, -1)
    work, power = moved[:NORMAL] @ forces[:NORMAL], limit @ np.hypot(*everywhere)
    return bool(power > 0 and work >= power * (1 - SLIDING))


def residuals_of(
    points: ContactPoints, friction: CoulombFriction, state: TangentialState
) -> Residuals:
    """Compute the residuals of contact, friction and equilibrium at the end of an increment [1].

    The solver of load steps compares each residual with the tolerance.

    points    points of the contact (rings × angles), with areas and levers
    friction  friction law
    state     solved state of tractions, slip and loads
    """
    end, prescribed = state.end, state.prescribed.forces
    W, force = float(state.carried[NORMAL]), prescribed[NORMAL]
    limit = friction.limit(end.pressure)
    slip = -end.slip_increment.reshape(2, -1) / points.areas
    moving = points.areas * (np.hypot(*slip) > REST * end.approach)
    pushing, turning = equilibrium(
        state.carried[:NORMAL],
        prescribed[:NORMAL],
        (float(points.areas @ limit), float(points.levers @ limit)),
    )
    return Residuals(
        complementarity=complementarity(points.areas * end.pressure, end.gap, end.approach),
        penetration=penetration(end.gap, end.approach),
        normal_equilibrium=None if force is None else abs(W / force - 1),
        friction_cone=friction_cone(end.shear, limit),
        slip_direction=None
        if end.slides
        else slip_direction(moving * end.shear, moving * limit, slip, slip),
        tangential_equilibrium=pushing,
        torque_equilibrium=turning,
    )
