"""Alternating (block Gauss-Seidel) iteration of the coupled normal and tangential problems.

Each iteration solves the shear at the last pressure and then the pressure at this shear
(Panagiotopoulos 1975). The iteration contracts by about max(β², µ|β|), with Dundurs' second
constant β and the coefficient of friction µ, and diverges for µ|β| ≥ 1. Anderson mixing of the
pressures (Anderson 1965) extends the convergence to values of µ|β| far above 1. The solution is the
initial guess of `coupled_newton`. Without coupling one iteration is exact.
"""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask, Vector
from contact_scene.friction import CoulombFriction
from contact_scene.friction_limit import reaches_limit
from contact_scene.solver_errors import NotConverged
from fem_reference.compliance.point_compliance import PointCompliance
from fem_reference.contact.pressure_program import (
    PressureProgram,
    PressureSolution,
    Total,
    solve_program,
)
from fem_reference.contact.tangential_newton import (
    ShearProblem,
    TangentialState,
    solve_shear,
)
from fem_reference.loads import NormalTarget, TangentialTarget
from fem_reference.residuals import over

MAX_TURNS = 60
LOOSEST = 1e-4  # tolerance of the shear in the first iterations
REMEMBERED = 30
DEPENDENT = 1e-10  # relative size of a difference below which it depends linearly on the others


@dataclass(frozen=True)
class CoupledProblem:
    """Contact problem of one increment at the points of the surface, with its loads.

    compliance  displacement of all points per traction on all points
    gap         gap without tractions (points,) [length]
    friction    Coulomb friction between the surfaces
    target      tangential displacement of the points under full stick and zero shift of the
                indenter (2, points) [length]: displacement at the start of the increment minus the
                rigid motion at the start, corrected for penalty springs and imposed strain
    normal      prescribed normal force or approach
    tangential  prescribed tangential load or motion
    """

    compliance: PointCompliance
    gap: Vector
    friction: CoulombFriction
    target: Field
    normal: NormalTarget
    tangential: TangentialTarget

    def bound(self, pressure: Vector) -> Vector:
        """Compute the friction limit µp (largest shear) of every point [force/length^2].

        The result has the shape (points,). µ is the coefficient of friction. The limit is zero at
        points that cannot carry shear, such as a point on the axis.

        pressure  p at the points (points,) [force/length^2]
        """
        carrying = np.where(self.compliance.carries_shear, pressure, 0.0)
        return self.friction.limit(carrying)

    def mean_friction(self, pressure: Vector) -> float:
        """Compute the mean coefficient of friction of the contact, Σ w µp / Σ w p [1].

        w are the areas of the points. Used to relate shear residuals to the friction limit. The
        result is 0 without contact.

        pressure  p at the points (points,) [force/length^2]
        """
        w, p = self.compliance.areas, np.maximum(pressure, 0.0)
        return over(float(np.sum(w * self.friction.limit(p))), float(np.sum(w * p)))

    def capacity(self, pressure: Vector) -> float:
        """Compute the largest tangential load that friction can carry under a given pressure.

        The load is a force, or a torque in torsion. The result is the sum of friction limit times
        area times lever arm over all points; the lever arm is 1 for a force. Used to detect gross
        slip.

        pressure  pressure at the points (points,) [force/length^2]
        """
        lever = np.hypot(*self.compliance.motion)
        return float(np.sum(self.compliance.areas * lever * self.bound(pressure)))


@dataclass(frozen=True)
class CoupledSolution:
    """Solution of a coupled contact problem: tractions and rigid motion of the indenter.

    pressure   pressure at the points (points,) [force/length^2]
    shear      shear at the points (2, points) [force/length^2]
    approach   rigid approach [length]
    shift      shift [length] or twist [radian]; None if the load is at the friction limit (gross
               slip)
    in_slip    True for slipping points (points,)
    outer_iterations, solves
               numbers of alternating iterations and of linear systems
    algorithm  name of the algorithm that found the solution
    """

    pressure: Vector
    shear: Field
    approach: float
    shift: float | None
    in_slip: Mask
    outer_iterations: int
    solves: int
    algorithm: str = "alternation"


