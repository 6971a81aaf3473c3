"""Pressure and shear that depend on each other: alternate between the two problems.

Each round solves the shear at the present pressure and the pressure at the new shear
(Panagiotopoulos 1975). The rounds contract by about max(beta^2, µ|beta|): fast for most engineering
contacts, not at all for strong coupling. So the pressures are extrapolated by Anderson's method
(Anderson 1965), which solves the linear part of the round trip within a few rounds and converges
far beyond µ|beta| = 1.
"""

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.quantities.residuals import worst
from contact_scene.solver_errors import NotConverged
from semi_analytical.coupled.coupled_problem import (
    CoupledProblem,
    CoupledSolution,
)
from semi_analytical.normal.normal_load import NormalLoad
from semi_analytical.normal.normal_problem import (
    NormalSolution,
    solve_normal,
)
from semi_analytical.tangential.linearised_shear import Point
from semi_analytical.tangential.tangential_problem import (
    TangentialSolution,
    solve_tangential,
)

MAX_ROUNDS = 200
# Of all its inner solves together. The dearest of the stability map's cells that converges takes
# 10 300, below a film a thousand times as stiff as its base; nine in ten take less than a hundred.
MAX_ITERATIONS = 12_000
# A residual above this after so many rounds comes down sooner from the start again, in rounds that
# go only a part of the way: the contact may have fallen apart, and from there nothing leads back.
LATE, HOPELESS = 50, 3e-2
CAUTIOUS = 0.2
# Part of its residual that each inner solve leaves: as much as a round of weak coupling does.
INNER_REDUCTION = 0.1
# Below a film like a plate a gap hardly feels the pressure's ripples (the condition number is 1e7),
# and where a solve stops decides on them: extrapolation finds nothing to go by. A solve of more
# iterations than WORKED gives that away; from then on the solves leave only this part.
WORKED, THOROUGH = 50, 1e-3
REMEMBERED = 30
# Squared part of a difference below which the others explain it.
DEPENDENT = 1e-13


def solve_coupled(
    problem: CoupledProblem,
    pressure: Field,
    shear: VectorField,
    motion: Vector,
    tolerance: float,
    *,
    most_iterations: float = np.inf,
) -> CoupledSolution:
    """Alternate from a first pressure, shear and motion until all residuals meet the tolerance.

    An inner solve reduces the residual that it finds by a given factor, and stops early only once
    that meets the tolerance. So a pressure at which the shear was solved, and which is then found
    to be in equilibrium with that shear, solves the coupled problem.
    raises  NotConverged
    """
    p, first, first_motion = pressure, Point(shear, problem.shear(shear)), motion
    point = first
    iterations, enough = 0, INNER_REDUCTION
    history = _Anderson(problem.normal_load)
    for rounds in range(1, MAX_ROUNDS + 1):
        bound = problem.friction_limit(p)
        at_limit = problem.tangential_load.exhausts(bound)
        if at_limit:
            sheared = _full_slip(problem, bound, motion)
        else:
            sheared = _sheared(problem, p, point, motion, tolerance, enough)
        point, motion = sheared.point, sheared.motion
        pressed = _pressed(problem, p, point.shear, tolerance, enough)
        iterations += sheared.iterations + pressed.iterations
        residual = worst(sheared.residual, pressed.first_residual)
        if residual <= tolerance:
            closing = pressed.motion
            return CoupledSolution(
                p, point.shear, closing, motion, sheared.in_slip, at_limit, iterations, rounds
            )
        if iterations > min(most_iterations, MAX_ITERATIONS):
            break
        if rounds == LATE and residual > HOPELESS:
            p, point, motion = pressure, first, first_motion
            history = _Anderson(problem.normal_load, CAUTIOUS)
            continue
        # Where the pressure already fits, only the shear goes on.
        if pressed.first_residual > tolerance:
            p = history.next(p, pressed.pressure)
        if enough != THOROUGH and rounds > 1 and pressed.iterations > WORKED:
            p, enough = pressed.pressure, THOROUGH
            history = _Anderson(problem.normal_load, history.part)
    raise NotConverged("the coupled increment", iterations, residual, tolerance)


def one_round(
    problem: CoupledProblem, pressure: Field, motion: Vector, tolerance: float
) -> tuple[Field, VectorField, Vector, int]:
    """Pressure, shear and motion after the first round from a pressure without shear, and its
    iterations.

    raises  NotConverged
    """
    nothing = np.zeros_like(problem.target)
    start = Point(nothing, nothing)
    sheared = _sheared(problem, pressure, start, motion, tolerance, INNER_REDUCTION)
    pressed = _pressed(problem, pressure, sheared.shear, tolerance, INNER_REDUCTION)
    iterations = sheared.iterations + pressed.iterations
    return pressed.pressure, sheared.shear, sheared.motion, iterations


def _sheared(
    problem: CoupledProblem,
    p: Field,
    start: Point,
    motion: Vector,
    tolerance: float,
    enough: float,
) -> TangentialSolution:
    """The shear at a pressure."""
    return solve_tangential(
        problem.shear,
        problem.invert_shear,
        problem.friction_limit(p),
        problem.target - problem.shear_by_pressure(p),
        problem.tangential_load,
        start,
        motion,
        problem.self_compliance,
        tolerance,
        enough,
    )


def _pressed(
    problem: CoupledProblem, p: Field, q: VectorField, tolerance: float, enough: float
) -> NormalSolution:
    """The pressure at a shear, from one near it."""
    return solve_normal(
        problem.normal,
        problem.precondition_normal,
        problem.gap + problem.normal_by_shear(q),
        problem.normal_load,
        p,
        tolerance,
        enough,
    )


def _full_slip(problem: CoupledProblem, bound: Field, motion: Vector) -> TangentialSolution:
    """All cells slip, as the load has it."""
    q, motion = problem.tangential_load.full_slip(bound, motion)
    return TangentialSolution(q, problem.shear(q), motion, bound > 0, 0.0, 0)


class _Anderson:
    """The next point of a fixed-point iteration x -> x + part r, as if r were linear in x."""

    def __init__(self, load: NormalLoad, part: float = 1.0) -> None:
        self.part = part
        self._load = load
        self._points: list[Field] = []
        self._changes: list[Field] = []

    def next(self, p: Field, answer: Field) -> Field:
        """An admissible pressure where r would vanish, after one at which the answer was p + r."""
        r = answer - p
        self._points = [*self._points, p][-REMEMBERED:]
        self._changes = [*self._changes, r][-REMEMBERED:]
        guess = plain = answer if self.part == 1 else p + self.part * r
        if len(self._points) > 1:
            guess = plain - self._extrapolation(r)
        guess = np.where(plain > 0, np.maximum(guess, 0.0), 0.0)
        return self._load.admissible(guess)

    def _extrapolation(self, r: Field) -> Field:
        """Σ share (Δx + part Δr) over the differences of known points, Σ share Δr nearest to r."""
        d_x = np.diff(self._points, axis=0).reshape(len(self._points) - 1, -1)
        d_r = np.diff(self._changes, axis=0).reshape(len(self._points) - 1, -1)
        size = np.sqrt(np.sum(d_r * d_r, axis=1))[:, None]
        unit_x, unit_r = d_x / size, d_r / size
        # Not by matrix products, whose rounding depends on the number of threads.
        products = np.einsum("ik,jk->ij", unit_r, unit_r)
        share = np.linalg.lstsq(products, np.einsum("ik,k->i", unit_r, r.ravel()), DEPENDENT)[0]
        return np.asarray(np.einsum("i,ik->k", share, unit_x + self.part * unit_r)).reshape(r.shape)
