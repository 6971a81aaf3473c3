"""Continuation of coupled contact problems in the compliance of springs between the surfaces.

Strong friction with strongly coupled bodies has several states that satisfy all laws. Pairs of
states appear and vanish as loads change, and Newton's method then cycles between kinks.
Sufficiently soft springs between the surfaces leave one state. This state is followed along a path
while the spring compliance decreases, with the arc length as parameter. At a limit point the path
returns to softer springs and later to stiffer ones (Keller 1977, in Applications of Bifurcation
Theory, p. 359; Allgower and Georg 1990, Numerical Continuation Methods, ch. 2 and 12).

The direction along the path preserves the sign of the determinant of the derivative with the
direction as its last row. This condition applies across kinks, too, where directions are
discontinuous.
"""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Matrix, Vector
from contact_scene.solver_errors import NotConverged
from fem_reference.contact.alternating_iteration import CoupledProblem, CoupledSolution
from fem_reference.contact.coupled_newton import InitialGuess, Root, find_root
from fem_reference.contact.natural_map import Equations, Iterate

MAX_STEPS = 1000
SOFT = 10.0  # initial compliance of the springs over that of the bodies at a point
ON_PATH = 1e-7  # tolerance of the residual norm on the path, before its end
FIRST_LENGTH, SHORTEST, LONGEST = 0.05, 1e-7, 1.0
BEYOND_KINK = 1e-6  # relative distance of the search on the other side of a kink
MAX_CORRECTIONS = 8
GROWTH = 1.5
LITTLE_FRICTION = 0.1  # least friction coefficient in the unit of the shear


def solve_by_continuation(
    problem: CoupledProblem, start: InitialGuess, tolerance: float
) -> CoupledSolution:
    """Solve the coupled pressure and shear of an increment by continuation.

    Springs between the surfaces make the solution unique. Their compliance is the continuation
    parameter and is reduced from a large value to zero. Used if the alternating iteration and
    Newton's method fail.

    problem    compliance, gap, friction and prescribed loads of the increment
    start      initial guess of tractions and rigid motion
    tolerance  limit of the relative residual of the contact and friction laws [1]
    raises     NotConverged if no solution with soft springs is found, or if the springs do not
               vanish within MAX_STEPS steps. In the second case, the stated residual is the last
               spring compliance over the compliance of the bodies
    """
    points = len(problem.compliance.areas)
    itself = np.diagonal(problem.compliance.matrix)[2 * points :] / problem.compliance.areas
    softness = float(np.median(itself))
    path = _Path(problem, find_root(problem, start, tolerance, SOFT * softness), softness)
    for _ in range(MAX_STEPS):
        found = path.step(tolerance)
        if found is not None:
            return path.equations.solution(found.at, found.in_slip, found.solves)
    raise path.lost(tolerance)


@dataclass(frozen=True)
class _PathPoint:
    """Converged point on the continuation path of an increment.

    The path consists of the solutions of the contact problem for decreasing compliance of
    additional springs between the surfaces. It ends at zero compliance with the solution that is
    sought.

    root         iterate (tractions, rigid motion, spring compliance) with its slipping points
    values       scaled unknowns: tractions, rigid motion and spring compliance (3 points + 3,)
    derivative   derivative of the contact equations by the scaled unknowns (3 points + 2, 3 points
                 + 3)
    corrections  number of Newton corrections
    """

    root: Root
    values: Vector
    derivative: Matrix
    corrections: int