class AlternationFailed(NotConverged):
    """Exception: the alternating iteration of pressure and shear did not converge.

    outer_iterations  number of alternating iterations
    solves            number of linear systems solved
    """

    def __init__(
        self, outer_iterations: int, solves: int, residual: float, tolerance: float
    ) -> None:
        super().__init__("the coupled increment", solves, residual, tolerance)
        self.outer_iterations = outer_iterations
        self.solves = solves


def solve_coupled(
    problem: CoupledProblem, pressure: Vector, shear: Field, tolerance: float
) -> CoupledSolution:
    """Solve pressure and shear of an increment by alternating between the two problems.

    Each iteration solves the shear at the last pressure and then the pressure at this shear.
    Without coupling of the two problems, one iteration is exact.

    problem          compliance, gap, friction and prescribed loads of the increment
    pressure, shear  initial guess of the tractions (points,) and (2, points)
    tolerance        limit of the change of the pressure in one iteration, Σ w |p' − p| / Σ w p'
                     [1], with the point areas w. In the last iteration, the relative residual of
                     the shear is at most 1/10 of this tolerance
    raises           AlternationFailed
    """
    w, target = problem.compliance.areas, problem.normal
    q, turn, solves, change = shear, 0, 0, np.inf
    couples, tightest = problem.compliance.couples, 0.1 * tolerance
    inner = max(LOOSEST, tightest) if couples else tightest
    known = _Anderson(w, target.force)
    try:
        pressed = solve_pressure(problem, q, pressure > 0)
        p, solves = pressed.values, pressed.steps
        for turn in range(1, MAX_TURNS + 1):
            sheared = _solve_shear_at_pressure(problem, p, q, inner)
            q, solves = sheared.shear, solves + sheared.solves
            if not couples:
                delta = approach_of(problem, pressed)
                return CoupledSolution(p, q, delta, sheared.shift, sheared.in_slip, turn, solves)
            pressed = solve_pressure(problem, q, pressed.free)
            solves += pressed.steps
            change = over(float(np.sum(w * np.abs(pressed.values - p))), np.sum(w * pressed.values))
            if change <= tolerance and inner <= tightest:
                delta = approach_of(problem, pressed)
                return CoupledSolution(p, q, delta, sheared.shift, sheared.in_slip, turn, solves)
            if change > tolerance:
                p = known.mix_pressures(p, pressed.values)
                inner = max(tightest, 0.1 * inner)
            else:
                inner = tightest
    except NotConverged as error:
        spent = solves + error.iterations
        raise AlternationFailed(turn, spent, error.residual, error.tolerance) from error
    except np.linalg.LinAlgError as error:
        raise AlternationFailed(turn, solves, np.inf, tolerance) from error
    raise AlternationFailed(turn, solves, change, tolerance)


def approach_of(problem: CoupledProblem, pressed: PressureSolution) -> float:
    """Return the rigid approach of the indenter after a solve of the normal problem [length].

    Under a prescribed approach the result is this approach. Under a prescribed normal force the
    result is the Lagrange multiplier of the force.

    problem  contact problem of the increment, with its prescribed loads
    pressed  solution of the normal problem
    """
    prescribed = problem.normal.approach
    return pressed.multiplier if prescribed is None else prescribed


def solve_pressure(problem: CoupledProblem, q: Field, guess: Mask) -> PressureSolution:
    """Solve the normal problem of an increment: compute the pressure while the shear is fixed.

    Under a prescribed force, the approach is the multiplier of the solution. Raise NotConverged, or
    LinAlgError if the compliance matrix is not positive definite.

    problem  compliance, gap and prescribed loads of the increment
    q        shear at the points (2, points) [force/length^2]
    guess    True for points that are probably in contact (points,)
    """
    compliance, target = problem.compliance, problem.normal
    w, K = compliance.areas, compliance.matrix
    points = len(w)
    right = -w * problem.gap - K[2 * points :, : 2 * points] @ q.ravel()
    total = None
    if target.force is not None:
        total = Total(w, target.force)
    else:
        assert target.approach is not None
        right = right + target.approach * w
    return solve_program(PressureProgram(K[2 * points :, 2 * points :], right, total), guess)


