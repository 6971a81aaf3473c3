"""Contact problem of one increment at the points of the surface, solved by `contact_solver`.

Points represent different areas, see `contact_solver.unequal_areas`.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field, Mask, Vector
from contact_scene.friction import CoulombFriction
from contact_solver.conjugate_gradients import Point
from contact_solver.coupled_problem import CoupledProblem
from contact_solver.dense_inverse import DenseInverse
from contact_solver.globalisation import solve_together
from contact_solver.gross_slip import full_slip, limit_load
from contact_solver.pressure import solve_pressure
from contact_solver.rigid_motion import RigidMotion, RigidMotions
from contact_solver.shear import solve_shear
from contact_solver.unequal_areas import UnequalAreas
from fem_reference.compliance.point_compliance import PointCompliance
from fem_reference.loads import NormalTarget, TangentialTarget, Triple

# Tolerance of the solver. With exact inverses the last Newton step has an error far below that of
# the increment.
ACCURATE = 1e-11
# Relative round-off of displacements. The shear is smaller than the pressure by the coefficient of
# friction, so that its relative round-off is larger by the inverse.
ROUND_OFF = 1e-15


@dataclass(frozen=True)
class PointProblem:
    """Contact problem of one increment at the points of the surface, with its loads.

    compliance  displacement of all points per traction on all points
    gap         gap without tractions (points,) [length]
    friction    Coulomb friction between the surfaces
    target      tangential displacement of the points under full stick and zero motion of the
                indenter (2, points) [length]: displacement at the start of the increment minus the
                rigid motion at the start, corrected for penalty springs and imposed strain
    normal      prescribed normal force or approach
    tangential  prescribed tangential loads or motions
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

    def limit_ratio(self, pressure: Vector, loads: tuple[float | None, ...] | Vector) -> float:
        """Compute the factor on given tangential loads at which all points slip [1].

        The factor is zero without friction at any point, and infinite without loads.

        pressure  pressure at the points (points,) [force/length^2]
        loads     loads of the tangential motions (3,); None for a load that is not prescribed
        """
        target = TangentialTarget(tuple(loads), (None, None, None))
        given = RigidMotions(2, self._rigid_motions(target))
        bound = self.scale.roots * self.bound(pressure)
        if not np.any(bound):
            return 0.0
        return limit_load(given, bound)[0] if np.any(given.prescribed_forces) else np.inf

    @cached_property
    def scale(self) -> UnequalAreas:
        """Conversion to points of equal area."""
        return UnequalAreas(self.compliance.areas)

    @cached_property
    def _closing(self) -> RigidMotion:
        """Approach of the indenter, with prescribed force or value."""
        shape = np.ones((1, len(self.gap)))
        return self.scale.rigid_motion(shape, 1.0, self.normal.force, self.normal.approach)

    def _rigid_motions(self, target: TangentialTarget) -> tuple[RigidMotion, ...]:
        """Return the motions that symmetry allows and the target prescribes, times `reaches`."""
        motions, reaches = self.compliance.motions, self.compliance.reaches
        return tuple(
            self.scale.rigid_motion(motions[k], reaches[k], target.loads[k], target.motions[k])
            for k in self.compliance.acting
            if target.loads[k] is not None or target.motions[k] is not None
        )

    @cached_property
    def coupled(self) -> CoupledProblem:
        """The problem of pressure and shear for points of equal area."""
        compliance, scale, n = self.compliance, self.scale, len(self.gap)
        carries_shear, friction = compliance.carries_shear, self.friction
        matrix = compliance.equal_area_matrix
        inverse = DenseInverse(matrix)
        return scale.problem(
            product=lambda t: (matrix @ t.ravel()).reshape(t.shape),
            inverse=inverse,
            dense=lambda: inverse,
            own=np.diagonal(matrix)[: 2 * n],
            gap=self.gap,
            friction_limit=self.bound,
            friction_slope=lambda p: np.where(carries_shear, friction.slope(p), 0.0),
            target=self.target,
            closing=self._closing,
            shifting=self._rigid_motions(self.tangential),
        )


