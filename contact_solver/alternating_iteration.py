"""Alternating (block Gauss-Seidel) iteration of the coupled normal and tangential problems.

Each turn solves the tangential problem at the present pressure, then the normal problem at the new
shear (Panagiotopoulos 1975). The error contracts by about max(β², µ|β|) per turn, β Dundurs'
parameter. A few turns give an initial guess of Newton's method. At gross slip the tangential
problem has a closed form, and the turns alone solve the contact: Anderson mixing of the pressures
(Anderson 1965) accelerates them and extends their convergence far beyond µ|β| = 1.
"""

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.solver_errors import NotConverged
from contact_solver.conjugate_gradients import Point
from contact_solver.coupled_problem import CoupledProblem, CoupledSolution
from contact_solver.gross_slip import full_slip
from contact_solver.pressure import PressureProblem, solve_pressure
from contact_solver.shear import solve_shear

MAX_TURNS = 200
# Reduction of the residual by each inner solve; weak coupling reduces it about equally.
INNER_REDUCTION = 0.1
MAX_HISTORY = 30
# Relative eigenvalue of the Gram matrix of differences below which a direction is dropped.
DEPENDENT = 1e-13


def alternate(
    problem: CoupledProblem,
    pressure: Field,
    shear: VectorField,
    motion: Vector,
    tolerance: float,
    turns: int,
) -> tuple[Field, VectorField, Vector, int]:
    """Apply a few turns of the alternating iteration, and return pressure, shear and rigid motion.

    The last value returned is the number of inner iterations.

    problem                  operators, loads and friction law of the increment
    pressure, shear, motion  initial guesses: p (n,), q (2, n) and rigid tangential motion
    tolerance                limit of the dimensionless residuals
    turns                    number of turns
    raises                   NotConverged
    """
    p, iterations = problem.loaded(pressure), 0
    point = Point(shear, problem.tangential(shear) if np.any(shear) else shear)
    for _ in range(turns):
        bound = problem.friction_limit(p)
        if problem.exhausts_friction(bound):
            q, motion = full_slip(problem.shifting, bound, motion)
            point = Point(q, problem.tangential(q))
        else:
            sheared = solve_shear(problem.shearing_at(p), point, motion, tolerance, INNER_REDUCTION)
            point, motion = sheared.point, sheared.motion
            iterations += sheared.iterations
        pressed = solve_pressure(
            problem.pressing_at(point.tractions), p, tolerance, INNER_REDUCTION
        )
        p, iterations = pressed.pressure, iterations + pressed.iterations
    return p, point.tractions, motion, iterations


def solve_gross_slip(
    problem: CoupledProblem, pressure: Field, _shear: VectorField, motion: Vector, tolerance: float
) -> CoupledSolution:
    """Solve an increment whose loads are at the friction limit, by the alternating iteration.

    The shear is at the friction limit along the load. An inner solve reduces its initial residual
    by a factor, and stops earlier only if the residual meets the tolerance.

    problem    operators, loads and friction law of the increment
    pressure   initial guess of p (n,)
    motion     rigid tangential motion, returned where gross slip does not determine it
    tolerance  limit of the dimensionless residuals
    raises     NotConverged
    """
    p, iterations, residual = problem.loaded(pressure), 0, np.inf
    mixing = _AndersonMixing(problem.pressing)
    for turn in range(1, MAX_TURNS + 1):
        bound = problem.friction_limit(p)
        if not problem.exhausts_friction(bound):
            break
        q, motion = full_slip(problem.shifting, bound, motion)
        pressed = solve_pressure(problem.pressing_at(q), p, tolerance, INNER_REDUCTION)
        iterations, residual = iterations + pressed.iterations, pressed.first_residual
        if residual <= tolerance:
            return CoupledSolution(
                p, q, pressed.motion, motion, bound > 0, True, iterations, turn, "alternation"
            )
        p = mixing.next_pressure(p, pressed.pressure)
    raise NotConverged("the coupled increment", iterations, residual, tolerance)


class _AndersonMixing:
    """Anderson mixing of pressures, which accelerates the alternating iteration.

    Without mixing the fixed-point iteration is p -> p + r(p). The residual r is the pressure after
    one turn minus the pressure before. Mixing combines earlier pressures and residuals such that
    the combined residual is smallest.

    pressing  problem of the pressure, which defines the admissible pressures
    """

    def __init__(self, pressing: PressureProblem) -> None:
        self._pressing = pressing
        self._points: list[Field] = []
        self._residuals: list[Field] = []

    def next_pressure(self, p: Field, answer: Field) -> Field:
        """Compute the next pressure of the alternating iteration by Anderson mixing.

        The pressure is admissible: non-negative, with the prescribed normal load.

        p       present pressure (n,)
        answer  pressure after one turn from p (n,)
        """
        r = answer - p
        self._points = [*self._points, p][-MAX_HISTORY:]
        self._residuals = [*self._residuals, r][-MAX_HISTORY:]
        guess = answer
        if len(self._points) > 1:
            guess = answer - self._history_correction(r)
        guess = np.where(answer > 0, np.maximum(guess, 0.0), 0.0)
        return self._pressing.admissible(guess)

    def _history_correction(self, r: Field) -> Field:
        """Compute the correction of the next pressure from earlier iterations, by Anderson mixing.

        The correction (n,) is Σ c_k (Δx_k + Δr_k). The coefficients c_k minimise |r - Σ
        c_k Δr_k|. Δx_k and Δr_k are differences of successive pressures and residuals.

        r  residual of the present pressure (n,)
        """
        d_x, d_r = (
            np.diff(x, axis=0).reshape(len(x) - 1, -1) for x in (self._points, self._residuals)
        )
        size = np.sqrt(np.sum(d_r * d_r, axis=1))
        moved = size > 0  # exact solves may repeat a residual
        unit_x, unit_r = (d[moved] / size[moved, None] for d in (d_x, d_r))
        # The rounding of matrix products depends on the number of threads; that of einsum does not.
        products = np.einsum("ik,jk->ij", unit_r, unit_r)
        c = np.linalg.lstsq(products, np.einsum("ik,k->i", unit_r, r.ravel()), DEPENDENT)[0]
        return np.asarray(np.einsum("i,ik->k", c, unit_x + unit_r)).reshape(r.shape)
