"""Alternating (block Gauss-Seidel) iteration of the coupled normal and tangential problems.

Each outer iteration solves the tangential problem at the present pressure, then the normal problem
at the new shear (Panagiotopoulos 1975). The error contracts by about max(β², µ|β|) per iteration,
β Dundurs' parameter. Strong coupling does not converge. Anderson mixing of the pressures
(Anderson 1965) accelerates the iteration and extends its convergence far beyond µ|β| = 1.
"""

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.solver_errors import NotConverged
from contact_solver.conjugate_gradients import Point
from contact_solver.coupled_problem import CoupledProblem, CoupledSolution
from contact_solver.gross_slip import full_slip
from contact_solver.pressure import PressureProblem, solve_pressure
from contact_solver.shear import ShearSolution, solve_shear

MAX_OUTER_ITERATIONS = 200
# Sum over all inner solves. In the stability map the most expensive converging case takes 10 300
# (a film 1000 times stiffer than its base); 90 % of the cases take less than 100.
MAX_ITERATIONS = 12_000
# A residual above RESTART_RESIDUAL after RESTART_AFTER outer iterations indicates a contact that
# has fallen apart. The iteration then restarts from the initial guess with the factor DAMPED.
RESTART_AFTER, RESTART_RESIDUAL = 50, 3e-2
DAMPED = 0.2
# Reduction of the residual by each inner solve; weak coupling reduces it about equally.
INNER_REDUCTION = 0.1
# Under a film that acts like a plate the gap hardly depends on short pressure waves (condition
# number 1e7). An inner solve that stops early leaves them undetermined, and mixing fails. A normal
# solve of more than STIFF_ITERATIONS indicates this case; the reduction is then FINE_REDUCTION.
STIFF_ITERATIONS, FINE_REDUCTION = 50, 1e-3
MAX_HISTORY = 30
# Relative eigenvalue of the Gram matrix of differences below which a direction is dropped.
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
    """Solve a coupled increment by alternating iteration of the normal and the tangential problem.

    Each iteration solves the tangential problem at a fixed pressure, then the normal problem at a
    fixed shear. An inner solve reduces its initial residual by a factor, and stops earlier only if
    the residual meets the tolerance. The iteration has converged when the shear solved at a
    pressure and the normal problem at this pressure and shear both meet the tolerance.

    problem                  operators, loads and friction law of the increment
    pressure, shear, motion  initial guesses: p (n,), q (2, n) and rigid tangential motion
    tolerance                limit of the dimensionless residuals
    most_iterations          limit of the sum of inner iterations, at most MAX_ITERATIONS
    raises                   NotConverged
    """
    # The solution may be the initial guess, which must carry the load.
    p = pressure = problem.pressing.admissible(np.where(problem.pressing.allowed, pressure, 0.0))
    first, first_motion = Point(shear, problem.tangential(shear)), motion
    point = first
    iterations, reduction = 0, INNER_REDUCTION
    mixing = _AndersonMixing(problem.pressing)
    for outer in range(1, MAX_OUTER_ITERATIONS + 1):
        bound = problem.friction_limit(p)
        at_limit = problem.exhausts_friction(bound)
        if at_limit:
            tangential = _gross_slip(problem, bound, motion)
        else:
            tangential = solve_shear(problem.shearing_at(p), point, motion, tolerance, reduction)
        point, motion = tangential.point, tangential.motion
        normal = solve_pressure(problem.pressing_at(point.tractions), p, tolerance, reduction)
        iterations += tangential.iterations + normal.iterations
        residual = float(np.maximum(tangential.residual, normal.first_residual))  # keeps a NaN
        if residual <= tolerance:
            closing, in_slip = normal.motion, tangential.in_slip
            return CoupledSolution(
                p,
                point.tractions,
                closing,
                motion,
                in_slip,
                at_limit,
                iterations,
                outer,
                "alternation",
            )
        if iterations > min(most_iterations, MAX_ITERATIONS):
            break
        if outer == RESTART_AFTER and residual > RESTART_RESIDUAL:
            p, point, motion = pressure, first, first_motion
            mixing = _AndersonMixing(problem.pressing, DAMPED)
            continue
        # A pressure that meets the tolerance stays; only the shear is solved again.
        if normal.first_residual > tolerance:
            p = mixing.next_pressure(p, normal.pressure)
        if reduction != FINE_REDUCTION and outer > 1 and normal.iterations > STIFF_ITERATIONS:
            p, reduction = normal.pressure, FINE_REDUCTION
            mixing = _AndersonMixing(problem.pressing, mixing.factor)
    raise NotConverged("the coupled increment", iterations, residual, tolerance)


