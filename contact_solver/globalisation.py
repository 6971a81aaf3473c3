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
from contact_solver.alternating_iteration import alternate, solve_gross_slip
from contact_solver.coupled_problem import (
    CoupledProblem,
    CoupledSolution,
)
from contact_solver.newton_increment import solve_by_newton
from contact_solver.proximal_point import solve_on_springs

Method = Callable[[CoupledProblem, Field, VectorField, Vector, float], CoupledSolution]

# Number of turns of the alternating iteration before Newton's method is tried again. Beyond them
# (strong friction, films much stiffer than their base) the proximal-point method is faster.
TURNS = 3
# Merit above which Newton's method does not start from zero shear: strong friction would suppress
# the displacement by the pressure. Below it one alternating iteration costs more than it saves.
FAR = 1.0


def solve_together(
    problem: CoupledProblem, pressure: Field, shear: VectorField, motion: Vector, tolerance: float
) -> CoupledSolution:
    """Solve a coupled increment by the first of several methods that converges.

    Newton's method converges fast from nearly correct zones of contact, stick and slip, and may
    stall otherwise. On failure the next method starts from the same initial guess.

    problem                  operators, loads and friction law of the increment
    pressure, shear, motion  initial guesses: p (n,), q (2, n) and rigid tangential motion
    tolerance                limit of the dimensionless residuals
    raises                   NotConverged
    """
    turned = partial(_turns_then_newton, turns=TURNS)
    methods: tuple[Method, ...] = (solve_by_newton, turned, solve_on_springs)
    if problem.exhausts_friction(problem.friction_limit(problem.loaded(pressure))):
        methods = (solve_gross_slip, turned)
    elif not np.any(shear):
        near = partial(solve_by_newton, furthest=FAR)
        methods = (near, partial(_turns_then_newton, turns=1), *methods[1:])
    return _first_converged(methods, problem, pressure, shear, motion, tolerance)


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


def _turns_then_newton(
    problem: CoupledProblem,
    pressure: Field,
    shear: VectorField,
    motion: Vector,
    tolerance: float,
    *,
    turns: int,
) -> CoupledSolution:
    """Solve by Newton's method, or gross slip if the loads
    are at the friction limit, from a few alternating turns."""
    pressure, shear, motion, spent = alternate(problem, pressure, shear, motion, tolerance, turns)
    slides = problem.exhausts_friction(problem.friction_limit(pressure))
    method: Method = solve_gross_slip if slides else solve_by_newton
    return _first_converged(
        (method,), problem, pressure, shear, motion, tolerance, spent=(spent, turns)
    )
