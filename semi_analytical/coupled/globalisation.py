"""A coupled increment by Newton's method, and by ways to it from farther away."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.solver_errors import NotConverged
from semi_analytical.coupled.alternating_iteration import (
    one_round,
    solve_coupled,
)
from semi_analytical.coupled.coupled_problem import (
    CoupledProblem,
    CoupledSolution,
)
from semi_analytical.coupled.newton_increment import solve_by_newton
from semi_analytical.coupled.proximal_point import solve_on_springs

Way = Callable[[CoupledProblem, Field, VectorField, Vector, float], CoupledSolution]

# Residual to which the alternation comes nearer, and iterations in which it does so, or ends: where
# it takes more, as under strong friction or below films much stiffer than their base, springs lead
# there sooner or at all.
NEARER, FEW = 1e-3, 250
# Without shear first tractions that miss by more than all of them are nothing for Newton's method
# to start from: strong friction holds what pressure would drag along. From nearer ones a round of
# the alternation saves it less than the round takes.
FAR = 1.0


def solve_together(
    problem: CoupledProblem, pressure: Field, shear: VectorField, motion: Vector, tolerance: float
) -> CoupledSolution:
    """Pressure and shear of an increment from first ones and a first motion.

    Newton's method converges fast once the zones are nearly right, and may stall before. The
    alternation also finds the state in which all slips, at the limit of friction.
    raises  NotConverged
    """
    start, iterations = (pressure, shear, motion), 0
    ways: tuple[Way, ...] = (_by_newton, _from_nearer, solve_on_springs)
    if _all_slips(problem, pressure):
        ways = (_from_nearer,)
    elif not np.any(shear):
        ways = (partial(_by_newton, furthest=FAR), _after_a_round, *ways[1:])
    for way in ways:
        try:
            found = way(problem, *start, tolerance)
        except NotConverged as stalled:
            iterations += stalled.iterations
        else:
            return replace(found, iterations=iterations + found.iterations)
    found = solve_coupled(problem, *start, tolerance)
    return replace(found, iterations=iterations + found.iterations)


def _all_slips(problem: CoupledProblem, pressure: Field) -> bool:
    """Whether the load exhausts the friction under a pressure: Newton's method has no use then."""
    return problem.tangential_load.exhausts(problem.friction_limit(pressure))


def _after_a_round(
    problem: CoupledProblem, pressure: Field, shear: VectorField, motion: Vector, tolerance: float
) -> CoupledSolution:
    """By Newton's method from the first shear that comes with a pressure."""
    pressure, shear, motion, iterations = one_round(problem, pressure, motion, tolerance)
    try:
        found = _by_newton(problem, pressure, shear, motion, tolerance)
    except NotConverged as stalled:
        raise NotConverged(
            "the coupled increment", iterations + stalled.iterations, np.inf, tolerance
        ) from stalled
    return replace(found, rounds=found.rounds + 1, iterations=iterations + found.iterations)


def _by_newton(
    problem: CoupledProblem,
    pressure: Field,
    shear: VectorField,
    motion: Vector,
    tolerance: float,
    furthest: float = np.inf,
) -> CoupledSolution:
    """Newton's method from there; `furthest` see `solve_by_newton`."""
    tractions = np.concatenate([shear, pressure[None]])
    return solve_by_newton(problem, tractions, motion, tolerance, furthest)


def _from_nearer(
    problem: CoupledProblem, pressure: Field, shear: VectorField, motion: Vector, tolerance: float
) -> CoupledSolution:
    """From where a little of the alternation leads, by Newton's method or by a little more of it;
    by all of it where all slips."""
    shortly = partial(solve_coupled, most_iterations=FEW)
    near = shortly(problem, pressure, shear, motion, max(NEARER, tolerance))
    iterations = near.iterations
    ways: tuple[Way, ...] = (_by_newton, shortly)
    for way in (solve_coupled,) if _all_slips(problem, near.pressure) else ways:
        try:
            found = way(problem, near.pressure, near.shear, near.motion, tolerance)
        except NotConverged as stalled:
            iterations += stalled.iterations
        else:
            rounds = near.rounds + found.rounds
            return replace(found, rounds=rounds, iterations=iterations + found.iterations)
    raise NotConverged("the coupled increment", iterations, np.inf, tolerance)
