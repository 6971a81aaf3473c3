"""Iterates of the semismooth Newton method for a coupled increment.

A step determines the zones of contact, stick and slip from the natural map, solves the linear
system in these zones by GMRES, and applies a line search. The motion of the indenter comes from
the exact projection, not from the linear system, whose motion may empty the stick zone.
"""

from dataclasses import replace

import numpy as np

from contact_scene.array_types import Vector
from contact_scene.solver_errors import NotConverged
from contact_solver.coupled_problem import CoupledProblem
from contact_solver.linearised_contact import (
    LinearisedContact,
    Step,
)
from contact_solver.natural_map import (
    Natural,
    NewtonPoint,
    Tractions,
    zones_of,
)
from contact_solver.zones import Zones

# Zones have settled if at most this part of the root of the number of contact points changes zone.
SETTLED = 0.1
# Reduction by a linear solve while the zones change: of the residual, or of the merit.
ROUGH_REDUCTION = 0.05
# Part of the merit of the iterate, or of 1, above which the error of a linear solve dominates the
# next iterate. A round factor, chosen on stiff films: as the target of the solves it was not
# enough for one of 29.
DOMINATES = 0.2
# Merit below which an iterate with an exact inverse is made admissible, for its residuals.
NEAR = 1e-6
STEP_FACTORS = 0.5 ** np.arange(5)


class NewtonIterate:
    """Current iterate of Newton's method for a coupled increment.

    The tractions are admissible (non-negative pressure, shear within the friction limit, prescribed
    forces) after `linearise` only.

    point       tractions and displacements
    natural     contact and friction conditions at the iterate (natural map)
    merit       merit of the iterate before its tractions were made admissible
    closing     rigid normal motion that closes the gap of the iterate
    settled     True if the last step changed the zone (contact, stick, slip) of only few points
    iterations  sum of GMRES iterations
    """

    natural: Natural
    merit: float
    closing: Vector
    _base: NewtonPoint

    def __init__(self, problem: CoupledProblem, start: Tractions, motion: Vector) -> None:
        """Start Newton's method at given tractions.

        Their pressure is scaled to the normal load in place. All methods of this class raise
        NotConverged at the friction limit, for non-finite tractions or without contact.

        problem  operators, loads and friction law of the increment
        start    initial tractions (q_x, q_y, p), shape (3, n)
        motion   initial guess of the rigid tangential motion
        """
        start[2] = problem.loaded(start[2])
        self._problem = problem
        self.point, _ = evaluate_point(problem, start, motion)
        _refuse_gross_slip(problem, start[2])
        self.natural = natural_map(problem, self.point)
        self.iterations = 0
        self.settled = False
        self.is_admissible = False
        self._zones: Zones | None = None
        self._increment: LinearisedContact | None = None

    def linearise(self) -> None:
        """Linearise the contact and friction conditions at the iterate, for the next Newton step.

        The zones of contact, stick and slip follow from the natural map. The tractions are changed
        so that they are admissible in these zones, and the natural map is evaluated again. The
        solution of an exact linear system does not depend on the tractions: far from the solution
        they stay.
        """
        problem, motion = self._problem, self.natural.motion
        self._base, self.merit = replace(self.point, motion=motion), self.natural.merit
        zones = zones_of(self.natural, problem)
        if problem.inverse.exact and self.natural.merit > NEAR:
            self._increment, self.is_admissible = LinearisedContact(problem, zones), False
            return
        self.is_admissible = True
        images = problem.images
        contact, changed = np.sum(zones.contact), zones.changes(self._zones)
        self.settled = bool(images * changed <= SETTLED * np.sqrt(images * contact))
        increment = self._increment
        carriers = None
        if increment and self.settled:
            carriers = increment.zones.transfer(increment.carriers, zones)
        self._zones, self._increment = zones, None
        del increment  # limit the memory to one increment
        increment = self._increment = LinearisedContact(problem, zones, carriers)
        tractions = increment.admissible(self.point.tractions)
        self.point, self.closing = evaluate_point(problem, tractions, motion)
        self.natural = natural_map(problem, self.point)

    @property
    def rough_reduction(self) -> float:
        """Reduction of the residual by a linear solve while the zones change.

        The residual is that of admissible tractions. On a film much stiffer than its base, their
        merit may be 1e5 times that of the iterate, which the solve has to reduce.
        """
        here = self.natural.merit
        merit = min(self.merit, 1.0)
        if ROUGH_REDUCTION * here <= DOMINATES * merit:
            return ROUGH_REDUCTION
        return ROUGH_REDUCTION * merit / here

    def step(self, depth: float) -> None:
        """Take a Newton step: solve the linear system in fixed zones, then apply a line search.

        Zones are the points in contact, in stick and in slip. The line search starts from the
        iterate that determines the zones: the merit of its admissible tractions may be larger.

        depth  reduction of the residual by the linear solve
        """
        assert self._increment is not None
        if self._problem.inverse.exact:
            step = self._increment.solve_exactly(self.point, self.natural.motion)
        else:
            residual = self._increment.residual(self.point, self.natural)
            del self.natural  # release its memory before the solve
            step = self._increment.solve(residual, depth)
        self.iterations += step.iterations
        base, at = self._base, self.point
        whole = replace(
            step,
            tractions=step.tractions + (at.tractions - base.tractions),
            displacements=step.displacements + (at.displacements - base.displacements),
            closure=step.closure + (at.closure - base.closure),
        )
        self.point, self.natural = _line_search(self._problem, base, whole, self.merit)


