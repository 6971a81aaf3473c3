"""A coupled increment, solved by Newton's method; from nearer by where it stalls."""

from dataclasses import replace

import numpy as np

from contact_scene.solver_errors import NotConverged
from semi_analytical.admissible_shear import Field, Vector, VectorField
from semi_analytical.alternation import solve_coupled
from semi_analytical.coupled_problem import CoupledProblem, CoupledSolution
from semi_analytical.newton_increment import solve_by_newton

# Residual to which the alternation comes nearer before the second attempt. Where that stalls too,
# as below films much stiffer than their base, the alternation goes on to the end.
NEARER = 1e-3


def solve_together(
    problem: CoupledProblem, pressure: Field, shear: VectorField, motion: Vector, tolerance: float
) -> CoupledSolution:
    """Pressure and shear of an increment from first ones and a first motion.

    Newton's method converges fast once the zones are nearly right, and may stall before; the
    alternation comes nearer from farther away. It also finds the state in which all slips, at the
    limit of friction.
    raises  NotConverged
    """
    p, q, rounds, iterations = pressure, shear, 0, 0
    for nearer in (NEARER, tolerance):
        if not problem.tangential_load.exhausts(problem.friction_limit(p)):
            try:
                found = solve_by_newton(problem, np.concatenate([q, p[None]]), motion, tolerance)
                break
            except NotConverged as stalled:
                iterations += stalled.iterations
        found = solve_coupled(problem, p, q, motion, max(nearer, tolerance))
        p, q, motion = found.pressure, found.shear, found.motion
        rounds, iterations = rounds + found.rounds, iterations + found.iterations
    else:
        return replace(found, rounds=rounds, iterations=iterations)
    return replace(found, rounds=rounds + found.rounds, iterations=iterations + found.iterations)
