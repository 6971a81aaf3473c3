"""Semismooth Newton method for the coupled pressure and shear of an increment.

The alternating iteration provides the initial guess. If this iteration diverges, as below thin
incompressible films and for µ|β| far above 1, Newton's method starts from the previous increment.
Here µ is the coefficient of friction and β Dundurs' second constant. The derivative is that of the
natural map on the current side of each kink. The method may cycle between kinks: see
`continuation`.
"""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask, Matrix, Vector
from contact_scene.solver_errors import NotConverged
from fem_reference.contact.alternating_iteration import (
    CoupledProblem,
    CoupledSolution,
    approach_of,
    solve_pressure,
)
from fem_reference.contact.natural_map import Equations, Iterate

MAX_STEPS = 200
MAX_HALVINGS = 7
REMEMBERED = 4  # number of last residuals; a step to less than their maximum is not shortened
SUFFICIENT = 1e-3


@dataclass(frozen=True)
class InitialGuess:
    """Initial guess for the solve of an increment: tractions and rigid motion of the indenter.

    pressure  pressure at the points (points,) [force/length^2]
    shear     shear at the points (2, points) [force/length^2]
    shift     shift [length] or twist [radian] of the indenter
    approach  rigid approach [length]
    """

    pressure: Vector
    shear: Field
    shift: float
    approach: float


@dataclass(frozen=True)
class Root:
    """Solution of the contact equations of an increment, found by Newton's method.

    The equations are the contact and friction laws at all points and the prescribed loads.

    at       iterate: tractions, rigid motion and spring compliance
    in_slip  True for slipping points (points,)
    solves   number of linear systems solved
    """

    at: Iterate
    in_slip: Mask
    solves: int


def solve_by_newton(
    problem: CoupledProblem, start: InitialGuess, tolerance: float
) -> CoupledSolution:
    """Solve the coupled pressure and shear of an increment by the semismooth Newton method.

    problem    compliance, gap, friction and prescribed loads of the increment
    start      initial guess of tractions and rigid motion
    tolerance  limit of the relative residual [1]: pressure residual over the normal load, plus
               shear residual over the friction limit, plus the errors of the prescribed loads
    raises     NotConverged
    """
    found = find_root(problem, start, tolerance)
    return Equations(problem).solution(found.at, found.in_slip, found.solves)


def find_root(
    problem: CoupledProblem, start: InitialGuess, tolerance: float, springs: float = 0.0
) -> Root:
    """Find a root of the contact equations of an increment by the semismooth Newton method.

    The equations are the contact and friction laws at all points and the prescribed loads. Springs
    between the surfaces are optional and serve the continuation.

    problem    compliance, gap, friction and prescribed loads of the increment
    start      initial guess of tractions and rigid motion
    tolerance  limit of the norm of the residual [1]
    springs    compliance of the springs [length^3/force]; zero without springs
    raises     NotConverged
    """
    misses: list[float] = []
    try:
        at, solves = _first_iterate(problem, start, springs)
        equations = Equations(problem)
        for step in range(MAX_STEPS):
            with np.errstate(over="ignore", invalid="ignore"):
                missed, jacobian, in_slip = equations.linearise(at)
            misses.append(equations.residual_norm(missed, at))
            if misses[-1] <= tolerance:
                return Root(at, in_slip, solves + step)
            change = _newton_step(jacobian[:, :-1], -missed)
            if not np.isfinite(change).all():
                break
            bound = (1 - SUFFICIENT) * max(misses[-REMEMBERED:])
            after = _search_along_step(equations, at, np.append(change, 0.0), bound)
            if after is None:
                break
            at = after
    except np.linalg.LinAlgError:
        pass
    raise NotConverged("the coupled increment", len(misses), min(misses, default=np.inf), tolerance)


def _newton_step(jacobian: Matrix, right: Vector) -> Vector:
    """Compute the Newton step of the contact equations of an increment: solve their linearisation.

    The step (3 points + 2,) is the change of all unknowns. Equations with one diagonal entry are
    solved first. They belong to points without contact, and to components that symmetry excludes.

    jacobian  generalised derivative of the equations (3 points + 2, 3 points + 2)
    right     negative residual (3 points + 2,)
    """
    diagonal = np.diagonal(jacobian)
    alone = (np.count_nonzero(jacobian, axis=1) == 1) & (diagonal != 0)
    change = np.divide(right, diagonal, out=np.zeros_like(right), where=alone)
    rest = np.flatnonzero(~alone)
    known = right[rest] - jacobian[rest] @ change
    change[rest] = np.linalg.solve(jacobian[np.ix_(rest, rest)], known)
    return change


def _first_iterate(
    problem: CoupledProblem, start: InitialGuess, springs: float
) -> tuple[Iterate, int]:
    """Create the first iterate of Newton's method from the initial guess of an increment.

    The iterate contains tractions, rigid motion and spring compliance. Return also the number of
    linear systems solved. If the guess has no pressure, the first iterate has the pressure of the
    frictionless contact, because Newton's step is undefined for separated bodies. Prescribed
    motions replace those of the guess.

    problem  compliance, gap, friction and prescribed loads of the increment
    start    initial guess of tractions and rigid motion
    springs  compliance of additional springs between the surfaces [length^3/force]
    """
    pressure, approach, solves = start.pressure, start.approach, 0
    if not np.any(pressure > 0):
        pressed = solve_pressure(problem, np.zeros_like(start.shear), pressure > 0)
        pressure, approach, solves = pressed.values, approach_of(problem, pressed), pressed.steps
    shifted, pressed_by = problem.tangential.motion, problem.normal.approach
    return Iterate(
        np.concatenate([start.shear.ravel(), pressure]),
        start.shift if shifted is None else shifted,
        approach if pressed_by is None else pressed_by,
        springs,
    ), solves


def _search_along_step(
    equations: Equations, at: Iterate, change: Vector, bound: float
) -> Iterate | None:
    """Search along a Newton step of the contact equations for an iterate with a smaller residual.

    The step is halved up to MAX_HALVINGS times. Return the first iterate whose residual norm is
    below the bound. If there is none, return the iterate with the smallest norm, because at a kink
    of the equations all steps may increase the norm. Return None if no norm is finite.

    equations  contact equations of the increment
    at         iterate at which the step starts
    change     Newton step of all unknowns (3 points + 3,)
    bound      limit of the residual norm [1]
    """
    nearest, least = None, np.inf
    for halvings in range(MAX_HALVINGS + 1):
        trial = Iterate.of(at.values + 0.5**halvings * change)
        with np.errstate(over="ignore", invalid="ignore"):
            miss = equations.residual_norm(equations.residual_vector(trial), trial)
        if miss < least:
            nearest, least = trial, miss
        if miss < bound:
            break
    return nearest
