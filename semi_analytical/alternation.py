"""Pressure and shear that depend on each other: alternate between the two problems.

Each round solves the shear at the present pressure and the pressure at the new shear
(Panagiotopoulos 1975). The rounds contract by about max(beta^2, µ|beta|): fast for most engineering
contacts, not at all for strong coupling. Once a round contracts poorly the pressures are
extrapolated by Anderson's method (Anderson 1965), which solves the linear part of the round trip
within a few rounds and converges far beyond µ|beta| = 1.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.admissible_shear import (
    Field,
    ShearSum,
    TangentialLoad,
    Vector,
    VectorField,
    everywhere,
)
from semi_analytical.errors import NotConverged
from semi_analytical.normal import NormalLoad, PressureSum, solve_normal
from semi_analytical.residuals import (
    complementarity,
    friction_cone,
    penetration,
    slip_direction,
)
from semi_analytical.tangential import solve_tangential

MOST_ROUNDS = 150
FIRST_TOLERANCE = 1e-3
# Inner solves stay well below the change of the last round and get ten times tighter each round:
# a solve that does nothing would look like convergence.
BELOW_CHANGE = 0.02
TIGHTEN = 0.1
SLOW = 0.25
REMEMBERED = 20


@dataclass(frozen=True)
class CoupledProblem:
    """One increment in a box of cells; operators and preconditioners as in the two solvers.

    normal, shear            u_z by pressure, u_t by shear
    normal_by_shear          u_z by shear
    shear_by_pressure        u_t by pressure
    gap                      undeformed gap (nx, ny)
    friction_coefficient     µ, a number or (nx, ny)
    target                   u_t - shift of the state before (2, nx, ny)
    self_compliance          tangential displacement of a cell by its own unit shear
    """

    normal: Callable[[Field], Field]
    precondition_normal: Callable[[Field], Field]
    shear: Callable[[VectorField], VectorField]
    precondition_shear: Callable[[VectorField], VectorField]
    normal_by_shear: Callable[[VectorField], Field]
    shear_by_pressure: Callable[[Field], VectorField]
    gap: Field
    friction_coefficient: float | Field
    target: VectorField
    normal_load: NormalLoad
    tangential_load: TangentialLoad
    self_compliance: float


@dataclass(frozen=True)
class CoupledSolution:
    """Pressure (nx, ny), shear (2, nx, ny), approach, shift (2,), slip zone, iterations, rounds."""

    pressure: Field
    shear: VectorField
    approach: float
    shift: Vector
    in_slip: NDArray[np.bool_]
    iterations: int
    rounds: int


def solve_coupled(
    problem: CoupledProblem, pressure: Field, shear: VectorField, shift: Vector, tolerance: float
) -> CoupledSolution:
    """Alternate from a first pressure, shear and shift until all residuals meet the tolerance.

    raises  NotConverged
    """
    p, q = pressure, shear
    inner, iterations, residual = FIRST_TOLERANCE, 0, np.inf
    history = _Anderson(problem.normal_load)
    for rounds in range(1, MOST_ROUNDS + 1):
        u_by_p = problem.shear_by_pressure(p)
        sheared = solve_tangential(
            problem.shear,
            problem.precondition_shear,
            problem.friction_coefficient * p,
            problem.target - u_by_p,
            problem.tangential_load,
            q,
            shift,
            problem.self_compliance,
            inner,
        )
        q, shift = sheared.shear, sheared.shift
        gap = problem.gap + problem.normal_by_shear(q)
        pressed = solve_normal(
            problem.normal, problem.precondition_normal, gap, problem.normal_load, p, inner
        )
        iterations += sheared.iterations + pressed.iterations
        change = float(np.sum(np.abs(pressed.pressure - p)) / np.sum(pressed.pressure))
        if change <= 10 * tolerance:
            residual = _residual(problem, p, q, shift, gap, u_by_p, sheared.displacement)
            if residual <= tolerance:
                delta = pressed.approach
                return CoupledSolution(p, q, delta, shift, sheared.in_slip, iterations, rounds)
        p = history.next(p, pressed.pressure)
        inner = max(0.1 * tolerance, min(TIGHTEN * inner, BELOW_CHANGE * change))
    raise NotConverged("the coupled increment", iterations, max(residual, change), tolerance)


def _residual(
    problem: CoupledProblem,
    p: Field,
    q: VectorField,
    shift: Vector,
    gap: Field,
    u_by_p: VectorField,
    u_by_q: VectorField,
) -> float:
    """The worst residual of the pair (p, q), of which the shear solver knew the present p."""
    allowed = np.isfinite(gap)
    g = np.where(allowed, gap + problem.normal(p), np.inf)
    pressed = p > 0
    delta = float(np.sum(p[pressed] * g[pressed]) / np.sum(p))
    if not isinstance(problem.normal_load, PressureSum):
        delta = problem.normal_load.approach
    g -= delta
    bound = problem.friction_coefficient * p
    slip = everywhere(shift) + problem.target - u_by_p - u_by_q
    worst = max(
        complementarity(p, g, delta),
        penetration(g, delta),
        friction_cone(q, bound),
        slip_direction(q, bound, slip, u_by_q),
    )
    if isinstance(problem.tangential_load, ShearSum):
        defect = np.sum(q, axis=(1, 2)) - problem.tangential_load.total
        worst = max(worst, float(np.hypot(*defect) / np.sum(bound)))
    return worst


class _Anderson:
    """The next point of a fixed-point iteration x -> x + r from the last few pairs (x, r)."""

    def __init__(self, load: NormalLoad) -> None:
        self._load = load
        self._points: list[Field] = []
        self._changes: list[Field] = []
        self._slow = False

    def next(self, p: Field, answer: Field) -> Field:
        """The plain answer as long as the iteration contracts well, else an admissible guess."""
        r = answer - p
        if self._changes and np.sum(np.abs(r)) > SLOW * np.sum(np.abs(self._changes[-1])):
            self._slow = True
        self._points = [*self._points, p][-REMEMBERED:]
        self._changes = [*self._changes, r][-REMEMBERED:]
        if not self._slow:
            return answer
        d_p = np.diff(self._points, axis=0).reshape(len(self._points) - 1, -1).T
        d_r = np.diff(self._changes, axis=0).reshape(len(self._points) - 1, -1).T
        share = np.linalg.lstsq(d_r, r.ravel(), rcond=1e-10)[0]
        guess = answer - ((d_p + d_r) @ share).reshape(p.shape)
        guess = np.where(answer > 0, np.maximum(guess, 0.0), 0.0)
        if isinstance(self._load, PressureSum):
            guess *= self._load.total / np.sum(guess)
        return np.asarray(guess)