@dataclass(frozen=True)
class PointSolution:
    """Solution of the contact problem of an increment: tractions and rigid motions of the indenter.

    pressure   pressure at the points (points,) [force/length^2]
    shear      shear at the points (2, points) [force/length^2]
    approach   rigid approach [length]
    motions    shifts along and across the load [length] and twist [radian]; None if the loads are
               at the friction limit (gross slip)
    in_slip    True for slipping points (points,)
    outer_iterations, solves
               numbers of outer iterations of the coupled problem and of linear iterations
    algorithm  name of the algorithm that found the solution; None without coupling
    """

    pressure: Vector
    shear: Field
    approach: float
    motions: Triple | None
    in_slip: Mask
    outer_iterations: int
    solves: int
    algorithm: str | None = None


def solve_points(
    problem: PointProblem, pressure: Vector, shear: Field, motions: Triple, tolerance: float
) -> PointSolution:
    """Solve pressure and shear of an increment at the points of the surface.

    problem                   compliance, gap, friction and prescribed loads of the increment
    pressure, shear, motions  initial guesses: p (points,), q (2, points), shifts and twist
    tolerance                 limit of the dimensionless residuals
    raises                    NotConverged
    """
    coupled, s = problem.coupled, problem.scale.roots
    round_off = ROUND_OFF / (problem.friction.largest or 1.0)
    aim = min(tolerance, max(ACCURATE, round_off))
    acting = list(problem.compliance.acting)
    motion = (np.array(motions) * problem.compliance.reaches)[acting]
    p, q = s * _loaded(problem, pressure), s * shear
    if problem.compliance.couples:
        found = solve_together(coupled, p, q, motion, aim)
        return PointSolution(
            found.pressure / s,
            found.shear / s,
            float(found.closing[0]),
            None if found.at_limit else _motions(problem, found.motion),
            found.in_slip,
            found.outer_iterations,
            found.iterations,
            found.algorithm,
        )
    pressed = solve_pressure(coupled.pressing, p, aim)
    p, approach = pressed.pressure, float(pressed.motion[0])
    bound = coupled.friction_limit(p)
    if coupled.exhausts_friction(bound):
        q, motion = full_slip(coupled.shifting, bound, motion)
        moved = None if coupled.shifting.held.each else _motions(problem, motion)
        in_slip = bound > 0
        return PointSolution(p / s, q / s, approach, moved, in_slip, 1, pressed.iterations)
    start = Point(q, coupled.tangential(q))
    sheared = solve_shear(coupled.shearing_at(p), start, motion, aim)
    return PointSolution(
        p / s,
        sheared.shear / s,
        approach,
        _motions(problem, sheared.motion),
        sheared.in_slip,
        1,
        pressed.iterations + sheared.iterations,
    )


def _motions(problem: PointProblem, motion: Vector) -> Triple:
    """Return shifts and twist from motions times `reaches`; 0 where symmetry excludes them."""
    found = np.zeros(3)
    acting = list(problem.compliance.acting)
    found[acting] = motion / problem.compliance.reaches[acting]
    along, across, twist = found.tolist()
    return along, across, twist


def _loaded(problem: PointProblem, pressure: Vector) -> Vector:
    """Return the initial guess of the pressure, which must touch at some point with friction.

    If it does not, it is that of separate points at half the approach, or uniform under a force.

    pressure  pressure at the start of the increment (points,) [force/length^2]
    """
    approach = problem.normal.approach
    everywhere = np.ones_like(pressure)
    lacks_friction = np.any(problem.bound(everywhere)) and not np.any(problem.bound(pressure))
    if np.any(pressure > 0) and not lacks_friction:
        return pressure
    if approach is None:
        return everywhere
    n = len(pressure)
    own = np.diagonal(problem.compliance.matrix)[2 * n :] / problem.compliance.areas
    depth = 0.5 * (approach + float(np.min(problem.gap)))
    return np.maximum(depth - problem.gap, 0.0) / own
