"""Semismooth Newton method for the tangential problem with Coulomb friction.

Cells stick where |q| < bound and slip along the shear where |q| = bound. For a given bound µp the
increment minimises the convex energy ½ q·A q - c·q over the admissible shears (Kalker 1990, chapter
4). A maps the shear to tangential displacements. c is the displacement that stick requires: the
slip is ω + c - A q with the rigid motion ω, and vanishes where cells stick. Each step takes stick
and slip zones from the natural map, solves the problem linearised in these zones and projects the
solution. A line search accepts steps that reduce the energy sufficiently.
"""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask, Vector, VectorField
from contact_scene.quantities.residuals import worst
from contact_scene.solver_errors import NotConverged
from semi_analytical.residuals import slip_direction
from semi_analytical.tangential.admissible_shear import (
    NaturalShear,
    TangentialLoad,
    magnitude,
    natural_shear,
)
from semi_analytical.tangential.linearised_shear import (
    LinearisedShear,
    Point,
)
from semi_analytical.tangential.shear_zones import (
    Map,
    ShearZones,
)

MAX_STEPS = 120
# Residual norm after a linear solve over that before: largest value, used while the zones change.
ROUGHLY = 0.05
# Least residual of a linear solve, relative to the tolerance.
FINE = 0.3
ROUND_OFF = np.finfo(float).eps
# Changes of the energy below this fraction of the work of the shear may be round-off.
LEVEL = 1e-12