def one_iteration(
    problem: CoupledProblem, pressure: Field, motion: Vector, tolerance: float
) -> tuple[Field, VectorField, Vector, int]:
    """Compute pressure, shear and rigid motion after one alternating iteration, from zero shear.

    The tangential problem is solved at the given pressure, then the normal problem at the new
    shear. The result is an initial guess for Newton's method. The last value returned is the number
    of inner iterations.

    problem    operators, loads and friction law of the increment
    pressure   initial guess of the pressure (n,)
    motion     initial guess of the rigid tangential motion
    tolerance  limit of the dimensionless residuals
    raises     NotConverged
    """
    zero = np.zeros_like(problem.target)
    start = Point(zero, zero)
    tangential = solve_shear(
        problem.shearing_at(pressure), start, motion, tolerance, INNER_REDUCTION
    )
    shear = tangential.shear
    normal = solve_pressure(problem.pressing_at(shear), pressure, tolerance, INNER_REDUCTION)
    return normal.pressure, shear, tangential.motion, tangential.iterations + normal.iterations


def _gross_slip(problem: CoupledProblem, bound: Field, motion: Vector) -> ShearSolution:
    """Return the shear of gross slip, at the friction limit along the load, as a solution.

    bound   friction limit µp (n,)
    motion  rigid motion, returned where gross slip does not determine it
    """
    q, motion = full_slip(problem.shifting, bound, motion)
    return ShearSolution(q, problem.tangential(q), motion, bound > 0, 0.0, 0)


class _AndersonMixing:
    """Anderson mixing of pressures, which accelerates the alternating iteration.

    Without mixing the fixed-point iteration is p -> p + factor r(p). The residual r is the pressure
    after one alternating iteration minus the pressure before. Mixing combines earlier pressures and
    residuals such that the combined residual is smallest.

    pressing  problem of the pressure, which defines the admissible pressures
    factor    damping factor of the residual
    """

    def __init__(self, pressing: PressureProblem, factor: float = 1.0) -> None:
        self.factor = factor
        self._pressing = pressing
        self._points: list[Field] = []
        self._residuals: list[Field] = []

    def next_pressure(self, p: Field, answer: Field) -> Field:
        """Compute the next pressure of the alternating iteration by Anderson mixing.

        The pressure is admissible: non-negative, with the prescribed normal load.

        p       present pressure (n,)
        answer  pressure after one alternating iteration from p (n,)
        """
        r = answer - p
        self._points = [*self._points, p][-MAX_HISTORY:]
        self._residuals = [*self._residuals, r][-MAX_HISTORY:]
        guess = plain = answer if self.factor == 1 else p + self.factor * r
        if len(self._points) > 1:
            guess = plain - self._history_correction(r)
        guess = np.where(plain > 0, np.maximum(guess, 0.0), 0.0)
        return self._pressing.admissible(guess)

    def _history_correction(self, r: Field) -> Field:
        """Compute the correction of the next pressure from earlier iterations, by Anderson mixing.

        The correction (n,) is Σ c_k (Δx_k + factor Δr_k). The coefficients c_k minimise |r - Σ
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
        return np.asarray(np.einsum("i,ik->k", c, unit_x + self.factor * unit_r)).reshape(r.shape)
