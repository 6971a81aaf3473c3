"""Sequence of methods for a coupled increment, of which the first that converges is used.

Except in gross slip, Newton's method is tried first. The other methods converge from poorer initial
guesses.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.solver_errors import NotConverged
from contact_solver.alternating_iteration import (
    one_iteration,
    solve_coupled,
)
from contact_solver.coupled_problem import (
    CoupledProblem,
    CoupledSolution,
)
from contact_solver.newton_increment import solve_by_newton
from contact_solver.proximal_point import solve_on_springs

Method = Callable[[CoupledProblem, Field, VectorField, Vector, float], CoupledSolution]

# Residual at which the alternating iteration hands over to Newton's method, and its iteration
# limit. Beyond it (strong friction, films much stiffer than their base) the proximal-point method
# is faster or is the only one that converges.
NEAR, FEW_ITERATIONS = 1e-3, 250
# Merit above which Newton's method does not start from zero shear: strong friction would suppress
# the displacement by the pressure. Below it one alternating iteration costs more than it saves.
FAR = 1.0


def solve_together(
    problem: CoupledProblem, pressure: Field, shear: VectorField, motion: Vector, tolerance: float
) -> CoupledSolution:
    """Solve a coupled increment by the first of several methods that converges.

    Newton's method converges fast from nearly correct zones of contact, stick and slip, and may
    stall otherwise. On failure the next method starts from the same initial guess. Only the
    alternating iteration can return gross slip at the friction limit.

    problem                  operators, loads and friction law of the increment
    pressure, shear, motion  initial guesses: p (n,), q (2, n) and rigid tangential motion
    tolerance                limit of the dimensionless residuals
    raises                   NotConverged
    """
    methods: tuple[Method, ...] = (solve_by_newton, _alternating_then_newton, solve_on_springs)
    if _gross_slip(problem, pressure):
        methods = (_alternating_then_newton,)
    elif not np.any(shear):
        near = partial(solve_by_newton, furthest=FAR)
        methods = (near, _one_iteration_then_newton, *methods[1:])
    return _first_converged((*methods, solve_coupled), problem, pressure, shear, motion, tolerance)


def _first_converged(
    methods: Sequence[Method],
    problem: CoupledProblem,
    pressure: Field,
    shear: VectorField,
    motion: Vector,
    tolerance: float,
    spent: tuple[int, int] = (0, 0),
) -> CoupledSolution:
    """Return the solution of the first method that converges; raise NotConverged if none does.

    methods                  solvers of the coupled increment, in the order in which they are tried
    problem                  operators, loads and friction law of the increment
    pressure, shear, motion  initial guess of each method
    tolerance                limit of the dimensionless residuals
    spent                    iterations and outer iterations of the initial guess, included in the
                             counts of the solution
    """
    (iterations, outer), residual = spent, np.inf
    for method in methods:
        try:
            found = method(problem, pressure, shear, motion, tolerance)
        except NotConverged as stalled:
            iterations += stalled.iterations
            residual = stalled.residual
        except np.linalg.LinAlgError:  # of tractions that are no numbers
            continue
        else:
            return replace(
                found,
                iterations=iterations + found.iterations,
                outer_iterations=outer + found.outer_iterations,
            )
    raise NotConverged("the coupled increment", iterations, residual, tolerance)


def _gross_slip(problem: CoupledProblem, pressure: Field) -> bool:
    """Return True if the tangential load reaches the friction limit Σµp (gross slip).

    Only the alternating iteration can solve this case.

    problem   loads and friction law of the increment
    pressure  p (n,) [force/length^2]
    """
    return problem.exhausts_friction(problem.friction_limit(pressure))


def _one_iteration_then_newton(
    problem: CoupledProblem, pressure: Field, shear: VectorField, motion: Vector, tolerance: float
) -> CoupledSolution:
    """Solve a coupled increment by Newton's method from the result of one alternating iteration.

    The alternating iteration starts at the given pressure with zero shear. It solves the
    tangential, then the normal problem.
    """
    pressure, shear, motion, spent = one_iteration(problem, pressure, motion, tolerance)
    return _first_converged(
        (solve_by_newton,), problem, pressure, shear, motion, tolerance, spent=(spent, 1)
    )


def _alternating_then_newton(
    problem: CoupledProblem, pressure: Field, shear: VectorField, motion: Vector, tolerance: float
) -> CoupledSolution:
    """Solve a coupled increment by Newton's method from the result of a few alternating iterations.

    An alternating iteration solves the tangential, then the normal problem. If Newton's method
    fails, a few more alternating iterations follow. At gross slip the alternating iteration
    continues without this limit.
    """
    few = partial(solve_coupled, most_iterations=FEW_ITERATIONS)
    near = few(problem, pressure, shear, motion, max(NEAR, tolerance))
    methods = (solve_coupled,) if _gross_slip(problem, near.pressure) else (solve_by_newton, few)
    start, spent = (
        (near.pressure, near.shear, near.motion),
        (near.iterations, near.outer_iterations),
    )
    return _first_converged(methods, problem, *start, tolerance, spent=spent)