def evaluate_point(
    problem: CoupledProblem, tractions: Tractions, motion: Vector
) -> tuple[NewtonPoint, Vector]:
    """Compute displacements and rigid normal motion for given tractions of a coupled increment.

    Return the iterate of Newton's method, and the rigid normal motion that closes its gap on
    average.

    problem    operators, loads and friction law of the increment
    tractions  (q_x, q_y, p), shape (3, n)
    motion     initial guess of the rigid tangential motion
    """
    u, pressing = problem.together(tractions), problem.pressing
    closing = pressing.motion(tractions[2], pressing.finite_gap + u[2])
    return NewtonPoint(tractions, u, pressing.closure(closing), motion), closing


def natural_map(problem: CoupledProblem, point: NewtonPoint) -> Natural:
    """Evaluate the contact and friction conditions at an iterate, written as a natural map.

    The natural map yields zones of contact, stick and slip, residuals and slip of the iterate.

    problem  operators, loads and friction law of the increment
    point    tractions, displacements and rigid motion of the iterate
    raises   NotConverged for non-finite tractions or without contact
    """
    if not np.all(np.isfinite(point.tractions)):
        raise NotConverged("the coupled increment", 0, np.inf, 0.0)
    natural = Natural.evaluate(point, problem)
    if not np.any(natural.contact):
        raise NotConverged("the coupled increment", 0, np.inf, 0.0)
    return natural


def _refuse_gross_slip(problem: CoupledProblem, p: Vector) -> None:
    """Raise NotConverged if the prescribed forces reach the friction limit of a pressure p (n,)."""
    if problem.exhausts_friction(problem.friction_limit(np.maximum(p, 0.0))):
        raise NotConverged("the coupled increment", 0, np.inf, 0.0)


def _line_search(
    problem: CoupledProblem, base: NewtonPoint, step: Step, merit: float
) -> tuple[NewtonPoint, Natural]:
    """Return the first point along a Newton step at which the merit decreases sufficiently.

    The step is halved up to four times. Without sufficient decrease the point of lowest merit is
    returned. The merit is the sum of the relative errors of pressure and shear. Displacements are
    linear in tractions, so the search needs no convolutions.

    problem     operators, loads and friction law of the increment
    base, step  iterate before the Newton step, and the step
    merit       merit of the iterate before the step
    """
    lowest: tuple[NewtonPoint, Natural] | None = None
    for factor in STEP_FACTORS:
        point = NewtonPoint(
            base.tractions + factor * step.tractions,
            base.displacements + factor * step.displacements,
            base.closure + factor * step.closure,
            base.motion,
        )
        try:
            _refuse_gross_slip(problem, point.tractions[2])
            natural = natural_map(problem, point)
        except NotConverged:
            continue
        if natural.merit <= (1 - 0.1 * factor) * merit:
            return point, natural
        if lowest is None or natural.merit < lowest[1].merit:
            lowest = point, natural
    if lowest is None:
        raise NotConverged("the coupled increment", step.iterations, merit, 0.0)
    return lowest
