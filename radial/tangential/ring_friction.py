"""Pressure and shear of one increment under Coulomb's law at points (r, θ), by semismooth Newton.

The laws apply to means over the hat function of every node,

    p = max(p - g/d, 0),    q = P(q - Δs/d),

with P the projection onto vectors not longer than µ max(p - g/d, 0) (Alart and Curnier 1991). Each
Newton step has fixed active sets: open points have no traction, and points that slip along w
satisfy w·q = µp and the linearised law across w.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

import numpy as np

from contact_scene import CoulombFriction
from contact_scene.array_types import Array
from contact_scene.solver_errors import ContactAtZoneEdge, GrossSliding, NotConverged
from radial.tangential.limit_load import carried_times
from radial.tangential.ring_laws import (
    At,
    Laws,
)
from radial.tangential.ring_newton import aimed
from radial.tangential.ring_points import Points
from radial.tangential.ring_state import (
    ABOUT,
    DOWN,
    Held,
    Loads,
)

MAX_STEPS = 60
SHORTEST = 2.0**-6  # least fraction of a step of Newton's method
# largest change of rigid motion in a step, over the largest slip plus µ times the approach
FURTHEST = 4.0
# Difference to the limit over the largest limit, within which a point counts as slipping: it begins
# to slip, or slipped before. The tolerance of Newton's method is 100 times smaller.
TIE = 1e-9
AT_ONCE = 12  # first steps without line search: full steps find the slip zone sooner


def held(
    points: Points,
    friction: CoulombFriction,
    loads: Loads,
    before: Held | None,
    tolerance: float,
    smooth: Array | None = None,
) -> Held:
    """Solve the state under loads.

    before     state at the start of the increment; None before first contact
    tolerance  of the residual relative to the largest pressure, limit and loads
    smooth     tractions and motion without friction, as an initial guess; None if unknown
    raises     NotConverged; GrossSliding if T reaches the friction limit, or if T and M exceed the
               limit load of the contact without them; ContactAtZoneEdge at the last ring
    """
    drag, W = float(np.hypot(*_given(loads)[:2])), loads.forces[DOWN]
    most = None if W is None else friction.carried(W)
    if drag and most is not None and drag >= most:
        raise _slides(drag, most)
    laws = Laws.of(points, friction, loads, before)
    for x in _starts(laws, before, tolerance, smooth):
        at = laws.at(x, points.compliance @ x[:-4])
        for step in range(MAX_STEPS):
            if at.worst <= tolerance:
                return _ended(laws, at, before, step)
            # A singular iteration diverges to infinite numbers.
            with np.errstate(over="ignore", invalid="ignore"):
                aim = aimed(laws, at)
                if aim is None:
                    break
                aim = _within_reach(laws, at, aim)
                at = _nearer(laws, at, aim, SHORTEST if step >= AT_ONCE else 1.0)
    if np.any(_given(loads)):
        _refuse_sliding(points, friction, loads, before, tolerance)
    raise NotConverged("contact and friction on rings", MAX_STEPS, at.worst, tolerance)


def _starts(
    laws: Laws, before: Held | None, tolerance: float, smooth: Array | None
) -> Iterator[Array]:
    """Yield initial guesses: those of `Laws.starts`, then a state with the previous rigid motion.

    The last one helps if all points slip during the iteration, so that the motion is undetermined.
    """
    if before is None:
        if smooth is not None:
            yield smooth
        yield laws.closed()
        return
    yield from laws.starts(before)
    if any(force is not None for force in laws.loads.forces[:DOWN]):
        resting = laws.loads.resting(before.motion)
        with suppress(NotConverged):
            state = held(laws.points, laws.friction, resting, before, tolerance)
            yield np.append(state.tractions, state.motion)


def _given(loads: Loads) -> Array:
    """Return the prescribed T along and across, and M (3,); 0 for prescribed motions."""
    return np.array([force or 0.0 for force in loads.forces[:DOWN]])


def _refuse_sliding(
    points: Points, friction: CoulombFriction, loads: Loads, before: Held | None, tolerance: float
) -> None:
    """Raise GrossSliding if T and M exceed the limit load of the contact without them."""
    pressed = held(points, friction, loads.without_shear, before, tolerance)
    given = _given(loads)
    limit = friction.limit(np.maximum(pressed.pressure, 0.0))
    free = np.array([force is not None for force in loads.forces[:DOWN]])
    times = carried_times(points, limit, given, free)
    if times > 1:
        return
    drag, torque = float(np.hypot(*given[:2])), abs(given[ABOUT])
    if not torque:
        raise _slides(drag, times * drag)
    if not drag:
        raise GrossSliding(
            f"torque {torque:.6g} N m, but friction carries less than {times * torque:.6g} N m. "
            "Reduce it, or prescribe the twist"
        )
    raise GrossSliding(
        f"friction carries {times:.4g} times T = {drag:g} N with a torque of {torque:g} N m: "
        "the indenter slides and rotates. Reduce them, or prescribe shift and twist"
    )


def _within_reach(laws: Laws, at: At, aim: Array) -> Array:
    """Shorten the step of rigid motions to the range in which the slip zone is representative.

    If nearly all points slip, the step under a prescribed force grows without bound.
    """
    points, inside = laws.points, at.z > 0
    led = np.array([force is not None for force in laws.loads.forces[:DOWN]])
    if not np.any(led) or not np.any(inside):
        return aim
    further = np.where(led, aim[-4:-1] - at.x[-4:-1], 0.0)
    edge = points.radii[int(np.max(np.flatnonzero(inside))) // points.count]
    distance = np.hypot(*further[:ABOUT]) + edge * abs(further[ABOUT])
    slip = np.max(np.hypot(*laws.slipped(at.u, at.x[-4:]).reshape(2, -1)) / points.areas * inside)
    reach = FURTHEST * (slip + laws.friction.largest * abs(at.x[-1]))
    return aim if distance <= reach else at.x + reach / distance * (aim - at.x)


def _nearer(laws: Laws, at: At, aim: Array, shortest: float) -> At:
    """Halve the step until the residual decreases or the step is shortest."""
    moved = laws.points.compliance @ aim[:-4]
    size, length = np.linalg.norm(at.missed), 1.0
    tried = laws.at(aim, moved)
    while tried.worst >= at.worst and np.linalg.norm(tried.missed) >= size and length > shortest:
        length /= 2
        tried = laws.at(at.x + length * (aim - at.x), at.u + length * (moved - at.u))
    return tried


def _slides(drag: float, carried: float) -> GrossSliding:
    return GrossSliding(
        f"T = {drag:g} N is not below the friction limit {carried:g} N: the indenter slides. "
        "Reduce it, or prescribe the shift"
    )


def _ended(laws: Laws, at: At, before: Held | None, steps: int) -> Held:
    points, size = laws.points, len(at.z)
    if np.any(at.limit.reshape(-1, points.count)[-1] > 0):
        raise ContactAtZoneEdge(
            "the contact reaches the last ring; solve it with the semi-analytical solver"
        )
    inside = at.z > 0
    length = np.hypot(*at.y)
    bears = at.limit > 0
    share = np.where(bears, length / np.where(bears, at.limit, 1.0), np.where(inside, 1.0, np.inf))
    at_limit = bears & (length > at.limit - TIE * np.max(at.limit))
    share[at_limit] = np.maximum(share[at_limit], 1 + TIE)
    t, motion = at.x[:-4], at.x[-4:]
    changed = at.x - np.append(before.tractions, before.motion) if before else at.x
    return Held(
        t, at.u[: 2 * size], laws.slipped(at.u, motion), motion, changed, share,
        0.5 * float(t @ at.u), at.worst, steps,
    )  # fmt: skip
