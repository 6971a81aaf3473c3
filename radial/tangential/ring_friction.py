"""Pressure and shear of one increment under Coulomb's law at points (r, θ).

The laws of contact and friction apply to means over the hat function of every node. The package
`contact_solver` solves them (see `ring_problem`).
"""

from __future__ import annotations

import numpy as np

from contact_scene import CoulombFriction
from contact_scene.array_types import Array
from contact_scene.friction_limit import reaches_limit, refuse_above_limit
from contact_scene.solver_errors import ContactAtZoneEdge, NotConverged, motion_undefined
from contact_solver.coupled_problem import CoupledSolution
from contact_solver.globalisation import solve_together
from contact_solver.gross_slip import limit_load
from contact_solver.newton_increment import solve_by_newton
from radial.tangential.ring_points import ContactPoints
from radial.tangential.ring_problem import RingProblem
from radial.tangential.ring_state import (
    NORMAL,
    TORSION,
    Loads,
    PointState,
)

# Largest tolerance of the solver. With exact inverses the last Newton step has an error far below
# that of the increment.
ACCURATE = 1e-11
# Least tolerance of the solver: residuals by round-off are about 1e-13.
ROUND_OFF = 1e-12
# A point whose shear is below its friction limit by less than this multiple of the largest limit
# counts as slipping: it begins to slip, or slipped before. The tolerance of the solver is 100 times
# smaller.
TIE = 1e-9


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

    points     points of the contact (rings × angles) and their compliance
    friction   friction law
    loads      prescribed loads and rigid motions at the end of the increment
    before     state at the start of the increment; None before first contact
    tolerance  limit of the dimensionless residuals
    smooth     tractions and rigid motion of a similar contact, as the first initial guess
               (3 N + 4,) for N points; None if unknown
    free       free motion of points until their contact, times areas (2 N,); None without
    raises     NotConverged; GrossSliding if friction cannot carry tangential force and torque, or
               below the limit after an increment at it; ContactAtZoneEdge if the contact reaches
               the last ring
    """
    problem = RingProblem.of(points, friction, loads, before, free)
    at_limit = _force_reaches_limit(friction, loads)
    if before is not None and before.slides and not at_limit:
        raise motion_undefined()
    guesses = [] if smooth is None else [smooth]
    guesses += [problem.guess_closed_gap()] if before is None else problem.initial_guesses(before)
    if at_limit:
        guesses = guesses[-1:]
    aim = min(max(tolerance, ROUND_OFF), ACCURATE)
    methods = [*((solve_by_newton, x) for x in guesses[:-1]), (solve_together, guesses[-1])]
    steps = 0
    for method, x in methods:
        try:
            found = method(problem.coupled, *problem.start(x), aim)
        except NotConverged as error:
            steps, stalled = steps + max(error.iterations, 1), error
        else:
            return _end_state(problem, found, before, steps + found.outer_iterations)
    raise NotConverged("contact and friction on rings", steps, stalled.residual, tolerance)


def _force_reaches_limit(friction: CoulombFriction, loads: Loads) -> bool:
    """Return True for a force at the friction limit; raise GrossSliding above the limit."""
    force, W = float(np.hypot(*_prescribed_shear_loads(loads)[:2])), loads.forces[NORMAL]
    most = None if W is None else friction.largest_tangential_force(W)
    if not force or most is None or not reaches_limit(force, most):
        return False
    refuse_above_limit(force, 0.0, most / force)
    return not loads.forces[TORSION]


def _prescribed_shear_loads(loads: Loads) -> Array:
    """Return forces along and across θ = 0, and torque (3,); 0 where the motion is prescribed."""
    return np.array([force or 0.0 for force in loads.forces[:NORMAL]])


def _end_state(
    problem: RingProblem, found: CoupledSolution, before: PointState | None, steps: int
) -> PointState:
    """Create the contact state at the end of an increment from its solution.

    The function determines the sticking points: their trial shear is below the friction limit.

    problem  contact problem of the increment
    found    its solution
    before   state at the start of the increment; None before first contact
    steps    number of iterations of the solve
    raises   ContactAtZoneEdge if the contact reaches the last ring; GrossSliding if friction cannot
             carry the loads
    """
    points, size = problem.points, len(problem.points.areas)
    x = problem.reached(found)
    t, motion, p = x[:-4], x[-4:], x[2 * size : 3 * size]
    if np.any(p[-points.count :] > 0):
        raise ContactAtZoneEdge(
            "the contact reaches the last ring; solve it with the semi-analytical solver"
        )
    slides = found.at_limit and bool(np.any(_prescribed_shear_loads(problem.loads)))
    if slides:
        force, across, torque = _prescribed_shear_loads(problem.loads)
        shifting = problem.coupled.shifting.held
        times, _ = limit_load(shifting, problem.coupled.friction_limit(found.pressure))
        refuse_above_limit(float(np.hypot(force, across)), abs(torque), times)
    u = points.operator(t)
    slip = np.zeros(2 * size) if slides else problem.slip_increment(u, motion)
    gap = (u[2 * size :] + points.gap_areas) / points.areas - motion[NORMAL]
    limit = problem.friction.limit(p)
    q, passed = t[: 2 * size].reshape(2, -1), slip.reshape(2, -1)
    length = np.hypot(*(q - passed / points.tangential_compliance))
    share = np.where(p > 0, length / np.where(limit > 0, limit, 1.0), np.inf)
    at_limit = (p > 0) & (length > limit - TIE * np.max(limit))
    share[at_limit] = np.maximum(share[at_limit], 1 + TIE)
    changed = x - np.append(before.tractions, before.motion) if before else x
    return PointState(
        t, u[: 2 * size], slip, motion, changed, share, 0.5 * float(t @ u), gap, steps, slides
    )
