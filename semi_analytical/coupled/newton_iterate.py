"""Where Newton's method for a coupled increment stands, and its steps.

Each step reads the zones of contact, stick and slip off the natural map, solves the increment
linearised in them by GMRES, and goes to the answer or part of the way. The motion of the indenter
that decides on stick and slip is never that of the linearised increment, which may empty the stick
zone, but that of the exact projection.
"""

from collections.abc import Iterator

import numpy as np

from contact_scene.array_types import Vector
from contact_scene.solver_errors import NotConverged
from semi_analytical.coupled.coupled_problem import CoupledProblem
from semi_analytical.coupled.generalised_derivative import (
    Natural,
    Point,
    Tractions,
    Zones,
)
from semi_analytical.coupled.linearised_increment import (
    LinearisedIncrement,
    Step,
)
from semi_analytical.normal.normal_load import Motion

# Of the root of the number of cells in contact: at most so many change once the zones settle.
SETTLED = 0.1
HALVES = 0.5 ** np.arange(5)


class NewtonIterate:
    """A point, and its natural map; `admissible` after `linearise`, not after `step`.

    point       tractions with their displacements
    natural     the natural map there
    closing     motion that closes the gap there
    settled     whether hardly a zone has changed with the last step
    iterations  of GMRES so far
    """

    natural: Natural
    closing: Motion

    def __init__(self, problem: CoupledProblem, start: Tractions, motion: Vector) -> None:
        """At first tractions (3, nx, ny), of which the pressure is made to carry the load, and a
        first motion; raises NotConverged as all that follows, where there is no natural map."""
        start[2] = problem.normal_load.admissible(np.where(np.isfinite(problem.gap), start[2], 0.0))
        self._problem = problem
        self.point, _ = reached(problem, start, motion)
        self.natural = natural_map(problem, self.point)
        self.iterations, self.settled = 0, False
        self._zones: Zones | None = None
        self._increment: LinearisedIncrement | None = None

    def linearise(self) -> None:
        """In the zones of the point; and go to tractions nearby that friction allows there."""
        problem, motion = self._problem, self.natural.motion
        zones = Zones.of(self.natural, problem)
        images = problem.domain.images
        contact, changed = np.sum(zones.contact), zones.changes(self._zones)
        self.settled = bool(images * changed <= SETTLED * np.sqrt(images * contact))
        increment = self._increment
        carriers = increment.carriers_in(zones) if increment and self.settled else None
        self._zones, self._increment = zones, None
        del increment  # both increments at once would be more
        increment = self._increment = LinearisedIncrement(problem, zones, carriers)
        tractions = increment.admissible(self.point.tractions)
        self.point, self.closing = reached(problem, tractions, motion)
        self.natural = natural_map(problem, self.point)

    def step(self, depth: float) -> None:
        """Go where the linearised increment leads, solved but for the part `depth`, or part of the
        way."""
        assert self._increment is not None
        merit = self.natural.merit
        unsolved = self._increment.unsolved(self.point, self.natural)
        del self.natural  # as large as a few of the vectors that follow
        step = self._increment.solved(unsolved, depth)
        self.iterations += step.iterations
        self.point, self.natural = _toward(self._problem, self.point, step, merit)


def reached(problem: CoupledProblem, tractions: Tractions, motion: Vector) -> tuple[Point, Motion]:
    """The point at tractions, and the motion that closes its gap."""
    u, load = problem.together(tractions), problem.normal_load
    gap = np.where(np.isfinite(problem.gap), problem.gap, 0.0)
    closing = load.motion(tractions[2], gap + u[2])
    return Point(tractions, u, load.closure(closing), motion), closing


def natural_map(problem: CoupledProblem, point: Point) -> Natural:
    """The natural map at a point; raises NotConverged where it has none, or nothing touches."""
    bound = problem.friction_limit(np.maximum(point.tractions[2], 0.0))
    if problem.tangential_load.exhausts(bound) or not np.all(np.isfinite(point.tractions)):
        raise NotConverged("the coupled increment", 0, np.inf, 0.0)
    natural = Natural.at(point, problem)
    if not np.any(natural.contact):
        raise NotConverged("the coupled increment", 0, np.inf, 0.0)
    return natural


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
            yield part, (point, natural_map(problem, point))
        except NotConverged:
            continue
