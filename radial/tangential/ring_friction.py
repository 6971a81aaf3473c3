"""Pressure and shear of one increment under Coulomb's law at points (r, θ), by semismooth Newton.

The laws apply to means over the hat function of every node,

    p = max(p - g/d, 0),    q = P(q - Δs/d),

with the gap g, the slip Δs of the increment, the compliance d of the point, and P the projection
onto vectors not longer than µ max(p - g/d, 0) (Alart and Curnier 1991). Each Newton step has fixed
active sets: open points have no traction, and points that slip along w satisfy w·q = µp and the
linearised law across w.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space
from scipy.optimize import minimize

from contact_scene import CoulombFriction
from contact_scene.array_types import Array
from contact_scene.friction_limit import reaches_limit, refuse_above_limit
from contact_scene.solver_errors import ContactAtZoneEdge, NotConverged, motion_undefined
from radial.tangential.ring_laws import (
    ContactLaws,
    NewtonIterate,
)
from radial.tangential.ring_newton import newton_iterate
from radial.tangential.ring_points import ContactPoints
from radial.tangential.ring_state import (
    NORMAL,
    TORSION,
    Loads,
    PointState,
    resultant_loads,
)

MAX_STEPS = 60
DIGITS = 1e-9  # tolerance of the limit load
SHORTEST = 2.0**-6  # least fraction of a Newton step in the line search
# Largest change of the rigid motion in a Newton step, over the largest slip plus µ times the
# approach.
FURTHEST = 4.0
# A point whose shear is below its friction limit by less than this multiple of the largest limit
# counts as slipping: it begins to slip, or slipped before. The tolerance of Newton's method is 100
# times smaller.
TIE = 1e-9
# Slip in gross slip over the approach. The direction of the shear deviates from that of the rigid
# motion by less than the inverse of this number, which is below every tolerance.
FAR = 1e13
AT_ONCE = 12  # number of first Newton steps without line search, which find the slip zone sooner


def solve_increment(
    points: ContactPoints,
    friction: CoulombFriction,
    loads: Loads,
    before: PointState | None,
    tolerance: float,
    smooth: Array | None = None,
    free: Array | None = None,
) -> PointState:
    """Solve contact and friction at points on rings at the end of an increment of the loads.

    The unknowns are the pressure and the shear of all points, and the rigid motion of the indenter.
    The method is semismooth Newton with a line search.

    points     points of the contact (rings × angles) and their compliance matrix
    friction   friction law
    loads      prescribed loads and rigid motions at the end of the increment
    before     state at the start of the increment; None before first contact
    tolerance  bound of the residual relative to the largest pressure, friction limit and loads
    smooth     tractions and rigid motion of a similar contact, as the first initial guess
               (3 N + 4,) for N points; None if unknown
    free       free motion of points until their contact, times areas (2 N,); None without
    raises     NotConverged; GrossSliding if the tangential force exceeds the friction limit, if
               tangential force and torque reach the limit load of the contact without them, or
               below the limit after an increment at it; ContactAtZoneEdge if the contact reaches
               the last ring
    """
    force, W = float(np.hypot(*_prescribed_shear_loads(loads)[:2])), loads.forces[NORMAL]
    most = None if W is None else friction.largest_tangential_force(W)
    laws = ContactLaws.of(points, friction, loads, before, free)
    if force and most is not None and reaches_limit(force, most):
        refuse_above_limit(force, 0.0, most / force)
        if not loads.forces[TORSION]:
            return _gross_slip(laws, before, tolerance, smooth, _prescribed_shear_loads(loads))
    if before is not None and before.slides:
        raise motion_undefined()
    for x in _initial_guesses(laws, before, tolerance, smooth):
        at, step = _iterate(laws, x, tolerance)
        if at.worst <= tolerance:
            return _end_state(laws, at, before, step)
    if np.any(_prescribed_shear_loads(loads)):
        sliding = _gross_slip_motion(points, friction, loads, before, tolerance)
        if sliding is not None:
            return _gross_slip(laws, before, tolerance, smooth, sliding)
    raise NotConverged("contact and friction on rings", MAX_STEPS, at.worst, tolerance)


def _iterate(laws: ContactLaws, x: Array, tolerance: float) -> tuple[NewtonIterate, int]:
    """Apply Newton's method from an initial guess, until its residual meets the tolerance.

    Return the last iterate, which may exceed the tolerance, and the number of Newton steps.

    laws       contact and friction laws of the increment
    x          initial guess of tractions and rigid motion (3 N + 4,) for N points
    tolerance  bound of the residual
    """
    at = laws.evaluate(x, laws.points.compliance @ x[:-4])
    for step in range(MAX_STEPS):
        if at.worst <= tolerance:
            return at, step
        # An iteration with a singular system diverges to infinite numbers.
        with np.errstate(over="ignore", invalid="ignore"):
            aim = newton_iterate(laws, at)
            if aim is None:
                break
            aim = _limit_motion(laws, at, aim)
            at = _line_search(laws, at, aim, SHORTEST if step >= AT_ONCE else 1.0)
    return at, MAX_STEPS


def _gross_slip(
    laws: ContactLaws,
    before: PointState | None,
    tolerance: float,
    smooth: Array | None,
    sliding: Array,
) -> PointState:
    """Solve the contact under tangential loads at the friction limit, with undefined motion.

    All points slip in a rigid motion. The slip is `FAR` times the approach, so that the
    displacements of the surfaces do not change its direction.

    laws       contact and friction laws of the increment
    before     state at the start of the increment; None before first contact
    tolerance  bound of the residual
    smooth     tractions and rigid motion of the frictionless contact (3 N + 4,); None if unknown
    sliding    rigid slip of any size: shifts along θ = 0 and across it, and twist (3,)
    raises     NotConverged
    """
    if before is not None:
        guess = np.append(before.tractions, before.motion)
    else:
        guess = laws.guess_closed_gap() if smooth is None else smooth
    speed = np.hypot(*sliding[:TORSION]) + laws.points.radii[-1] * abs(sliding[TORSION])
    away = np.append(-FAR * abs(guess[-1]) / speed * sliding, 0.0)
    held = laws.loads.hold_motion(np.zeros(NORMAL))
    free = replace(laws, loads=held, moved=np.zeros_like(laws.moved), motion=away)
    guess[-4:-1] = held.motions[:NORMAL]
    at, step = _iterate(free, guess, tolerance)
    if at.worst > tolerance:
        raise NotConverged("contact and friction on rings", step, at.worst, tolerance)
    end = _end_state(free, at, before, step)
    given = _prescribed_shear_loads(laws.loads)
    carried = resultant_loads(laws.points, end.tractions)[:NORMAL]
    share = min(1.0, float(given @ given / abs(carried @ given)))
    tractions = np.append(share * end.shear.ravel(), end.pressure)
    return replace(end, tractions=tractions, slides=True)


def _initial_guesses(
    laws: ContactLaws, before: PointState | None, tolerance: float, smooth: Array | None
) -> Iterator[Array]:
    """Yield initial guesses of tractions and rigid motion for Newton's method, the best first.

    The first guess is `smooth`. Before first contact the next is a state with closed gap. Later
    they are the extrapolated last increment, the state at the start of the increment, and a state
    solved with the rigid motion at the start. The last guess helps if all points slip during the
    iteration, because the motion under a prescribed force is then undetermined. A guess is an array
    (3 N + 4,) for N points.

    laws       contact and friction laws of the increment
    before     state at the start of the increment; None before first contact
    tolerance  bound of the residual of the state that is solved for the last guess
    smooth     tractions and rigid motion of a similar contact; None if unknown
    """
    if smooth is not None:
        yield smooth
    if before is None:
        yield laws.guess_closed_gap()
        return
    yield from laws.initial_guesses(before)
    if any(force is not None for force in laws.loads.forces[:NORMAL]):
        resting = laws.loads.hold_motion(before.motion)
        with suppress(NotConverged):
            state = solve_increment(laws.points, laws.friction, resting, before, tolerance)
            yield np.append(state.tractions, state.motion)


def _prescribed_shear_loads(loads: Loads) -> Array:
    """Return the prescribed tangential forces along and across θ = 0, and the torque (3,).

    θ is the angle about the axis of revolution. The units are force and force length. A component
    whose conjugate motion is prescribed is 0.

    loads  prescribed loads and rigid motions of the indenter
    """
    return np.array([force or 0.0 for force in loads.forces[:NORMAL]])


def _gross_slip_motion(
    points: ContactPoints,
    friction: CoulombFriction,
    loads: Loads,
    before: PointState | None,
    tolerance: float,
) -> Array | None:
    """Return the rigid slip under tangential loads at the limit load; None below the limit.

    The components are the shifts along θ = 0 and across it, and the twist (3,), of any size. Raise
    GrossSliding above the limit.

    At the limit load all points slip. The limit load is computed with the friction limit µp of the
    contact without tangential force and torque. Called after Newton's method has failed, because no
    equilibrium exists above the limit load.

    points     points of the contact (rings × angles)
    friction   friction law
    loads      prescribed loads and rigid motions
    before     state at the start of the increment; None before first contact
    tolerance  bound of the residual of the contact without tangential force and torque
    """
    normal_contact = solve_increment(points, friction, loads.drop_shear_loads, before, tolerance)
    given = _prescribed_shear_loads(loads)
    limit = friction.limit(np.maximum(normal_contact.pressure, 0.0))
    free = np.array([force is not None for force in loads.forces[:NORMAL]])
    times, sliding = limit_load(points, limit, given, free)
    force, torque = float(np.hypot(*given[:2])), abs(given[TORSION])
    refuse_above_limit(force, torque, times)
    return sliding if reaches_limit(1.0, times) else None


def _limit_motion(laws: ContactLaws, at: NewtonIterate, aim: Array) -> Array:
    """Shorten a Newton step whose change of the rigid motion is too large for the current iterate.

    If nearly all points slip, the Newton step under a prescribed force grows without bound. The
    largest change is a multiple of the sum of the largest slip of the increment and µ times the
    approach. The function returns the tractions and motion after the shortened step (3 N + 4,).

    laws  contact and friction laws of the increment
    at    current iterate
    aim   tractions and rigid motion after the whole Newton step (3 N + 4,) for N points
    """
    points, inside = laws.points, at.z > 0
    prescribed = np.array([force is not None for force in laws.loads.forces[:NORMAL]])
    if not np.any(prescribed) or not np.any(inside):
        return aim
    further = np.where(prescribed, aim[-4:-1] - at.x[-4:-1], 0.0)
    edge = points.radii[int(np.max(np.flatnonzero(inside))) // points.count]
    distance = np.hypot(*further[:TORSION]) + edge * abs(further[TORSION])
    slip = np.max(
        np.hypot(*laws.slip_increment(at.u, at.x[-4:]).reshape(2, -1)) / points.areas * inside
    )
    reach = FURTHEST * (slip + laws.friction.largest * abs(at.x[-1]))
    return aim if distance <= reach else at.x + reach / distance * (aim - at.x)


def _line_search(
    laws: ContactLaws, at: NewtonIterate, aim: Array, shortest: float
) -> NewtonIterate:
    """Reduce a Newton step by halves until the residual of the contact laws decreases.

    The function returns the new iterate. It also stops at the shortest step.

    laws      contact and friction laws of the increment
    at        current iterate
    aim       tractions and rigid motion after the whole Newton step (3 N + 4,) for N points
    shortest  least fraction of the Newton step; 1 switches the line search off
    """
    moved = laws.points.compliance @ aim[:-4]
    size, length = np.linalg.norm(at.residual), 1.0
    trial = laws.evaluate(aim, moved)
    while trial.worst >= at.worst and np.linalg.norm(trial.residual) >= size and length > shortest:
        length /= 2
        trial = laws.evaluate(at.x + length * (aim - at.x), at.u + length * (moved - at.u))
    return trial


def _end_state(
    laws: ContactLaws, at: NewtonIterate, before: PointState | None, steps: int
) -> PointState:
    """Create the contact state at the end of an increment from the converged Newton iterate.

    The function determines the sticking points: their trial shear is below the friction limit.

    laws    contact and friction laws of the increment
    at      converged iterate
    before  state at the start of the increment; None before first contact
    steps   number of Newton steps of the solve
    raises  ContactAtZoneEdge if the contact reaches the last ring
    """
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
    return PointState(
        t, at.u[: 2 * size], laws.slip_increment(at.u, motion), motion, changed, share,
        0.5 * float(t @ at.u), at.worst, steps,
    )  # fmt: skip


def limit_load(
    points: ContactPoints, limit: Array, given: Array, free: NDArray[np.bool_]
) -> tuple[float, Array]:
    """Compute the factor on given tangential force and torque at which gross slip begins [1].

    The second result is the rigid slip: shifts along θ = 0 and across it, and twist (3,).

    At gross slip all points slip in a rigid motion. The factor is the least dissipation of a rigid
    slip on which the given loads do unit work (upper bound theorem of limit analysis; Goyal, Ruina
    and Papadopoulos 1991).

    points  points of the contact (rings × angles)
    limit   friction limit µp at the points (N,) [force/length²]
    given   tangential force along θ = 0 and across it, and torque, not all zero (3,)
    free    true for rigid motions (two shifts and twist) that are not prescribed (3,)
    """
    free = free & np.any(points.rigid_motions, axis=1)
    # Scale the twist by its displacement at the last ring, so that all motions have equal units.
    units = np.array([1.0, 1.0, 1 / points.radii[-1]])[free]
    loads, motions = units * given[free], units[:, None] * points.rigid_motions[free]
    loads_size = np.linalg.norm(loads)
    across = null_space(loads[None])

    def rigid_slip(part: Array) -> Array:
        """Return the free components of a rigid slip on which the given loads do unit work.

        part  components of the rigid slip on which the loads do no work
        """
        return loads / loads_size**2 + across @ part / loads_size

    def rigid_slip_work(part: Array) -> float:
        """Return the dissipation of a rigid slip on which the given loads do unit work [1].

        Minimised over all rigid slips, the dissipation is the factor of the limit load.

        part  components of the rigid slip on which the loads do no work
        """
        return float(limit @ np.hypot(*(rigid_slip(part) @ motions).reshape(2, -1)))

    least = np.zeros(across.shape[1])
    if len(least):
        options = {"xatol": DIGITS, "fatol": DIGITS}
        least = minimize(rigid_slip_work, least, method="Nelder-Mead", options=options).x
    sliding = np.zeros(NORMAL)
    sliding[free] = units * rigid_slip(least)
    return rigid_slip_work(least), sliding
