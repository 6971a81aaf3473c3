"""Proximal-point method for a coupled increment (Rockafellar 1976).

Under strong friction (films with µ = 5) Newton's method stalls far from the solution. Each proximal
step solves the increment with displacements u + λ (t - t_k), with t_k the tractions of the last
step. A larger compliance λ keeps the tractions nearer to t_k. λ is divided by a factor while the
changes are small (as in pseudo-transient continuation, Kelley and Keyes 1998). The last solve has λ
= 0.
"""

from dataclasses import replace

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.solver_errors import NotConverged
from contact_solver.coupled_problem import (
    CoupledProblem,
    CoupledSolution,
)
from contact_solver.natural_map import Tractions
from contact_solver.newton_increment import solve_by_newton
from contact_solver.newton_iterate import NewtonIterate

MAX_PROXIMAL_STEPS = 60
# Sum over all GMRES solves; twice the largest number of a converging case of the stability map.
MAX_ITERATIONS = 4000
# Compliance over the self-compliance: initial value, factor of a change, largest value.
INITIAL_COMPLIANCE = 1.0
COMPLIANCE_FACTOR = 8.0
MAX_COMPLIANCE = 1e4
# Relative change of the tractions below which the compliance is reduced. A failed step multiplies
# this threshold by THRESHOLD_FACTOR, but not below NEAR. Below NEAR the solve is tried with λ = 0.
THRESHOLD = 0.1
THRESHOLD_FACTOR = 0.25
NEAR = 1e-2
# Reduction of the merit in a proximal step, and its limit of Newton steps.
INNER_REDUCTION = 1e-2
MAX_STEPS = 12
ROUND_OFF = 1e-12


def solve_on_springs(
    problem: CoupledProblem, pressure: Field, shear: VectorField, motion: Vector, tolerance: float
) -> CoupledSolution:
    """Solve a coupled increment by the proximal-point method from an initial guess.

    Each step solves the increment with an additional compliance λ of every cell, which acts like
    springs between the bodies and keeps the tractions near to those of the last step. λ is reduced
    while the changes are small. The final solve has λ = 0 and meets the tolerance.

    problem                  operators, loads and friction law of the increment
    pressure, shear, motion  initial guesses: p (n,), q (2, n) and rigid tangential motion
    tolerance                limit of the dimensionless residuals
    raises                   NotConverged
    """
    tractions = np.concatenate([shear, pressure[None]])
    compliance, threshold, iterations, residual = INITIAL_COMPLIANCE, THRESHOLD, 0, np.inf
    for number in range(1, MAX_PROXIMAL_STEPS + 1):
        if iterations > MAX_ITERATIONS:
            break
        regularised = problem.with_compliance(compliance * problem.self_compliance, tractions)
        try:
            found = _proximal_step(regularised, tractions, motion)
        except NotConverged as stalled:
            iterations += stalled.iterations
            compliance *= COMPLIANCE_FACTOR
            threshold = max(THRESHOLD_FACTOR * threshold, NEAR)
            if compliance > MAX_COMPLIANCE:
                break
            continue
        iterations += found.iterations
        last, tractions, motion = tractions, found.point.tractions, found.natural.motion
        change = np.sum(np.abs(tractions - last)) / np.sum(np.abs(tractions))
        if change < NEAR:
            try:
                solution = solve_by_newton(problem, tractions[2], tractions[:2], motion, tolerance)
            except NotConverged as stalled:
                iterations, residual = iterations + stalled.iterations, stalled.residual
            else:
                iterations += solution.iterations
                outer = number + solution.outer_iterations
                return replace(
                    solution,
                    iterations=iterations,
                    outer_iterations=outer,
                    algorithm="proximal point",
                )
        if change < threshold:
            compliance, threshold = compliance / COMPLIANCE_FACTOR, THRESHOLD
    raise NotConverged("the coupled increment", iterations, residual, tolerance)


def _proximal_step(problem: CoupledProblem, tractions: Tractions, motion: Vector) -> NewtonIterate:
    """Solve a coupled increment with an additional compliance approximately, by Newton's method.

    This solve is one step of the proximal-point method.

    problem    coupled problem with the additional compliance
    tractions  tractions of the last step (q_x, q_y, p), shape (3, n), used as initial guess
    motion     initial guess of the rigid tangential motion
    raises     NotConverged
    """
    at = NewtonIterate(problem, tractions.copy(), motion)
    at.linearise()
    target = max(INNER_REDUCTION * at.natural.merit, ROUND_OFF)
    for _ in range(MAX_STEPS):
        at.step(at.rough_reduction)
        at.linearise()
        if at.natural.merit <= target:
            return at
    raise NotConverged("the coupled increment", at.iterations, at.natural.merit, target)