def _solve_shear_at_pressure(
    problem: CoupledProblem, p: Vector, start: Field, tolerance: float
) -> TangentialState:
    """Solve the tangential problem of an increment: compute the shear while the pressure is fixed.

    This solve is one half of each alternating iteration. Unknowns are the shears of the points
    whose friction limit is positive. If the prescribed load is at the friction limit (gross slip),
    the shear is the limit at all points.

    problem    compliance, friction and prescribed loads of the increment
    p          pressure (points,) [force/length^2]
    start      initial guess of the shear (2, points)
    tolerance  limit of the relative residual of the shear [1]
    """
    compliance, target = problem.compliance, problem.tangential
    w, K = compliance.areas, compliance.matrix
    points = len(w)
    bound = problem.bound(p)
    capacity = problem.capacity(p)
    if target.load is not None and reaches_limit(abs(target.load), capacity):
        lever = np.hypot(*compliance.motion)
        along = np.divide(compliance.motion, lever, out=np.zeros_like(start), where=lever > 0)
        share = min(1.0, over(abs(target.load), capacity))
        shear = np.copysign(share * bound, target.load) * along
        return TangentialState(shear, None, bound > 0, 0.0, 0)
    inside = np.flatnonzero(bound > 0)
    if len(inside) == 0:
        return TangentialState(np.zeros_like(start), target.motion, bound > 0, 0.0, 0)
    both = np.concatenate([inside, points + inside])
    by_pressure = (K[: 2 * points, 2 * points :] @ p).reshape(2, -1)
    part = ShearProblem(
        compliance=K[np.ix_(both, both)],
        target=(w * problem.target - by_pressure)[:, inside],
        areas=w[inside],
        along=compliance.along[:, inside],
        bound=bound[inside],
        control=target,
    )
    solved = solve_shear(part, start[:, inside], tolerance)
    q, in_slip = np.zeros_like(start), np.zeros(points, dtype=bool)
    q[:, inside], in_slip[inside] = solved.shear, solved.in_slip
    return TangentialState(q, solved.shift, in_slip, solved.residual, solved.solves)


class _Anderson:
    """Anderson mixing of the pressures of the alternating iteration, to accelerate its convergence.

    Each alternating iteration computes a new pressure p' from a pressure p. Anderson mixing
    extrapolates the pressures of the last iterations to a fixed point p' = p. The class stores the
    pressures and their changes of the last REMEMBERED iterations.
    """

    def __init__(self, areas: Vector, force: float | None) -> None:
        self._areas = areas
        self._force = force
        self._points: list[Vector] = []
        self._changes: list[Vector] = []

    def mix_pressures(self, p: Vector, answer: Vector) -> Vector:
        """Compute the pressure for the next alternating iteration from the stored iterations.

        The extrapolation is a least-squares fit to zero change of the pressure. The result
        (points,) is not negative and is zero where the last pressure is zero. Its resultant is the
        prescribed normal force, if there is one.

        p       pressure before the last iteration (points,) [force/length^2]
        answer  pressure after the last iteration (points,) [force/length^2]
        """
        self._points = [*self._points, p][-REMEMBERED:]
        self._changes = [*self._changes, answer - p][-REMEMBERED:]
        if len(self._points) < 2:
            return answer
        steps, differences = np.diff(self._points, axis=0), np.diff(self._changes, axis=0)
        size = np.sqrt(np.sum(differences**2, axis=1))
        telling = size > 0
        if not np.any(telling):
            return answer
        steps, differences = (d[telling] / size[telling, None] for d in (steps, differences))
        share, *_ = np.linalg.lstsq(differences.T, self._changes[-1], rcond=DEPENDENT)
        guess = answer - share @ (steps + differences)
        guess = np.where(answer > 0, np.maximum(guess, 0.0), 0.0)
        if self._force is None:
            return np.asarray(guess)
        carried = float(np.sum(self._areas * guess))
        # An extrapolation without any pressure cannot carry the force.
        return np.asarray(guess * (self._force / carried)) if carried > 0 else answer
