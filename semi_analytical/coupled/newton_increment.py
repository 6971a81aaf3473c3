"""Pressure and shear of a coupled increment at once, by a semismooth Newton method."""

import numpy as np

from contact_scene.array_types import Vector
from contact_scene.quantities.residuals import worst
from contact_scene.solver_errors import NotConverged
from semi_analytical.coupled.coupled_problem import (
    CoupledProblem,
    CoupledSolution,
)
from semi_analytical.coupled.generalised_derivative import Tractions
from semi_analytical.coupled.newton_iterate import NewtonIterate
from semi_analytical.residuals import complementarity, penetration, slip_direction

MAX_STEPS = 40
# Steps without the residual falling by a tenth.
MAX_IDLE = 3
# Part of the rows that a solve leaves: at most, and while the zones still change.
ROUGHLY = 0.05
# Part of the tolerance that a solve need not go below, and part at which it stops short of a step.
FINE = 0.1


def solve_by_newton(
    problem: CoupledProblem,
    start: Tractions,
    motion: Vector,
    tolerance: float,
    furthest: float = np.inf,
) -> CoupledSolution:
    """From first tractions (3, nx, ny) and a first motion until all residuals meet the tolerance.

    furthest  part of all tractions by which the first may miss the natural map
    raises    NotConverged where it stalls, where the load exhausts the friction on the way, or
              where the first tractions miss by more
    """
    at = NewtonIterate(problem, start, motion)
    best, idle = np.inf, 0
    for number in range(1, MAX_STEPS + 1):
        at.linearise()
        residual = _residual(problem, at)
        if residual <= tolerance:
            in_slip = at.natural.slip & (at.natural.bound > 0)
            q, p = at.point.tractions[:2], at.point.tractions[2]
            return CoupledSolution(
                p, q, at.closing, at.natural.motion, in_slip, False, at.iterations, number
            )
        if number == 1 and at.natural.merit > furthest:
            break
        idle = 0 if residual < 0.9 * best else idle + 1
        best = min(best, residual)
        if idle >= MAX_IDLE:
            break
        depth = min(ROUGHLY, at.natural.merit) if at.settled else ROUGHLY
        at.step(min(ROUGHLY, max(depth, FINE * tolerance / residual)))
    raise NotConverged("the coupled increment", at.iterations, best, tolerance)


def _residual(problem: CoupledProblem, at: NewtonIterate) -> float:
    """The worst of all dimensionless residuals at admissible tractions."""
    point, natural = at.point, at.natural
    q, p = point.tractions[:2], point.tractions[2]
    allowed = np.isfinite(problem.gap)
    overlap = problem.normal_load.overlap(at.closing, problem.gap, allowed)
    # Where all sticks the surface may not move at all: of the shear, its own cells tell a scale.
    moved = np.maximum(np.abs(point.displacements[:2]), problem.self_compliance * np.abs(q))
    if not np.any(natural.slip & (natural.bound > 0)):  # a single cell: only the surface around it
        moved = np.full_like(moved, np.max(moved))
    return worst(
        complementarity(p, natural.gap, overlap),
        penetration(natural.gap, overlap),
        natural.sheared,
        slip_direction(q, natural.bound, natural.slipped, moved),
    )
