"""Semismooth Newton method for a coupled increment, on the natural map of contact and friction."""

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.solver_errors import NotConverged
from contact_solver.admissible_shear import magnitude
from contact_solver.coupled_problem import (
    CoupledProblem,
    CoupledSolution,
)
from contact_solver.newton_iterate import ROUGH_REDUCTION, NewtonIterate
from contact_solver.residuals import complementarity, penetration, slip_direction

MAX_STEPS = 40
# Successive steps that may reduce residual and merit by less than 10 %.
MAX_IDLE = 3
# Smallest residual of a linear solve over the tolerance: the rest is left to its non-linear terms.
FINE = 0.3
# Round-off of a displacement in units of its own rounding. Convolutions with 48 to 96 cells along a
# side were off by 1.0 to 1.4 units; the error grows with the logarithm of this number.
ROUNDINGS = 4


def solve_by_newton(
    problem: CoupledProblem,
    pressure: Field,
    shear: VectorField,
    motion: Vector,
    tolerance: float,
    furthest: float = np.inf,
) -> CoupledSolution:
    """Solve a coupled increment by the semismooth Newton method from an initial guess.

    problem                  operators, loads and friction law of the increment
    pressure, shear, motion  initial guesses: p (n,), q (2, n) and rigid tangential motion
    tolerance                limit of all dimensionless residuals
    furthest                 largest merit (relative error) of the first iterate, above which the
                             method is not tried
    raises                   NotConverged if the iteration stalls, the load reaches the friction
                             limit, or the first merit exceeds `furthest`
    """
    at = NewtonIterate(problem, np.concatenate([shear, pressure[None]]), motion)
    best, least, idle = np.inf, np.inf, 0
    for number in range(1, MAX_STEPS + 1):
        at.linearise()
        residual = _largest_residual(problem, at)
        if at.is_admissible and residual <= tolerance:
            in_slip = at.natural.slip & (at.natural.bound > 0)
            q, p = at.point.tractions[:2], at.point.tractions[2]
            return CoupledSolution(
                p, q, at.closing, at.natural.motion, in_slip, False, at.iterations, number
            )
        if number == 1 and at.natural.merit > furthest:
            break
        idle = 0 if residual < 0.9 * best or at.merit < 0.9 * least else idle + 1
        best, least = min(best, residual), min(least, at.merit)
        if idle >= MAX_IDLE:
            break
        rough = at.rough_reduction
        depth = min(rough, at.natural.merit) if at.settled else rough
        at.step(min(ROUGH_REDUCTION, max(depth, FINE * tolerance / residual)))
    raise NotConverged("the coupled increment", at.iterations, best, tolerance)


def _largest_residual(problem: CoupledProblem, at: NewtonIterate) -> float:
    """Return the largest dimensionless residual of an iterate of Newton's method.

    The residuals are those of contact conditions, friction law and slip direction. The tractions of
    the iterate must be admissible (non-negative pressure, shear within friction, prescribed
    forces).

    problem  operators, loads and friction law of the increment
    at       iterate
    """
    point, natural = at.point, at.natural
    if not at.is_admissible:
        return natural.merit
    q, p = point.tractions[:2], point.tractions[2]
    overlap = problem.pressing.overlap(at.closing)
    # In full stick the surface may not move; the displacement by the shear of a point is then the
    # scale of slip. In a single point only the surface around the point moves: take the maximum.
    moved = np.maximum(np.abs(point.displacements[:2]), problem.self_compliance * np.abs(q))
    if not np.any(natural.slip & (natural.bound > 0)):
        moved = np.full_like(moved, np.max(moved))
    measures = (
        complementarity(p, natural.gap, overlap),
        penetration(natural.gap, overlap),
        natural.shear_error - _shear_rounding(problem, at),
        slip_direction(q, natural.bound, natural.slipped, moved),
    )
    return float(np.max(measures))  # keeps a NaN


def _shear_rounding(problem: CoupledProblem, at: NewtonIterate) -> float:
    """Return the error of the shear by the round-off of displacements, which the natural map
    multiplies by γ. It is comparable to the friction limit for little friction on a stiff film."""
    moved = np.sum(magnitude(at.point.displacements[:2]) * at.natural.contact)
    rounding = ROUNDINGS * np.finfo(np.float64).eps * problem.gamma * moved
    return float(rounding / np.sum(at.natural.bound))
