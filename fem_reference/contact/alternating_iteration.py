"""Alternating (block Gauss-Seidel) iteration of the coupled normal and tangential problems.

Each iteration solves the shear at the last pressure and the pressure at that shear (Panagiotopoulos
1975). It contracts by about max(β², µ|β|), with Dundurs' second constant β, and diverges for
µ|β| ≥ 1. Anderson mixing of the pressures (Anderson 1965) removes that limit up to µ|β| far above
one. Its solution is the initial guess of `coupled_newton`. Without coupling one iteration is exact.
"""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask, Vector
from contact_scene.friction import CoulombFriction
from contact_scene.solver_errors import NotConverged
from fem_reference.compliance.point_compliance import PointCompliance
from fem_reference.contact.box_program import (
    BoxProgram,
    BoxSolution,
    Sides,
    Total,
    solve_box,
)
from fem_reference.contact.friction_limit import reaches_limit
from fem_reference.contact.tangential_newton import (
    ShearProblem,
    TangentialState,
    solve_shear,
)
from fem_reference.loads import NormalTarget, TangentialTarget
from fem_reference.residuals import over

MAX_TURNS = 60
LOOSEST = 1e-4  # first tolerance of the shear
REMEMBERED = 30
DEPENDENT = 1e-10  # relative size of a difference below which it depends linearly on the others


@dataclass(frozen=True)
class CoupledProblem:
    """An increment on points.

    gap         without pressure (points,) [length]
    friction    between the surfaces
    target      u_t of the state before less the motion of the indenter then (2, points) [length]
    """

    compliance: PointCompliance
    gap: Vector
    friction: CoulombFriction
    target: Field
    normal: NormalTarget
    tangential: TangentialTarget

    def bound(self, pressure: Vector) -> Vector:
        """The longest shear that each point can carry (points,) [force/length^2]."""
        carrying = np.where(self.compliance.carries_shear, pressure, 0.0)
        return self.friction.limit(carrying)

    def mean_friction(self, pressure: Vector) -> float:
        """Friction limit over pressure, both as means over the contact; 0 without contact."""
        w, p = self.compliance.areas, np.maximum(pressure, 0.0)
        return over(float(np.sum(w * self.friction.limit(p))), float(np.sum(w * p)))

    def capacity(self, pressure: Vector) -> float:
        """The largest load, a force or torque, that friction carries under a pressure."""
        lever = np.hypot(*self.compliance.motion)
        return float(np.sum(self.compliance.areas * lever * self.bound(pressure)))


@dataclass(frozen=True)
class CoupledSolution:
    """Pressure (points,) and shear (2, points) with the rigid motion.

    shift      of the indenter, or twist; None if the load equals the friction limit (gross slip)
    algorithm  algorithm used
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
    """The alternating iteration did not converge; with its iterations and linear solves."""

    def __init__(
        self, outer_iterations: int, solves: int, residual: float, tolerance: float
    ) -> None:
        super().__init__("the coupled increment", solves, residual, tolerance)
        self.outer_iterations = outer_iterations
        self.solves = solves


def solve_coupled(
    problem: CoupledProblem, pressure: Vector, shear: Field, tolerance: float
) -> CoupledSolution:
    """Iterate from a first pressure and shear until both problems meet the tolerance.

    tolerance  of the change of the pressure by an iteration, Σ w |p' − p| / Σ w p'; the shear is
               solved to a tenth of it in the end
    raises     AlternationFailed
    """
    w, target = problem.compliance.areas, problem.normal
    q, turn, solves, change = shear, 0, 0, np.inf
    couples, tightest = problem.compliance.couples, 0.1 * tolerance
    inner = max(LOOSEST, tightest) if couples else tightest
    known = _Anderson(w, target.force)
    try:
        pressed = press(problem, q, sides_of(pressure))
        p, solves = pressed.values, pressed.steps
        for turn in range(1, MAX_TURNS + 1):
            sheared = _shear(problem, p, q, inner)
            q, solves = sheared.shear, solves + sheared.solves
            if not couples:
                delta = approach_of(problem, pressed)
                return CoupledSolution(p, q, delta, sheared.shift, sheared.in_slip, turn, solves)
            pressed = press(problem, q, pressed.sides)
            solves += pressed.steps
            change = _change(w, p, pressed.values)
            if change <= tolerance and inner <= tightest:
                delta = approach_of(problem, pressed)
                return CoupledSolution(p, q, delta, sheared.shift, sheared.in_slip, turn, solves)
            if change > tolerance:
                p = known.next(p, pressed.values)
                inner = max(tightest, 0.1 * inner)
            else:
                inner = tightest
    except NotConverged as error:
        spent = solves + error.iterations
        raise AlternationFailed(turn, spent, error.residual, error.tolerance) from error
    except np.linalg.LinAlgError as error:
        raise AlternationFailed(turn, solves, np.inf, tolerance) from error
    raise AlternationFailed(turn, solves, change, tolerance)


def _change(areas: Vector, p: Vector, answer: Vector) -> float:
    """Compute the change of the pressure by an iteration relative to the new pressure [1]."""
    carried = float(np.sum(areas * answer))
    return float(np.sum(areas * np.abs(answer - p))) / carried if carried > 0 else np.inf


def sides_of(pressure: Vector) -> Sides:
    """Guess the active set of the normal problem: points with pressure are free."""
    return np.where(pressure > 0, 0, -1).astype(np.int8)


def approach_of(problem: CoupledProblem, pressed: BoxSolution) -> float:
    """The prescribed approach, or that which the force takes."""
    prescribed = problem.normal.approach
    return pressed.multiplier if prescribed is None else prescribed


def press(problem: CoupledProblem, q: Field, guess: Sides) -> BoxSolution:
    """Solve the pressure at a given shear, with the approach as multiplier of the force.

    Raises NotConverged, LinAlgError.
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
    nothing, endless = np.zeros_like(w), np.full_like(w, np.inf)
    K_zz = K[2 * points :, 2 * points :]
    return solve_box(BoxProgram(K_zz, right, nothing, endless, total), guess)


def _shear(problem: CoupledProblem, p: Vector, start: Field, tolerance: float) -> TangentialState:
    """Solve the shear at a given pressure, on the points that carry shear."""
    compliance, target = problem.compliance, problem.tangential
    w, K = compliance.areas, compliance.matrix
    points = len(w)
    bound = problem.bound(p)
    if target.load is not None and reaches_limit(target.load, problem.capacity(p)):
        lever = np.hypot(*compliance.motion)
        along = np.divide(compliance.motion, lever, out=np.zeros_like(start), where=lever > 0)
        return TangentialState(np.copysign(bound, target.load) * along, None, bound > 0, 0.0, 0)
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
    """Anderson mixing of the pressures p → p' of the iteration."""

    def __init__(self, areas: Vector, force: float | None) -> None:
        self._areas = areas
        self._force = force
        self._points: list[Vector] = []
        self._changes: list[Vector] = []

    def next(self, p: Vector, answer: Vector) -> Vector:
        """An admissible pressure near which the change would vanish, after one with this answer."""
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
        # An extrapolation without any pressure is not usable.
        return np.asarray(guess * (self._force / carried)) if carried > 0 else answer
