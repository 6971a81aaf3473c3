"""Pressure and shear of a coupled increment at once, by a semismooth Newton method.

Each step reads the zones of contact, stick and slip off the natural map, solves the increment
linearised in them by GMRES, and goes to the answer or part of the way. The motion of the indenter
that decides on stick and slip is never that of the linearised increment, which may empty the stick
zone, but that of the exact projection.
"""

from collections.abc import Iterator

import numpy as np

from contact_scene.residuals import worst
from contact_scene.solver_errors import NotConverged
from semi_analytical.admissible_shear import Vector
from semi_analytical.coupled_problem import CoupledProblem, CoupledSolution
from semi_analytical.generalised_derivative import Natural, Point, Tractions, Zones
from semi_analytical.linearised_increment import LinearisedIncrement, Step
from semi_analytical.normal_load import Motion
from semi_analytical.residuals import complementarity, penetration, slip_direction

MOST_STEPS = 40
# Steps without the residual falling by a tenth.
MOST_IDLE = 3
# Part of the rows that a solve leaves: at most, and while the zones still change.
ROUGHLY = 0.05
# Of the root of the number of cells in contact: at most so many change once the zones settle.
SETTLED = 0.1
# Part of the tolerance that a solve need not go below, and part at which it stops short of a step.
FINE = 0.1
HALVES = 0.5 ** np.arange(5)


def solve_by_newton(
    problem: CoupledProblem, start: Tractions, motion: Vector, tolerance: float
) -> CoupledSolution:
    """From first tractions (3, nx, ny) and a first motion until all residuals meet the tolerance.

    raises  NotConverged where it stalls, or where the load exhausts the friction on the way
    """
    load = problem.normal_load
    start[2] = load.admissible(np.where(np.isfinite(problem.gap), start[2], 0.0))
    point, _ = _at(problem, start, motion)
    natural = _natural(problem, point)
    zones: Zones | None = None
    increment: LinearisedIncrement | None = None
    best, idle, iterations = np.inf, 0, 0
    for number in range(1, MOST_STEPS + 1):
        found = Zones.of(natural, problem)
        settled = found.changes(zones) <= SETTLED * np.sqrt(np.sum(found.contact))
        carriers = increment.carriers_in(found) if increment and settled else None
        zones, increment = found, None  # both increments at once would be more
        increment = LinearisedIncrement(problem, zones, carriers)
        point, closing = _at(problem, increment.admissible(point.tractions), natural.motion)
        natural = _natural(problem, point)
        residual = _residual(problem, point, natural, closing)
        if residual <= tolerance:
            in_slip = natural.slip & (natural.bound > 0)
            q, p, w = point.tractions[:2], point.tractions[2], natural.motion
            return CoupledSolution(p, q, closing, w, in_slip, False, iterations, number)
        idle = 0 if residual < 0.9 * best else idle + 1
        best = min(best, residual)
        if idle >= MOST_IDLE:
            break
        merit = natural.merit
        depth = min(ROUGHLY, merit) if settled else ROUGHLY
        depth = min(ROUGHLY, max(depth, FINE * tolerance / residual))
        unsolved = increment.unsolved(point, natural)
        del natural  # as large as a few of the vectors that follow
        step = increment.solved(unsolved, depth)
        iterations += step.iterations
        point, natural = _toward(problem, point, step, merit)  # noqa: RUF059, read at the top
    raise NotConverged("the coupled increment", iterations, best, tolerance)


def _at(problem: CoupledProblem, tractions: Tractions, motion: Vector) -> tuple[Point, Motion]:
    """The point at tractions, and the motion that closes its gap."""
    u, load = problem.together(tractions), problem.normal_load
    gap = np.where(np.isfinite(problem.gap), problem.gap, 0.0)
    closing = load.motion(tractions[2], gap + u[2])
    return Point(tractions, u, load.closure(closing), motion), closing


def _natural(problem: CoupledProblem, point: Point) -> Natural:
    """The natural map at a point; raises NotConverged where it has none, or nothing touches."""
    bound = problem.friction_limit(np.maximum(point.tractions[2], 0.0))
    if problem.tangential_load.exhausts(bound) or not np.all(np.isfinite(point.tractions)):
        raise NotConverged("the coupled increment", 0, np.inf, 0.0)
    natural = Natural.at(point, problem)
    if not np.any(natural.contact):
        raise NotConverged("the coupled increment", 0, np.inf, 0.0)
    return natural


def _residual(problem: CoupledProblem, point: Point, natural: Natural, closing: Motion) -> float:
    """The worst of all dimensionless residuals at admissible tractions."""
    q, p = point.tractions[:2], point.tractions[2]
    allowed = np.isfinite(problem.gap)
    overlap = problem.normal_load.overlap(closing, problem.gap, allowed)
    # Where all sticks the surface may not move at all: of the shear, its own cells tell a scale.
    moved = np.maximum(np.abs(point.displacements[:2]), problem.self_compliance * np.abs(q))
    return worst(
        complementarity(p, natural.gap, overlap),
        penetration(natural.gap, overlap),
        natural.sheared,
        slip_direction(q, natural.bound, natural.slipped, moved),
    )


def _toward(
    problem: CoupledProblem, base: Point, step: Step, merit: float
) -> tuple[Point, Natural]:
    """As far along a step as lowers the merit enough, else as far as lowers it most. Displacements
    are linear in tractions: no part of the way takes a product."""
    lowest: tuple[Point, Natural] | None = None
    for part, (point, natural) in _on_the_way(problem, base, step):
        if natural.merit <= (1 - 0.1 * part) * merit:
            return point, natural
        if lowest is None or natural.merit < lowest[1].merit:
            lowest = point, natural
    if lowest is None:
        raise NotConverged("the coupled increment", step.iterations, merit, 0.0)
    return lowest


def _on_the_way(
    problem: CoupledProblem, base: Point, step: Step
) -> Iterator[tuple[float, tuple[Point, Natural]]]:
    """Points ever nearer to the base that have a natural map."""
    for part in HALVES:
        point = Point(
            base.tractions + part * step.tractions,
            base.displacements + part * step.displacements,
            base.closure + part * step.closure,
            base.motion,
        )
        try:
            yield part, (point, _natural(problem, point))
        except NotConverged:
            continue
