"""A coupled increment from far away, on springs between the bodies.

Where friction is strong, as below films with µ = 5, an increment linearised in its zones says
little of other zones, and from far away neither whole steps of Newton's method come nearer nor
parts of them. On springs in every cell, at rest at the tractions so far, the tractions of the
increment are nearer, the softer the springs. Where each answer is, the next springs are at rest;
they are made stiffer while the answers change little, and are left out in the end: the proximal
point method (Rockafellar 1976), with steps in pseudo-time that grow (Kelley and Keyes 1998).
"""

from dataclasses import dataclass, replace

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.solver_errors import NotConverged
from semi_analytical.coupled.coupled_problem import (
    CoupledProblem,
    CoupledSolution,
)
from semi_analytical.coupled.generalised_derivative import Tractions
from semi_analytical.coupled.newton_increment import (
    ROUGHLY,
    solve_by_newton,
)
from semi_analytical.coupled.newton_iterate import NewtonIterate

MAX_SPRINGS = 60
# Of GMRES in all. A cell of the stability map that converges takes half as many at most.
MAX_ITERATIONS = 4000
# Over the self-compliance: the first springs, what is softer by one step, and what is too soft to
# help.
FIRST, SOFTER, SOFTEST = 1.0, 8.0, 1e4
# Part of the tractions that change on springs: below it the next ones are stiffer; a part of it
# once stiffer ones have failed, but not below that at which they are left out.
NEARER, LESS, NEAR = 0.1, 0.25, 1e-2
# Part to which the merit of the first linearised increment on springs is to fall, in so many steps.
INNER_REDUCTION, MAX_STEPS = 1e-2, 12
ROUND_OFF = 1e-12


def solve_on_springs(
    problem: CoupledProblem, pressure: Field, shear: VectorField, motion: Vector, tolerance: float
) -> CoupledSolution:
    """From first pressure, shear and motion until all residuals meet the tolerance without springs.

    raises  NotConverged
    """
    rest = _Rest(np.concatenate([shear, pressure[None]]), motion)
    compliance, nearer, iterations, residual = FIRST, NEARER, 0, np.inf
    for number in range(1, MAX_SPRINGS + 1):
        if iterations > MAX_ITERATIONS:
            break
        on_springs = problem.yielding(compliance * problem.self_compliance, rest.tractions)
        try:
            found = _near_rest(on_springs, rest)
        except NotConverged as stalled:
            iterations += stalled.iterations
            compliance, nearer = SOFTER * compliance, max(LESS * nearer, NEAR)
            if compliance > SOFTEST:
                break
            continue
        iterations += found.iterations
        changed = found.change_from(rest)
        rest = found
        if changed < NEAR:
            try:
                solution = solve_by_newton(problem, rest.tractions.copy(), rest.motion, tolerance)
            except NotConverged as stalled:
                iterations, residual = iterations + stalled.iterations, stalled.residual
            else:
                iterations += solution.iterations
                return replace(solution, iterations=iterations, rounds=number + solution.rounds)
        if changed < nearer:
            compliance, nearer = compliance / SOFTER, NEARER
    raise NotConverged("the coupled increment", iterations, residual, tolerance)


@dataclass(frozen=True)
class _Rest:
    """Tractions (3, nx, ny) at which springs are at rest, motion of the load, and what it took to
    find them."""

    tractions: Tractions
    motion: Vector
    iterations: int = 0

    def change_from(self, other: "_Rest") -> float:
        """Part of these tractions that the other ones are not [1]."""
        change = np.sum(np.abs(self.tractions - other.tractions))
        return float(change / np.sum(np.abs(self.tractions)))


def _near_rest(problem: CoupledProblem, rest: _Rest) -> _Rest:
    """The tractions of an increment on springs, roughly, from where these are at rest."""
    at = NewtonIterate(problem, rest.tractions.copy(), rest.motion)
    at.linearise()
    enough = max(INNER_REDUCTION * at.natural.merit, ROUND_OFF)
    for _ in range(MAX_STEPS):
        at.step(ROUGHLY)
        at.linearise()
        if at.natural.merit <= enough:
            return _Rest(at.point.tractions, at.natural.motion, at.iterations)
    raise NotConverged("the coupled increment", at.iterations, at.natural.merit, enough)
