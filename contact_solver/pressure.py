"""Active-set Newton method for the pressure alone: p >= 0, gap >= 0, p gap = 0 under a load.

Among all admissible pressures the contact pressure minimises the energy ½ p·A p + h·p (Kalker 1990,
chapter 4). Each step estimates the contact set (p > 0 or overlap), solves the linear problem on it
by preconditioned conjugate gradients and makes the solution admissible. A line search accepts steps
that reduce the energy sufficiently. If it fails, points in tension leave the contact set
successively (Lawson and Hanson 1974), so that the contact sets cannot cycle.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field, Mask, Matrix, Vector
from contact_scene.solver_errors import NotConverged
from contact_solver.admissible_pressure import admissible_pressure
from contact_solver.conjugate_gradients import Map, Point, inner, solve_in_zones
from contact_solver.rigid_motion import RigidMotions

MAX_STEPS = 200
MAX_ITERATIONS_PER_STEP = 200
# Limit for one solve; plate-like films on 48 x 48 cells take up to 8 000.
MAX_ITERATIONS = 20_000
MAX_HALVINGS = 5
# Reduction of the residual norm by a linear solve: while the contact set changes, and while points
# leave it. The solutions are intermediate.
MOVING = 0.3
ROUGHLY = 0.5
# Least decrease of the energy relative to that by its slope (Armijo's condition).
LEAST_FALL = 0.1
# Singular values relative to the largest below which a motion does not change the gap.
UNDETERMINED = 1e-14


@dataclass(frozen=True)
class PressureSolution:
    """Solution for the pressure (contact without penetration, given shear) under one load.

    pressure, displacement  p [force/length^2] and normal surface displacement u_z [length], each
                            (n,)
    motion                  rigid motions that close the gap (k,): approach, and tilts
    iterations              iterations of all linear solves
    first_residual          residual of the initial guess, dimensionless
    """

    pressure: Vector
    displacement: Vector
    motion: Vector
    iterations: int
    first_residual: float


@dataclass(frozen=True)
class PressureProblem:
    """Contact without penetration for a given shear, under prescribed forces or motions.

    displace      map from pressure (n,) to normal displacement (n,); symmetric, positive definite
    inverse_on    function from a contact set (n,) to the approximate inverse of `displace` on it;
                  symmetric, positive definite
    gap           undeformed gap (n,) [length]; infinite where contact is impossible
    motions       rigid motions that reduce the gap, the approach first
    """

    displace: Map
    inverse_on: Callable[[Mask], Map]
    gap: Vector
    motions: RigidMotions

    @cached_property
    def allowed(self) -> Mask:
        """Mask (n,) of the points of finite gap, which can come into contact."""
        return np.isfinite(self.gap)

    @cached_property
    def finite_gap(self) -> Vector:
        """Undeformed gap (n,) [length], zero where it is infinite."""
        return np.where(self.allowed, self.gap, 0.0)

    def motion(self, p: Vector, s: Vector) -> Vector:
        """Compute the rigid motions (k,) that close the gap under the present pressure.

        Free motions minimise the sum of the squared gaps, weighted by the pressure.

        p  pressure (n,)
        s  gap before the rigid motion (n,) [length]: undeformed gap plus displacement
        """
        found, free = self.motions.values.copy(), self.motions.held
        if len(free):
            right = free.forces((p * (s - self.closure(found)))[None])
            found[self.motions.is_held] = _least_squares(free.shapes.products(p)) @ right
        return found

    def closure(self, motion: Vector) -> Vector:
        """Compute the reduction of the gap by a rigid motion, (n,) or (1,) [length].

        motion  rigid motions (k,)
        """
        return np.asarray(self.motions.displacement(motion)[0])

    def overlap(self, motion: Vector) -> float:
        """Return the overlap of the undeformed bodies, the scale of residual gaps [length].

        It is the magnitude of the approach. The axis of a tilted indenter may be higher than at
        first contact: the overlap is then the largest of all points.

        motion  rigid motions (k,)
        """
        if len(motion) == 1:
            return abs(float(motion[0]))
        return float(
            np.max(self.closure(motion) - self.finite_gap, where=self.allowed, initial=-np.inf)
        )

    def residual(self, p: Vector, g: Vector, motion: Vector) -> float:
        """Return the larger of the complementarity and penetration residuals of the contact.

        Complementarity is Σ|g| p / Σp (pressure acts where the gap is open), penetration the
        largest overlap of the deformed bodies. Each is divided by the overlap of the undeformed
        bodies.

        p       pressure (n,)
        g       gap (n,) [length]; negative where the deformed bodies overlap
        motion  rigid motions (k,)
        """
        total = p.sum()  # zero where a step under a prescribed approach has overshot
        complementarity = inner(np.abs(g), p) / total if total > 0 else 0.0
        penetration = -np.where(self.allowed, g, 0.0).min()
        overlap = self.overlap(motion)
        if not overlap > 0:  # a diverging step
            return np.inf
        # A NaN is larger than any number.
        return float(np.maximum(complementarity, penetration) / overlap)

    def admissible(self, p: Vector) -> Vector:
        """Return a non-negative pressure near a given one with the prescribed forces.

        p  given pressure (n,)
        """
        return admissible_pressure(self.motions.held, p, self.allowed)

    def projection(self, contact: Mask) -> Map:
        """Return a linear projection of pressure changes, for conjugate gradients on a contact set.

        A projected change is zero outside the contact and does not change the prescribed forces.
        The projection is orthogonal, so that the projected preconditioner is symmetric.

        contact  points in contact (n,)
        """
        free, inside = self.motions.held, contact.astype(np.float64)
        if not len(free):
            return lambda field: field * inside
        units = free.shapes.along(inside[None])
        inverse = _least_squares(free.shapes.products(inside))

        def projected(field: Field) -> Field:
            left = field * inside
            left -= (inverse @ np.einsum("kn,n->k", units, field)) @ units
            return left

        return projected


def _least_squares(products: Matrix) -> Matrix:
    """Return the inverse of scalar products of motions, or the pseudo-inverse if it is singular."""
    if len(products) == 1 and products[0, 0] > 0:
        return 1 / products
    return np.asarray(np.linalg.pinv(products, rcond=UNDETERMINED, hermitian=True))


def solve_pressure(
    problem: PressureProblem, start: Vector, tolerance: float, enough: float = 0.0
) -> PressureSolution:
    """Compute the contact pressure and the rigid motion of the indenter.

    The active-set Newton method of this module is used.

    problem    undeformed gap, compliance and load
    start      initial pressure (n,), not zero everywhere
    tolerance  limit of complementarity Σ|g|p / (δ Σp) and penetration max(-g) / δ, dimensionless; g
               is the gap and δ the overlap of the undeformed bodies
    enough     reduction of the initial residual that suffices, if above the tolerance
    raises     NotConverged
    """
    p = problem.admissible(np.where(problem.allowed, start, 0.0))
    point = Point(p, problem.displace(p))
    iterations, first, last = 0, np.inf, None
    for number in range(MAX_STEPS):
        p, u = point
        s = u + problem.finite_gap
        motion = problem.motion(p, s)
        g = s - problem.closure(motion)
        residual = problem.residual(p, g, motion)
        first = residual if number == 0 else first
        aim = max(tolerance, enough * first)
        if residual <= aim:
            return PressureSolution(p, u, motion, iterations, first)
        if iterations > MAX_ITERATIONS:
            break
        contact = problem.allowed & ((p > 0) | (g < 0))
        # The reduction reaches the tolerance once the contact set is final; it is weak before.
        settled = last is not None and bool((contact == last).all())
        depth = max(0.0 if settled else MOVING, 0.3 * aim / residual)
        last = contact
        newton, spent = close_gap(problem, contact, point, g, depth)
        iterations += spent
        point, spent = _line_search(problem, newton, point, g)
        iterations += spent
    raise NotConverged("the pressure", iterations, residual, tolerance)


def close_gap(
    problem: PressureProblem, contact: Mask, start: Point, g: Vector, depth: float
) -> tuple[Point, int]:
    """Solve for the pressure that closes the gap on a fixed contact set.

    The linear problem of one Newton step is solved: pressures may become negative. Return pressure
    with displacement, and the number of conjugate-gradient iterations.

    contact  contact set, which contains all points under pressure (n,)
    start    pressure and displacement at the start
    g        gap at the start (n,) [length]
    depth    reduction of the residual norm at which the iteration stops
    """
    projected, precondition = problem.projection(contact), problem.inverse_on(contact)
    p, u, iterations = solve_in_zones(
        problem.displace,
        lambda d, d_u: projected(d_u),
        lambda r: projected(precondition(r)),
        projected(-g),
        depth,
        MAX_ITERATIONS_PER_STEP,
    )
    return Point(start.tractions + p, start.displacements + u), iterations


def _line_search(
    problem: PressureProblem, newton: Point, point: Point, g: Vector
) -> tuple[Point, int]:
    """Accept the pressure of a Newton step, with negative values set to zero, or a shorter step.

    The energy must decrease sufficiently. Under a stiff coating pressure lifts adjacent points, and
    setting all negative pressures to zero at once may raise the energy repeatedly. Points then
    leave the contact set successively. Return the point and the number of iterations.

    newton  point after the full Newton step
    point   last accepted point
    g       its gap (n,) [length]
    """
    step = 1.0
    for _ in range(MAX_HALVINGS):
        target = newton if step == 1 else _between(point, newton, step)
        if target.tractions.min() < 0:
            p = problem.admissible(target.tractions)
            target = Point(p, problem.displace(p))
        if _decreases_energy(point, target, g):
            return target, 0
        step /= 2
    return _remove_tension(problem, newton, point, g)


def _remove_tension(
    problem: PressureProblem, newton: Point, point: Point, g: Vector
) -> tuple[Point, int]:
    """Remove points with negative pressure from the contact set, until none is left.

    The method is that of Lawson and Hanson (1974, ch. 23). Each pass moves towards the Newton point
    until `many` points reach zero pressure, at most half of the negative ones. If the energy does
    not decrease sufficiently, `many` is halved. With `many` = 1 the energy always decreases, so
    that every pass removes at least one point. Return the result and the number of iterations.

    newton  point after the full Newton step
    point   last accepted point
    g       its gap (n,) [length]
    """
    contact = (point.tractions > 0) | (newton.tractions != 0)
    iterations, many = 0, contact.size
    while np.any(newton.tractions < 0):
        if iterations > MAX_ITERATIONS:
            return point, iterations
        # Fraction of the step at which each point in tension reaches zero pressure.
        p, tension = point.tractions, newton.tractions < 0
        fall = np.where(tension, p - newton.tractions, 1.0)
        part_of_way = np.where(tension, p / fall, np.inf)
        parts = np.sort(part_of_way[tension])
        many = max(1, min(2 * many, len(parts) // 2))
        while True:
            part = parts[many - 1]
            target = _between(point, newton, part)
            if part == parts[0]:
                break
            p = problem.admissible(target.tractions)
            target = Point(p, problem.displace(p))
            iterations += 1
            if _decreases_energy(point, target, g):
                break
            many //= 2
        contact = contact & (part_of_way > part)
        g = g + (target.displacements - point.displacements)
        point = Point(np.where(contact, target.tractions, 0.0), target.displacements)
        newton, spent = close_gap(problem, contact, point, g, ROUGHLY)
        iterations += spent
    return newton, iterations


def _between(point: Point, other: Point, part: float) -> Point:
    """Return the point at a part of the way from one point to another."""
    (p, u), (q, v) = point, other
    return Point(p + part * (q - p), u + part * (v - u))


def _decreases_energy(point: Point, target: Point, g: Vector) -> bool:
    """Return True if the energy decreases by at least 10 % of
    its decrease by the gradient, the gap g (Armijo's condition)."""
    d, d_u = target.tractions - point.tractions, target.displacements - point.displacements
    slope = inner(d, g)
    return bool(slope + 0.5 * inner(d, d_u) <= LEAST_FALL * slope)
