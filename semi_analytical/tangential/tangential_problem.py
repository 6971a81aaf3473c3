"""The shear problem: stick where |q| < bound, slip along the shear where |q| = bound.

For a given bound µp the increment minimises the convex energy ½ q·A q - c·q over all admissible
shears (Kalker 1990, chapter 4), where c is what the surface has to be moved by: slip follows from
ω + c - A q, and vanishes where cells stick. Each step reads stick and slip off the natural map,
solves the problem linearised in these zones and projects the answer exactly: a semismooth Newton
method with the true vector law of Coulomb friction. It is taken, or part of it, when the energy
goes down enough.
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
# Part of the residual that solves leave at most, as they do while the zones change.
ROUGHLY = 0.05
# Part of the tolerance that they need not go below.
FINE = 0.3
# Changes of the energy below this part of the work of the shear may be round-off.
LEVEL = 1e-12


@dataclass(frozen=True)
class TangentialSolution:
    """Shear (2, nx, ny), its displacement (2, nx, ny), the motion of the load, the slip zone, the
    residual that is left, and the iterations spent."""

    shear: VectorField
    displacement: VectorField
    motion: Vector
    in_slip: Mask
    residual: float
    iterations: int

    @property
    def shift(self) -> Vector:
        """Shift of the indenter (2,) [length]."""
        return self.motion[:2]

    @property
    def point(self) -> Point:
        """Shear and displacement."""
        return Point(self.shear, self.displacement)


@dataclass(frozen=True)
class _Problem:
    displace: Map
    bound: Field
    target: VectorField
    load: TangentialLoad
    self_compliance: float

    def natural(self, point: Point, motion: Vector) -> NaturalShear:
        """The natural map q -> P(q + γ (ω + c - u)), whose fixed points solve the problem."""
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
    """Shear, motion and slip zone of one increment at a given pressure.

    displace         shear (2, nx, ny) -> tangential displacement (2, nx, ny); symmetric, positive
    inverse          roughly the inverse of `displace`, and that of slip held back: (2 + grades,
                     nx, ny) of as many (see `ApproximateInverse`); symmetric, positive
    bound            friction limit µp (nx, ny), zero outside the contact [force/length^2]
    target           c (2, nx, ny): cells stick where A q = ω + c [length]
    load             what leads the indenter: Σq (with |Σq| < Σ bound) or the shift ω
    start, motion    first guesses of the shear with its displacement, which only tell stick from
                     slip, and of the motion of the load
    self_compliance  displacement of a cell by its own unit shear [length^3/force]
    tolerance        on Σ|q - P(q + γ(ω + c - A q))| / Σ bound, and on the slip direction
    enough           part of the residual of the start at which to stop before the tolerance
    raises           NotConverged
    """
    problem = _Problem(displace, bound, target, load, self_compliance)
    guess, natural = start, problem.natural(start, motion)
    zones: ShearZones | None = None
    carriers: list[VectorField] | None = None
    taken: tuple[Point, float] | None = None  # with its distance from P(z)
    iterations, first, residual = 0, np.inf, np.inf
    for number in range(MAX_STEPS):
        if not np.isfinite(natural.error):
            break
        found = ShearZones(natural.z, bound, self_compliance)
        settled = found.same(zones)
        zones = found
        linearised = LinearisedShear(displace, inverse, zones, load, carriers if settled else None)
        carriers = linearised.carriers
        q = linearised.admissible(guess.shear, bound)
        point, natural = _toward(problem, taken, Point(q, displace(q)), natural.motion)
        on_the_way = point.shear is not q
        taken = point, natural.error
        in_slip = (bound > 0) & (magnitude(natural.z) > bound)
        moved = point.displacement
        if not np.any(in_slip):  # a single cell may not move at all, only the surface around it
            largest = max(float(np.max(np.abs(u))) for u in (moved, target))
            moved = np.full_like(moved, largest)
        direction = slip_direction(point.shear, bound, natural.slipped, moved)
        residual = worst(natural.error, direction)
        first = residual if number == 0 else first
        aim = max(tolerance, enough * first)
        if residual <= aim:
            return TangentialSolution(*point, natural.motion, in_slip, residual, iterations)
        guess = point
        if on_the_way:  # its zones are other ones
            continue
        # Newton's error is the square of the last one: nothing is won by solving deeper.
        depth = max(residual if settled else ROUGHLY, FINE * aim / residual)
        guess, spent = linearised.solved(point, natural.slipped, min(depth, ROUGHLY))
        iterations += spent
        natural = problem.natural(guess, natural.motion)
    raise NotConverged("the shear", iterations, residual, tolerance)


def _toward(
    problem: _Problem, taken: tuple[Point, float] | None, newton: Point, motion: Vector
) -> tuple[Point, NaturalShear]:
    """To the Newton answer, or only part of the way, or down the gradient: always downhill.

    Near the solution energies differ by less than round-off; only there is the Newton answer also
    taken when it halves the natural residual. Elsewhere that may lead uphill, and round in circles.
    """
    natural = problem.natural(newton, motion)
    if taken is None:
        return newton, natural
    (q, u), error = taken
    gradient = u - problem.target - problem.load.rigid(natural.motion)
    d, d_u = newton.shear - q, newton.displacement - u
    slope, curvature = np.sum(d * gradient), np.sum(d * d_u)
    change = slope + 0.5 * curvature
    level = change <= LEVEL * np.sum(np.abs(q * u))
    if change <= 0.1 * slope or (level and natural.error < 0.5 * error):
        return newton, natural
    # Without curvature the two differ by round-off.
    step = min(1.0, -slope / curvature) if curvature > 0 else 0.0
    if step < 1e-3:
        d = problem.natural(Point(q, u), natural.motion).projected - q
        d_u = problem.displace(d)
        step = min(1.0, -np.sum(d * gradient) / np.sum(d * d_u))
    point = Point(q + step * d, u + step * d_u)
    return point, problem.natural(point, natural.motion)