class _Path:
    """Continuation of a contact problem: current point on the path, direction and step length.

    The path consists of the solutions of the contact problem for decreasing compliance of
    additional springs between the surfaces. Lengths along the path refer to scaled unknowns.
    Pressures are scaled by the mean pressure and shears by the friction limit of this mean. The
    approach is scaled by its initial value, the shift by the larger of shift and approach, and the
    spring compliance by the compliance of the bodies at a point.

    problem   compliance, gap, friction and prescribed loads of the increment
    begun     first point of the path, a solution with soft springs
    softness  compliance of the bodies at a point [length^3/force]
    """

    def __init__(self, problem: CoupledProblem, begun: Root, softness: float) -> None:
        self.equations = Equations(problem)
        self._solves = begun.solves
        self._scales = _unknown_units(self.equations, begun.at, softness)
        self._values = begun.at.values / self._scales
        self._length = FIRST_LENGTH
        self._softer = np.append(np.zeros(len(self._values) - 1), 1.0)
        derivative = self._scaled_jacobian(self._values)
        self._direction, self._sign = self._unit_tangent(derivative, -self._softer)

    def lost(self, tolerance: float) -> NotConverged:
        """Create the exception NotConverged: the continuation ended before the springs vanished.

        The continuation reduces the compliance of additional springs between the surfaces to zero.
        The exception states the last spring compliance over the compliance of the bodies.

        tolerance  tolerance that the exception states [1]
        """
        left = float(self._values[-1])
        return NotConverged("the path of continuation", self._solves, left, tolerance)

    def step(self, tolerance: float) -> Root | None:
        """Try one step along the continuation path of a contact problem.

        The path consists of the solutions with additional springs between the surfaces, and leads
        to zero spring compliance. A step extrapolates the path and corrects the result by Newton's
        method. If the correction fails, the next step is shorter. Return the solution without
        springs if the step ends there, and None otherwise.

        tolerance  limit of the residual norm of the solution without springs [1]
        """
        ahead = self._values + self._length * self._direction
        if ahead[-1] > 0:
            reached = self._correct_point(ahead, self._direction, ON_PATH)
            if reached is None:
                self._halve_step()
            else:
                self._go_to(reached)
            return None
        share = self._values[-1] / (self._values[-1] - ahead[-1])
        end = self._values + share * (ahead - self._values)
        end[-1] = 0.0
        reached = self._correct_point(end, self._softer, tolerance)
        if reached is None:
            self._halve_step()
            return None
        return reached.root

    def _go_to(self, reached: _PathPoint) -> None:
        """Make a converged point the current point of the continuation path of a contact problem.

        The direction of the path is updated. The length of the next step grows if the point needed
        few Newton corrections.

        reached  converged point, with the derivative of the contact equations there
        """
        direction, sign = self._unit_tangent(reached.derivative, self._direction)
        self._values = reached.values
        self._direction = sign * self._sign * direction
        if reached.corrections <= MAX_CORRECTIONS // 2:
            self._length = min(GROWTH * self._length, LONGEST)

    def _halve_step(self) -> None:
        """Reduce the step length along the continuation path by half after a failed correction.

        If the step length falls below SHORTEST, the current point is at a kink of the path, where a
        point of the surface changes between contact and gap or stick and slip. The direction is
        then replaced by the direction on the other side of the kink.
        """
        self._length /= 2
        if self._length > SHORTEST:
            return
        beyond = self._values + BEYOND_KINK * self._direction
        direction, sign = self._unit_tangent(self._scaled_jacobian(beyond), self._direction)
        self._direction = sign * self._sign * direction
        self._length = 100 * BEYOND_KINK

    def _correct_point(self, ahead: Vector, across: Vector, tolerance: float) -> _PathPoint | None:
        """Compute the intersection of the continuation path with a plane, by Newton's method.

        The path consists of the solutions of the contact problem with springs between the surfaces,
        in the space of the scaled unknowns: tractions, rigid motion and spring compliance. Used to
        correct an extrapolated point of the path. Return None if Newton's method fails.

        ahead      point of the plane at which Newton's method starts (3 points + 3,)
        across     normal of the plane, a unit vector (3 points + 3,)
        tolerance  limit of the norm of the residual of the contact equations [1]
        """
        values = ahead
        for corrections in range(MAX_CORRECTIONS + 1):
            at = Iterate.of(values * self._scales)
            missed, jacobian, in_slip = self.equations.linearise(at)
            size = self.equations.residual_norm(missed, at)
            derivative = jacobian * self._scales
            if size <= tolerance:
                return _PathPoint(Root(at, in_slip, self._solves), values, derivative, corrections)
            change = self._solve_extended(derivative, across, np.append(-missed, 0.0))
            values = values + change
            if values[-1] < 0 or not np.linalg.norm(values - ahead) <= self._length:
                return None
        return None

    def _scaled_jacobian(self, values: Vector) -> Matrix:
        """Compute the derivative of the contact equations of an increment by the scaled unknowns.

        The derivative has the shape (3 points + 2, 3 points + 3). Its null vector is the tangent of
        the continuation path.

        values  scaled unknowns: tractions, rigid motion and spring compliance (3 points + 3,)
        """
        _, jacobian, _ = self.equations.linearise(Iterate.of(values * self._scales))
        return np.asarray(jacobian * self._scales)

    def _unit_tangent(self, derivative: Matrix, along: Vector) -> tuple[Vector, float]:
        """Compute the unit tangent of the continuation path of a contact problem, and a sign.

        The sign is that of the determinant of the derivative of the contact equations, extended by
        the row `along`. A tangent that preserves this sign continues the path in its direction.

        derivative  derivative of the equations by the scaled unknowns (3 points + 2, 3 points + 3)
        along       vector with which the tangent has a positive scalar product (3 points + 3,)
        """
        right = np.append(np.zeros(len(derivative)), 1.0)
        tangent = self._solve_extended(derivative, along, right)
        sign, _ = np.linalg.slogdet(np.vstack([derivative, along]))
        return tangent / np.linalg.norm(tangent), float(sign)

    def _solve_extended(self, derivative: Matrix, last: Vector, right: Vector) -> Vector:
        """Solve the linearised contact equations together with one additional linear equation.

        The contact equations have one row fewer than unknowns, because the spring compliance is an
        unknown of the continuation. The additional equation makes the system square.

        derivative  derivative of the equations by the scaled unknowns (3 points + 2, 3 points + 3)
        last        coefficients of the additional equation (3 points + 3,)
        right       right-hand side of all equations (3 points + 3,)
        raises      NotConverged if the system is singular
        """
        self._solves += 1
        try:
            return np.asarray(np.linalg.solve(np.vstack([derivative, last]), right))
        except np.linalg.LinAlgError as error:
            raise self.lost(0.0) from error


def _unknown_units(equations: Equations, at: Iterate, softness: float) -> Vector:
    """Compute the units by which the continuation scales the unknowns of the contact equations.

    The result (3 points + 3,) has a unit for each traction, for the shift, the approach and the
    spring compliance. Lengths along the continuation path are measured in the scaled unknowns.
    Tractions are weighted with the areas of their points.

    equations  contact equations of the increment
    at         iterate from which mean pressure, shift and approach are taken
    softness   compliance of the bodies at a point, unit of the spring compliance [length^3/force]
    """
    w, n = equations.w, equations.n
    p = at.tractions[2 * n :]
    area = float(np.sum(w, where=p > 0))
    mean = float(np.sum(w * np.abs(p))) / area
    share = np.sqrt(area / w)
    rubbed = max(equations.problem.mean_friction(p), LITTLE_FRICTION) * mean * share
    approach = abs(at.approach)
    return np.concatenate(
        [rubbed, rubbed, mean * share, [max(abs(at.shift), approach), approach, softness]]
    )
