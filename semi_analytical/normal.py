"""The pressure problem: p >= 0, gap >= 0, p gap = 0, under a given load or approach.

Among all admissible pressures the contact pressure has the least energy ½ p·A p + h·p (Kalker
1990, chapter 4). Each step guesses the contact set from the state (p > 0, or the bodies overlap),
solves the linear problem on it by preconditioned conjugate gradients and makes the answer
admissible: an active-set Newton step. It is taken when the energy goes down; otherwise a projected
gradient step is, so that the guesses cannot cycle.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.errors import NotConverged

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]
Map = Callable[[Field], Field]

MOST_STEPS = 200
MOST_ITERATIONS_PER_STEP = 200
MOST_HALVINGS = 8


@dataclass(frozen=True)
class PressureSum:
    """Force control: the sum Σp of all cell pressures, W / cell area [force/length^2]."""

    total: float


@dataclass(frozen=True)
class FixedApproach:
    """Displacement control: the approach of the two bodies [length]."""

    approach: float


NormalLoad = PressureSum | FixedApproach


@dataclass(frozen=True)
class NormalSolution:
    """Pressure (nx, ny), its displacement u_z (nx, ny), the approach, the iterations spent, and
    the residual of the start."""

    pressure: Field
    displacement: Field
    approach: float
    iterations: int
    first_residual: float


@dataclass(frozen=True)
class _Problem:
    displace: Map
    precondition: Map
    h: Field
    allowed: Mask
    load: NormalLoad

    def approach(self, p: Field, u: Field) -> float:
        """The multiplier of the load: the mean of u + h as the pressure weighs it."""
        if isinstance(self.load, FixedApproach):
            return self.load.approach
        return float(np.sum(p * (u + self.h)) / np.sum(p))

    def admissible(self, p: Field) -> Field:
        """The pressure without tension, with the sum the load demands."""
        p = np.maximum(p, 0.0)
        if isinstance(self.load, PressureSum):
            p *= self.load.total / np.sum(p)
        return p

    def residual(self, p: Field, g: Field, delta: float) -> float:
        """The larger of complementarity and penetration, relative to the approach."""
        total = np.sum(p)  # zero where a step under a fixed approach has overshot
        complementarity = np.sum(np.abs(g) * p) / total if total > 0 else 0.0
        penetration = -np.min(g, where=self.allowed, initial=0.0)
        return float(max(complementarity, penetration) / abs(delta))


def solve_normal(
    displace: Map,
    precondition: Map,
    gap: Field,
    load: NormalLoad,
    start: Field,
    tolerance: float,
    enough: float = 0.0,
) -> NormalSolution:
    """Pressure and approach for an undeformed gap.

    displace      pressure (nx, ny) -> normal displacement (nx, ny); symmetric, positive definite
    precondition  roughly the inverse of `displace`; symmetric, positive definite
    gap           undeformed gap (nx, ny) [length]; infinite where the bodies can never touch
    load          Σp or the approach
    start         a first pressure (nx, ny), not zero everywhere
    tolerance     on complementarity Σ|g|p / (δ Σp) and penetration max(-g) / δ, dimensionless
    enough        part of the residual of the start at which to stop before the tolerance
    raises        NotConverged
    """
    allowed = np.isfinite(gap)
    h = np.where(allowed, gap, 0.0)
    problem = _Problem(displace, precondition, h, allowed, load)
    p = problem.admissible(np.where(allowed, start, 0.0))
    u = displace(p)
    iterations, first = 0, np.inf
    for number in range(MOST_STEPS):
        delta = problem.approach(p, u)
        g = u + h - delta
        residual = problem.residual(p, g, delta)
        first = residual if number == 0 else first
        aim = max(tolerance, enough * first)
        if residual <= aim:
            return NormalSolution(p, u, delta, iterations, first)
        # Deep enough to reach the tolerance if the contact set is right, shallow while it is not.
        depth = max(0.05, 0.3 * aim / residual)
        contact = allowed & ((p > 0) | (g < 0))
        newton, newton_u, spent = _solve_on(contact, problem, p, u, delta, depth)
        iterations += spent
        p, u = _step_toward(newton, newton_u, problem, p, u, g)
    raise NotConverged("the pressure", iterations, residual, tolerance)


def _solve_on(
    contact: Mask, problem: _Problem, p: Field, u: Field, delta: float, depth: float
) -> tuple[Field, Field, int]:
    """Close the gap on a given contact set; returns pressure, displacement, iterations.

    Conjugate gradients until the residual norm has fallen by the factor `depth`. Under force
    control the residual is known up to a rigid shift (the approach), which is projected out in
    the metric of the preconditioner so that the sum of the pressure stays as it is.
    """
    inside = contact.astype(np.float64)
    p, u = p * inside, u.copy()
    shift_response = None
    if isinstance(problem.load, PressureSum):
        shift_response = inside * problem.precondition(inside)
    r = inside * (delta - problem.h - u)

    def preconditioned(r: Field) -> tuple[Field, Field]:
        z = inside * problem.precondition(r)
        if shift_response is not None:
            shift = np.sum(z) / np.sum(shift_response)
            r, z = r - shift * inside, z - shift * shift_response
        return r, z

    r, z = preconditioned(r)
    rz = first = np.sum(r * z)
    t = z
    iterations = 0
    while rz > depth**2 * first and iterations < MOST_ITERATIONS_PER_STEP:
        iterations += 1
        A_t = problem.displace(t)
        step = rz / np.sum(t * A_t)
        p += step * t
        u += step * A_t
        r, z = preconditioned(r - step * inside * A_t)
        rz, last = np.sum(r * z), rz
        t = z + (rz / last) * t
    return p, u, iterations


def _step_toward(
    newton: Field, newton_u: Field, problem: _Problem, p: Field, u: Field, g: Field
) -> tuple[Field, Field]:
    """To the Newton point, cut off at zero, or half as far until the energy falls enough.

    Under a stiff coating pressed cells lift others; cutting off their tension all at once may
    raise the energy again and again.
    """
    step = 1.0
    for _ in range(MOST_HALVINGS):
        target = newton if step == 1 else p + step * (newton - p)
        target_u = newton_u if step == 1 else u + step * (newton_u - u)
        if np.min(target) < 0:
            target = problem.admissible(target)
            target_u = problem.displace(target)
        d, d_u = target - p, target_u - u
        slope, curvature = np.sum(d * g), np.sum(d * d_u)
        if slope + 0.5 * curvature <= 0.1 * slope:
            return target, target_u
        step /= 2
    return _gradient_step(problem, p, u, g)


def _gradient_step(problem: _Problem, p: Field, u: Field, g: Field) -> tuple[Field, Field]:
    """Down the projected gradient to the lowest energy on the way: never fails, never fast."""
    unit = np.sum(p) / np.sum(np.abs(u))
    d = problem.admissible(np.where(problem.allowed, p - unit * g, 0.0)) - p
    d_u = problem.displace(d)
    step = min(1.0, -np.sum(d * g) / np.sum(d * d_u))
    return p + step * d, u + step * d_u
