"""Slip, stick area, energies and residuals of an increment of a contact at points."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from contact_scene import CoulombFriction
from contact_scene.array_types import Array
from contact_scene.friction import sliding_friction
from contact_scene.quantities.residuals import Residuals
from contact_scene.quantities.summary import ContactStatus
from radial.angular_grid import Circle
from radial.frictional.contact_growth import (
    front,
    touched,
)
from radial.tangential.ring_points import Points
from radial.tangential.ring_state import (
    ABOUT,
    ACROSS,
    ALONG,
    DOWN,
    Held,
    Loads,
)

REST = 1e-11  # of the approach: less slip is round-off


@dataclass(frozen=True)
class Pushed:
    """Contact at the end of an increment. Forces and motions have the order of `Loads`.

    held       tractions and motion
    circle     angles of a ring
    asked      prescribed loads
    radius     of the circle of equal contact area; without friction if the rings do not resolve the
               contact [length]
    begun      contact radius at the start of the increment [length]
    through    radius of the circle of the area that sticks in the increment; None if unresolved
               [length]
    stuck      radius of the circle of the stick area at the end; None if unresolved [length]
    slip       since first contact of the particles (2, points) [length]
    carried    loads of the tractions
    worked     work of the loads since the start of the history [force length]
    lost       energy dissipated since the start of the history [force length]
    uncertain  uncertainty of `lost` by finite increments [force length]
    """

    held: Held
    circle: Circle
    asked: Loads
    radius: float
    begun: float
    through: float | None
    stuck: float | None
    slip: Array
    carried: Array
    worked: float
    lost: float
    uncertain: float

    @property
    def forces(self) -> tuple[float, ...]:
        """Prescribed or computed loads [force, force length]."""
        return _either(self.asked.forces, self.carried)

    @property
    def motions(self) -> tuple[float, ...]:
        """Prescribed or computed motions [length, radian]."""
        return _either(self.asked.motions, self.held.motion)

    @property
    def status(self) -> ContactStatus:
        """Full stick, partial slip or gross slip; partial slip if the rings do not resolve it."""
        share = self.held.share[np.isfinite(self.held.share)]
        if np.all(share <= 1):
            return ContactStatus.FULL_STICK
        if np.any(share <= 1) or self.stuck is None or self.stuck > 0:
            return ContactStatus.PARTIAL_SLIP
        slides = any(motion is not None for motion in self.asked.motions[:DOWN])
        return ContactStatus.GROSS_SLIDING if slides else ContactStatus.NO_STICK_AREA_LEFT


def _either(asked: tuple[float | None, ...], found: Array) -> tuple[float, ...]:
    return tuple(
        float(came) if value is None else value for value, came in zip(asked, found, strict=True)
    )


def pushed(
    points: Points, friction: CoulombFriction, end: Held, last: Held | None, slip: Array,
    asked: Loads, before: Pushed | None, smooth: float | None,
) -> Pushed:  # fmt: skip
    """Compute slip, stick area and energies of an increment.

    last, slip  tractions and motion at its start, and slip until then, at the points
    before      contact at its start
    smooth      radius without friction if the rings do not resolve the contact, else None [length]
    """
    areas, nothing = points.areas, np.zeros(len(points.areas))
    radius = sqrt(points.contact_area(end.pressure) / pi) if smooth is None else smooth
    begun = before.radius if before else 0.0
    share = touched(np.repeat(points.radii, points.count), begun, radius) * (end.pressure > 0)
    passed = -end.slipped.reshape(2, -1) / areas * share
    start = last.shear if last else np.zeros((2, len(nothing)))
    limits = (friction.limit(last.pressure) if last else nothing), friction.limit(end.pressure)
    rubbing = sliding_friction(start, end.shear, passed, *limits)
    carried, motion = end.forces(points), last.motion if last else np.zeros(4)
    both = carried + (before.carried if before else 0.0)
    through = None
    if smooth is None:
        area = points.stick_area(end.share, end.shear, limits[1])
        through = sqrt(min(area / pi, radius**2))
    turned = points.circle is not Circle.ONE or end.motion[ABOUT] != motion[ABOUT]
    stuck = through
    if not (turned or through is None or before is None or before.through is None):
        stuck = front(radius, begun, through, before.begun, before.through)
    open_ = np.hypot(*(end.shear - start)) * np.hypot(*passed)
    return Pushed(
        end, points.circle, asked, radius, begun, through, stuck, slip - passed, carried,
        (before.worked if before else 0.0) + 0.5 * float(both @ (end.motion - motion)),
        (before.lost if before else 0.0) + float(np.sum(rubbing * passed, axis=0) @ areas),
        (before.uncertain if before else 0.0) + float(open_ @ areas),
    )  # fmt: skip


def residuals_of(points: Points, friction: CoulombFriction, state: Pushed) -> Residuals:
    """Compute the residuals of a contact."""
    end, asked = state.held, state.asked.forces
    W, force = float(state.carried[DOWN]), asked[DOWN]
    limit = friction.limit(end.pressure)
    slipped = np.hypot(*end.slipped.reshape(2, -1))
    slips = (slipped > REST * end.approach * points.areas) & (end.pressure > 0)
    most = float(np.sum(limit * slipped, where=slips))
    against = float(np.sum(np.sum(end.shear * end.slipped.reshape(2, -1), axis=0), where=slips))
    drag = [
        state.carried[way] - value for way in (ALONG, ACROSS) if (value := asked[way]) is not None
    ]
    torque = asked[ABOUT]
    return Residuals(
        complementarity=end.missed,
        penetration=end.missed,
        normal_equilibrium=None if force is None else abs(W / force - 1),
        friction_cone=max(0.0, float(np.max(np.hypot(*end.shear) - limit)) / np.max(limit)),
        slip_direction=(most + against) / most if most > 0 else 0.0,
        tangential_equilibrium=float(np.linalg.norm(drag) / (points.areas @ limit))
        if drag
        else None,
        torque_equilibrium=None
        if torque is None
        else abs(float(state.carried[ABOUT]) - torque) / float(points.levers @ limit),
    )