@dataclass(frozen=True)
class TangentialSolution:
    """Solution of the tangential problem of one increment at a given pressure.

    shear, displacement  shear [force/length^2] and its tangential displacement [length], each (2,
                         nx, ny)
    motion               rigid tangential motion of the indenter: shift, and twist under a torque
    in_slip              slipping cells (nx, ny)
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
class _Problem:
    """Tangential problem of one increment at a given pressure.

    displace         map from shear (2, nx, ny) to its tangential displacement
    bound            friction limit µp (nx, ny)
    target           displacement that full stick requires (2, nx, ny) [length]
    load             prescribed tangential load
    self_compliance  displacement of a cell by its own unit shear [length^3/force]
    """

    displace: Map
    bound: Field
    target: VectorField
    load: TangentialLoad
    self_compliance: float

    def natural(self, point: Point, motion: Vector) -> NaturalShear:
        """Evaluate the natural map of the friction law at an iterate of the tangential problem.

        The natural map is q -> P(q + γ (ω + c - u)), and a shear q is a solution if the map returns
        q. P is the projection on the admissible shears, ω the rigid motion, c the displacement that
        stick requires, u the tangential displacement and γ a stiffness.

        point   shear q and displacement u
        motion  initial guess of the rigid motion ω
        """
        apart = self.target - point.displacement
        gamma = 1 / self.self_compliance
        return natural_shear(self.load, point.shear, apart, self.bound, gamma, motion)


def solve_tangential(
    displace: Map,
    inverse: Map,
    bound: Field,
    target: VectorField,
    load: TangentialLoad,
    start: Point,
    motion: Vector,
    self_compliance: float,
    tolerance: float,
    enough: float = 0.0,
) -> TangentialSolution:
    """Compute shear, rigid motion and slip zone of one increment at a given pressure.

    The semismooth Newton method of this module is used. P is the projection on the admissible
    shears, ω the rigid motion, A the map `displace`, q the shear and γ the inverse self-compliance.

    displace         function A from a shear (2, nx, ny) to its tangential displacement (2, nx, ny);
                     symmetric, positive
    inverse          approximate inverse of `displace`, then of one component with the compliance of
                     each bin: (2 + bins, nx, ny) to the same shape (see `ApproximateInverse`);
                     symmetric, positive
    bound            friction limit µp (nx, ny), zero outside the contact [force/length^2]
    target           c (2, nx, ny) [length], the displacement that stick requires: cells stick where
                     A q = ω + c
    load             prescribed tangential force (with |Σq| < Σ bound) or shift ω
    start, motion    initial guesses: shear with its displacement, which only determines the initial
                     zones, and rigid motion of the indenter
    self_compliance  displacement of a cell by its own unit shear [length^3/force]
    tolerance        limit of Σ|q - P(q + γ(ω + c - A q))| / Σ bound, and of the residual of the
                     slip direction
    enough           reduction of the initial residual that suffices, if above the tolerance
    raises           NotConverged
    """
    problem = _Problem(displace, bound, target, load, self_compliance)
    guess, natural = start, problem.natural(start, motion)
    zones: ShearZones | None = None
    carriers: list[VectorField] | None = None
    accepted: tuple[Point, float] | None = None  # with its distance from P(z)
    iterations, first, residual, shortened = 0, np.inf, np.inf, False
    for number in range(MAX_STEPS):
        if not np.isfinite(natural.error):
            break
        found = ShearZones(natural.z, bound, self_compliance)
        settled = found.has_same_slip(zones)
        zones = found
        linearised = LinearisedShear(displace, inverse, zones, load, carriers if settled else None)
        carriers = linearised.carriers
        q = linearised.admissible(guess.shear, bound)
        trial = Point(q, displace(q))
        point, natural = _line_search(problem, accepted, trial, natural.motion)
        shortened = point.shear is not q
        accepted = point, natural.error
        in_slip = (bound > 0) & (magnitude(natural.z) > bound)
        moved = point.displacement
        if not np.any(in_slip):  # the displacement of a single cell may be zero at its centre
            largest = max(float(np.max(np.abs(u))) for u in (moved, target))
            moved = np.full_like(moved, largest)
        direction = slip_direction(point.shear, bound, natural.slipped, moved)
        residual = worst(natural.error, direction)
        first = residual if number == 0 else first
        aim = max(tolerance, enough * first)
        if residual <= aim:
            return TangentialSolution(*point, natural.motion, in_slip, residual, iterations)
        guess = point
        if shortened:  # a shortened step has other zones
            continue
        # Newton's method squares the error, so that a more accurate linear solve has no benefit.
        depth = max(residual if settled else ROUGHLY, FINE * aim / residual)
        guess, spent = linearised.solve_in_zones(point, natural.slipped, min(depth, ROUGHLY))
        iterations += spent
        natural = problem.natural(guess, natural.motion)
    raise NotConverged("the shear", iterations, residual, tolerance)


def _line_search(
    problem: _Problem,
    accepted: tuple[Point, float] | None,
    newton: Point,
    motion: Vector,
) -> tuple[Point, NaturalShear]:
    """Choose the Newton step of the tangential problem, a shortened step, or a gradient step.

    A step is accepted if the energy decreases sufficiently. Close to the solution changes of the
    energy are below round-off. Only there a point is also accepted if its residual of the friction
    law is smaller than that of the accepted point. Elsewhere this criterion may increase the energy
    and lead to cycles. A point that differs from the accepted point by round-off is accepted: a
    shortened step would be round-off again, without end. Return the point and its natural map.

    accepted  last accepted point and its residual of the friction law; None in the first step
    newton    point after the Newton step
    motion    rigid motion, initial guess of the projection
    """
    natural = problem.natural(newton, motion)
    if accepted is None:
        return newton, natural
    (q, u), error = accepted
    gradient = u - problem.target - problem.load.rigid(natural.motion)
    d, d_u = newton.shear - q, newton.displacement - u
    slope, curvature = np.sum(d * gradient), np.sum(d * d_u)
    change = slope + 0.5 * curvature
    work = np.sum(np.abs(q * u))
    same = curvature <= ROUND_OFF**2 * work
    level = change <= LEVEL * work
    if same or change <= 0.1 * slope or (level and natural.error < error):
        return newton, natural
    step = min(1.0, -slope / curvature)
    if step < 1e-3:
        d = problem.natural(Point(q, u), natural.motion).projected - q
        d_u = problem.displace(d)
        step = min(1.0, -np.sum(d * gradient) / np.sum(d * d_u))
    point = Point(q + step * d, u + step * d_u)
    return point, problem.natural(point, natural.motion)
