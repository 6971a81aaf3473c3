"""Semismooth Newton method for the shear at a given friction limit, with Coulomb friction.

Points stick where |q| < bound and slip along the shear where |q| = bound. For a given bound µp the
increment minimises the convex energy ½ q·A q - c·q over the admissible shears (Kalker 1990, chapter
4). A maps the shear to tangential displacements. c is the displacement that stick requires: the
slip is ω + c - A q with the rigid motion ω, and vanishes where points stick. Each step takes stick
and slip zones from the natural map, solves the problem linearised in these zones and projects the
solution. A line search accepts steps that reduce the energy sufficiently.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Mask, Vector, VectorField
from contact_scene.solver_errors import NotConverged
from contact_solver.admissible_shear import NaturalShear, magnitude, natural_shear
from contact_solver.conjugate_gradients import Map, Point
from contact_solver.linearised_shear import LinearisedShear
from contact_solver.residuals import slip_direction
from contact_solver.rigid_motion import RigidMotions
from contact_solver.zones import Zones, zones_at

MAX_STEPS = 120
# Residual norm after a linear solve over that before: largest value, used while the zones change.
ROUGHLY = 0.05
# Least residual of a linear solve, relative to the tolerance.
FINE = 0.3
ROUND_OFF = np.finfo(float).eps
# Changes of the energy below this fraction of the work of the shear may be round-off.
LEVEL = 1e-12


@dataclass(frozen=True)
class ShearSolution:
    """Solution for the shear of one increment at a given friction limit.

    shear, displacement  shear [force/length^2] and its tangential displacement [length], each
                         (2, n)
    motion               rigid motions of the indenter (k,)
    in_slip              slipping points (n,)
    residual             larger of the two residuals: friction law (natural map) and slip direction
    iterations           number of conjugate-gradient iterations of all linear solves
    """

    shear: VectorField
    displacement: VectorField
    motion: Vector
    in_slip: Mask
    residual: float
    iterations: int

    @property
    def point(self) -> Point:
        """Shear and displacement of the solution as one object, for use as initial guess."""
        return Point(self.shear, self.displacement)


@dataclass(frozen=True)
class ShearProblem:
    """Stick and slip of one increment at a given friction limit.

    displace         map A from shear (2, n) to its tangential displacement (2, n); symmetric,
                     positive
    inverse_in       function from zones of stick and slip to the approximate inverse of the
                     derivative in these zones, of rows (k, size); symmetric, positive
    bound            friction limit µp (n,), zero outside the contact [force/length^2]
    target           c (2, n) [length], the displacement that stick requires: points stick where
                     A q = ω + c
    motions          rigid motions ω of the indenter, with prescribed forces (below the friction
                     limit) or values
    self_compliance  displacement of a point by its own unit shear [length^3/force]
    """

    displace: Map
    inverse_in: Callable[[Zones], Map]
    bound: Vector
    target: VectorField
    motions: RigidMotions
    self_compliance: float

    def natural(self, point: Point, motion: Vector) -> NaturalShear:
        """Evaluate the natural map of the friction law at an iterate.

        The natural map is q -> P(q + γ (ω + c - u)), and a shear q is a solution if the map returns
        q. P is the projection on the admissible shears, and γ the inverse self-compliance.

        point   shear q and displacement u
        motion  initial guess of the rigid motions ω
        """
        apart = self.target - point.displacements
        gamma = 1 / self.self_compliance
        return natural_shear(self.motions, point.tractions, apart, self.bound, gamma, motion)


def solve_shear(
    problem: ShearProblem,
    start: Point,
    motion: Vector,
    tolerance: float,
    enough: float = 0.0,
) -> ShearSolution:
    """Compute shear, rigid motion and slip zone of one increment at a given friction limit.

    The semismooth Newton method of this module is used.

    problem        friction limit, compliance and load
    start, motion  initial guesses: shear with its displacement, which only determines the initial
                   zones, and rigid motions of the indenter
    tolerance      limit of Σ|q - P(q + γ(ω + c - A q))| / Σ bound, and of the residual of the slip
                   direction
    enough         reduction of the initial residual that suffices, if above the tolerance
    raises         NotConverged
    """
    bound, target = problem.bound, problem.target
    guess, natural = start, problem.natural(start, motion)
    linearised: LinearisedShear | None = None
    accepted: tuple[Point, float] | None = None  # with its distance from P(z)
    iterations, first, residual, shortened = 0, np.inf, np.inf, False
    for number in range(MAX_STEPS):
        if not np.isfinite(natural.error):
            break
        compliance = problem.self_compliance
        found = zones_at(bound > 0, natural.z, bound, 1 / compliance, compliance)
        settled, carriers = False, None
        if linearised is not None and np.array_equal(found.slip, linearised.zones.slip):
            settled, carriers = True, linearised.zones.transfer(linearised.carriers, found)
        linearised = LinearisedShear(
            problem.displace, problem.inverse_in(found), found, problem.motions, carriers
        )
        q = linearised.admissible(guess.tractions, bound)
        trial = Point(q, problem.displace(q))
        point, natural = _line_search(problem, accepted, trial, natural.motion)
        shortened = point.tractions is not q
        accepted = point, natural.error
        in_slip = (bound > 0) & (magnitude(natural.z) > bound)
        moved = point.displacements
        if not in_slip.any():  # the displacement of a single point may be zero at its centre
            largest = max(float(np.max(np.abs(u))) for u in (moved, target))
            moved = np.full_like(moved, largest)
        direction = slip_direction(point.tractions, bound, natural.slipped, moved)
        residual = float(np.maximum(natural.error, direction))  # keeps a NaN
        first = residual if number == 0 else first
        aim = max(tolerance, enough * first)
        if residual <= aim:
            return ShearSolution(*point, natural.motion, in_slip, residual, iterations)
        guess = point
        if shortened:  # a shortened step has other zones
            continue
        # Newton's method squares the error, so that a more accurate linear solve has no benefit.
        depth = max(residual if settled else ROUGHLY, FINE * aim / residual)
        guess, spent = linearised.solve(point, natural.slipped, min(depth, ROUGHLY))
        iterations += spent
        natural = problem.natural(guess, natural.motion)
    raise NotConverged("the shear", iterations, residual, tolerance)


def _line_search(
    problem: ShearProblem, accepted: tuple[Point, float] | None, newton: Point, motion: Vector
) -> tuple[Point, NaturalShear]:
    """Choose the Newton step, a shortened step, or a gradient step.

    A step is accepted if the energy decreases sufficiently. Close to the solution changes of the
    energy are below round-off. Only there a point is also accepted if its residual of the friction
    law is smaller than that of the accepted point. Elsewhere this criterion may increase the energy
    and lead to cycles. A point that differs from the accepted point by round-off is accepted: a
    shortened step would be round-off again, without end. Return the point and its natural map.

    accepted  last accepted point and its residual of the friction law; None in the first step
    newton    point after the Newton step
    motion    rigid motions, initial guess of the projection
    """
    natural = problem.natural(newton, motion)
    if accepted is None:
        return newton, natural
    (q, u), error = accepted
    gradient = u - problem.target - problem.motions.displacement(natural.motion)
    d, d_u = newton.tractions - q, newton.displacements - u
    slope, curvature = (d * gradient).sum(), (d * d_u).sum()
    change = slope + 0.5 * curvature
    work = np.abs(q * u).sum()
    same = curvature <= ROUND_OFF**2 * work
    level = change <= LEVEL * work
    if same or change <= 0.1 * slope or (level and natural.error < error):
        return newton, natural
    step = min(1.0, -slope / curvature)
    if step < 1e-3:
        d = problem.natural(Point(q, u), natural.motion).projected - q
        d_u = problem.displace(d)
        step = min(1.0, -(d * gradient).sum() / (d * d_u).sum())
    point = Point(q + step * d, u + step * d_u)
    return point, problem.natural(point, natural.motion)
