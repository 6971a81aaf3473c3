"""The shear problem: stick where |q| < bound, slip along the shear where |q| = bound.

For a given bound µp the increment minimises the convex energy ½ q·A q - c·q over all admissible
shears (Kalker 1990, chapter 4), where c is what the surface has to be moved by: slip follows from
ω + c - A q, and vanishes where cells stick. Each step guesses stick and slip from the state,
solves the linearised problem by preconditioned conjugate gradients - two components where cells
stick, the component along the edge of the disc where they slip - and projects the answer exactly:
a projected Newton method with the true vector law of Coulomb friction.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene.residuals import worst
from contact_scene.solver_errors import NotConverged
from semi_analytical.admissible_shear import (
    Field,
    TangentialLoad,
    Vector,
    VectorField,
    magnitude,
)
from semi_analytical.residuals import slip_direction

Map = Callable[[VectorField], VectorField]

MOST_STEPS = 120
MOST_ITERATIONS_PER_STEP = 100
# Changes of the energy below this part of the work of the shear may be round-off.
LEVEL = 1e-12


@dataclass(frozen=True)
class TangentialSolution:
    """Shear (2, nx, ny), its displacement (2, nx, ny), the motion of the load, the slip zone, the
    residual that is left, and the iterations spent."""

    shear: VectorField
    displacement: VectorField
    motion: Vector
    in_slip: NDArray[np.bool_]
    residual: float
    iterations: int

    @property
    def shift(self) -> Vector:
        """Shift of the indenter (2,) [length]."""
        return self.motion[:2]


@dataclass(frozen=True)
class _Problem:
    displace: Map
    precondition: Map
    bound: Field
    target: VectorField
    load: TangentialLoad
    self_compliance: float

    def natural(self, q: VectorField, u: VectorField, motion: Vector) -> "_Natural":
        """The natural map q -> P(q + γ (ω + c - u)), whose fixed points solve the problem."""
        gamma = 1 / self.self_compliance
        z = q + gamma * (self.target - u)
        projected, motion = self.load.nearest(z, self.bound, gamma, motion)
        z += self.load.rigid(gamma * motion)
        error = np.sum(magnitude(projected - q)) / np.sum(self.bound)
        return _Natural(z, projected, motion, float(error))

    def admissible(self, q: VectorField) -> VectorField:
        """The nearest shear that friction allows and that carries the load."""
        return self.load.admissible(q, self.bound)


@dataclass(frozen=True)
class _Natural:
    z: VectorField
    projected: VectorField
    motion: Vector
    error: float


def solve_tangential(
    displace: Map,
    precondition: Map,
    bound: Field,
    target: VectorField,
    load: TangentialLoad,
    start: VectorField,
    motion: Vector,
    self_compliance: float,
    tolerance: float,
    enough: float = 0.0,
) -> TangentialSolution:
    """Shear, motion and slip zone of one increment at a given pressure.

    displace         shear (2, nx, ny) -> tangential displacement (2, nx, ny); symmetric, positive
    precondition     roughly the inverse of `displace`; symmetric, positive
    bound            friction limit µp (nx, ny), zero outside the contact [force/length^2]
    target           c (2, nx, ny): cells stick where A q = ω + c [length]
    load             what leads the indenter: Σq (with |Σq| < Σ bound) or the shift ω
    start, motion    first guesses of the shear (2, nx, ny) and of the motion of the load
    self_compliance  displacement of a cell by its own unit shear [length^3/force]
    tolerance        on Σ|q - P(q + γ(ω + c - A q))| / Σ bound, and on the slip direction
    enough           part of the residual of the start at which to stop before the tolerance
    raises           NotConverged
    """
    problem = _Problem(displace, precondition, bound, target, load, self_compliance)
    q = problem.admissible(start)
    u = displace(q)
    iterations, first = 0, np.inf
    state = problem.natural(q, u, motion)
    for number in range(MOST_STEPS):
        slip = load.rigid(state.motion) + target - u
        residual = worst(state.error, slip_direction(q, bound, slip, u))
        first = residual if number == 0 else first
        aim = max(tolerance, enough * first)
        if residual <= aim:
            in_slip = (bound > 0) & (magnitude(state.z) > bound)
            return TangentialSolution(q, u, state.motion, in_slip, residual, iterations)
        newton, spent = _newton_target(problem, q, u, state, max(0.05, 0.3 * aim / residual))
        iterations += spent
        q, u, state = _descend(problem, q, u, state, newton)
    raise NotConverged("the shear", iterations, residual, tolerance)


def _newton_target(
    problem: _Problem, q: VectorField, u: VectorField, state: _Natural, depth: float
) -> tuple[VectorField, int]:
    """Solve the problem linearised at the guessed stick and slip zones; shear, iterations.

    Slip cells start from q = µp n, n along z, and may turn: moving by x along the edge of the
    disc costs the extra stiffness (|z| - µp) / (γ µp) that the curvature of the disc adds.
    """
    bound, gamma = problem.bound, 1 / problem.self_compliance
    length = magnitude(state.z)
    slip = (bound > 0) & (length > bound)
    stick = ((bound > 0) & ~slip).astype(np.float64)
    normal = np.where(slip, state.z / np.where(slip, length, 1.0), 0.0)
    tangent = np.stack([-normal[1], normal[0]])
    turning = np.where(slip, (length - bound) / np.where(slip, gamma * bound, 1.0), 0.0)
    compliance = 1 / (problem.self_compliance + turning)

    def along(v: VectorField) -> Field:
        return np.asarray(v[0] * tangent[0] + v[1] * tangent[1])

    def free(v: VectorField) -> VectorField:
        return np.asarray(v * stick + tangent * along(v))

    def preconditioned(v: VectorField) -> VectorField:
        inside = problem.precondition(v * stick) * stick
        return np.asarray(inside + tangent * (compliance * along(v)))

    base = bound * normal + q * stick
    x, constrain = _carry_load(problem, base, free, preconditioned)
    start_u = u + problem.displace(base + x - q)
    r = free(problem.load.rigid(state.motion) + problem.target - start_u - turning * x)
    r, z = constrain(r, preconditioned(r))
    rz = first = float(np.sum(r * z))
    t = z
    iterations = 0
    while rz > depth**2 * first and iterations < MOST_ITERATIONS_PER_STEP:
        iterations += 1
        H_t = free(problem.displace(t) + turning * t)
        step = rz / np.sum(t * H_t)
        x = x + step * t
        r = r - step * H_t
        r, z = constrain(r, preconditioned(r))
        rz, last = float(np.sum(r * z)), rz
        t = z + (rz / last) * t
    return problem.admissible(base + x), iterations


Constraint = Callable[[VectorField, VectorField], tuple[VectorField, VectorField]]


def _carry_load(
    problem: _Problem, base: VectorField, free: Map, preconditioned: Map
) -> tuple[VectorField, Constraint]:
    """A correction that makes the sums right, and how to keep them right.

    Free rigid motions are projected out of residuals r and their images z in the metric of the
    preconditioner. Where everything slips one way the sum cannot be corrected along it (the
    pseudo-inverse says so) and is left to the exact projection.
    """
    motions = problem.load.free_motions(base.shape)
    if not motions:
        return np.zeros_like(base), lambda r, z: (r, z)
    units = [free(motion) for motion in motions]
    images = [preconditioned(e) for e in units]
    metric = np.array([[np.sum(e * image) for image in images] for e in units])
    inverse = np.linalg.pinv(metric, rcond=1e-12, hermitian=True)

    def constrain(r: VectorField, z: VectorField) -> tuple[VectorField, VectorField]:
        shares = inverse @ problem.load.forces(z)
        for share, unit, image in zip(shares, units, images, strict=True):
            r, z = r - share * unit, z - share * image
        return r, z

    shares = inverse @ (problem.load.given - problem.load.forces(base))
    correction = np.zeros_like(base)
    for share, image in zip(shares, images, strict=True):
        correction = correction + share * image
    return correction, constrain


def _descend(
    problem: _Problem, q: VectorField, u: VectorField, state: _Natural, newton: VectorField
) -> tuple[VectorField, VectorField, _Natural]:
    """Go to the Newton answer, or only part of the way, or down the gradient: always downhill.

    Near the solution energies differ by less than round-off; only there is the Newton answer also
    taken when it halves the natural residual. Elsewhere that may lead uphill, and round in circles.
    """
    gradient = u - problem.target - problem.load.rigid(state.motion)
    d = newton - q
    d_u = problem.displace(d)
    slope, curvature = np.sum(d * gradient), np.sum(d * d_u)
    at_newton = problem.natural(newton, u + d_u, state.motion)
    change = slope + 0.5 * curvature
    level = change <= LEVEL * np.sum(np.abs(q * u))
    if change <= 0.1 * slope or (level and at_newton.error < 0.5 * state.error):
        return newton, u + d_u, at_newton
    step = min(1.0, -slope / curvature)
    if step < 1e-3:
        d = state.projected - q
        d_u = problem.displace(d)
        step = min(1.0, -np.sum(d * gradient) / np.sum(d * d_u))
    q, u = q + step * d, u + step * d_u
    return q, u, problem.natural(q, u, state.motion)
