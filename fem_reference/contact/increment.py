"""Solve one load increment: from the contact state at its start to the state at its end.

Pressure and shear follow from `contact_solver`. With a penalty an increment has several passes. The
multipliers of a pass are the tractions of the previous pass (see `augmented_lagrangian`).
"""

from dataclasses import dataclass, replace
from math import hypot

import numpy as np

from contact_scene.array_types import Field, Mask, Vector
from contact_scene.friction import sliding_friction
from contact_scene.friction_limit import reaches_limit, refuse_above_limit
from contact_scene.quantities.residuals import (
    Residuals,
    ShearResiduals,
)
from contact_scene.solver_errors import NotConverged, NothingTouches, motion_undefined
from contact_solver.residuals import (
    complementarity,
    equilibrium,
    friction_cone,
    penetration,
    slip_direction,
)
from fem_reference.contact.augmented_lagrangian import repeat_passes
from fem_reference.contact.contact_status import contact_status
from fem_reference.contact.free_motion import free_motion
from fem_reference.contact.point_contact import PointContact
from fem_reference.contact.point_problem import PointProblem, PointSolution, solve_points
from fem_reference.contact.point_state import PointState
from fem_reference.loads import TWIST, Loads, Triple
from fem_reference.plan import Path

AT_REST: Triple = (0.0, 0.0, 0.0)
MAX_ATTEMPTS = 4
# Smallest tangential displacement over the approach that is not round-off of uncoupled bodies.
ROUND_OFF = 1e-6
# Largest ratio of the radius of the zone of equal elements to the contact radius.
WIDEST_ZONE = 1.25


def advance(
    contact: PointContact, before: PointState | None, loads: Loads, tolerance: float
) -> PointState:
    """Solve one load increment: compute the contact state at its end from the state at its start.

    All residuals of the computed state are at most the tolerance.

    contact    contact problem at the points of the surface, without loads
    before     state at the start of the increment; None before first contact
    loads      prescribed loads or motions at the end of the increment
    tolerance  upper limit of every residual [1]
    raises     NotConverged, SurfacesOverlap, GrossSliding, NothingTouches
    """
    _refuse_unresolved(contact, loads)
    before = before or contact.state_before_contact()
    if before.motions is None and not _is_at_limit(contact, loads):
        raise motion_undefined()
    increment = _Increment(contact, before, loads, tolerance)
    passes = increment.all_passes()
    if before.motions is None:
        return increment.end_state(passes)
    solution = passes[-1].solution
    free = free_motion(contact, before, loads, solution.pressure, solution.approach)
    if free is not None:
        increment = replace(increment, free=free)
        passes = increment.all_passes()
    return increment.end_state(passes)


def solved_problem(
    contact: PointContact, before: PointState | None, state: PointState
) -> PointProblem:
    """Return the contact problem of a solved load increment under the exact laws.

    contact  contact problem at the points of the surface, without loads
    before   state at the start of the increment; None before first contact
    state    solved state at the end
    """
    before, loads, free = before or contact.state_before_contact(), state.prescribed, None
    assert loads is not None
    if before.motions is not None:
        free = free_motion(contact, before, loads, state.pressure, state.approach)
    increment = _Increment(contact, before, loads, 0.0, 0.0 if free is None else free)
    return increment.problem(np.zeros_like(state.tractions))


def _is_at_limit(contact: PointContact, loads: Loads) -> bool:
    """Return True if the prescribed tangential force is at the friction limit µW.

    The result is False if the friction limit depends on the pressure, as with a torque.

    contact  contact problem, with the friction law
    loads    prescribed loads at the end of the increment
    """
    *forces, torque = loads.tangential.loads
    pushing = [force for force in forces if force is not None]
    W = loads.normal.force
    if W is None or torque or not pushing:
        return False
    limit = contact.friction.largest_tangential_force(W)
    return limit is not None and reaches_limit(hypot(*pushing), limit)


def _refuse_unresolved(contact: PointContact, loads: Loads) -> None:
    """Raise NothingTouches if a prescribed approach is at most the smallest mean gap of a ring."""
    approach, gap = loads.normal.approach, float(np.min(contact.gap))
    if approach is not None and approach <= gap:
        raise NothingTouches(
            f"no ring comes into contact: the approach is {approach:.3g} m, the mean gap at the "
            f"innermost ring {gap:.3g} m; use a larger approach or more elements per radius"
        )


@dataclass(frozen=True)
class _Pass:
    """Solution of one penalty pass of a load increment, with its displacements and residuals.

    A pass is one solve of the contact problem of the increment. With a penalty an increment has
    several passes. The tractions of a pass are the multipliers of the next pass. The exact contact
    law needs one pass with zero multipliers.

    problem       compliance, gap, friction and prescribed loads of the pass
    solution      tractions and rigid motion of the indenter
    multiplier    tractions without the contribution of the penalty springs, r, θ, z (3, points)
    displacement  tangential displacement of the bodies (2, points) [length]
    law_gap       gap plus the strain of the springs (points,), zero in contact [length]
    passed        slip of the indenter relative to the body in the increment, minus the strain of
                  the springs (2, points) [length]
    motions       shifts along and across the load [length] and twist [radian]; None at the friction
                  limit under prescribed loads
    residuals     residuals of the contact and friction laws
    outer_iterations
                  number of outer iterations in all attempts
    solves        number of linear iterations in all attempts
    """

    problem: PointProblem
    solution: PointSolution
    multiplier: Field
    displacement: Field
    law_gap: Vector
    passed: Field
    motions: Triple | None
    residuals: Residuals
    outer_iterations: int
    solves: int

    @property
    def tractions(self) -> Field:
        """Shear and pressure of a penalty pass at all points, in one array (3, points).

        The components are r, θ, z [force/length^2]. These tractions are the multipliers of the next
        pass.
        """
        return np.concatenate([self.solution.shear, self.solution.pressure[None]])

    @property
    def strain(self) -> Field:
        """Deformation of the penalty springs between the surfaces (3, points) [length].

        The components are r, θ, z. The deformation is the compliance of the springs times the part
        of the tractions that the springs carry.
        """
        return self.problem.compliance.springs * (self.tractions - self.multiplier)

    @property
    def overlap(self) -> float:
        """Largest overlap of the surfaces that the penalty springs permit [length].

        The overlap is the normal deformation of the springs at points with pressure. The exact law
        has none.
        """
        loaded = self.solution.pressure > 0
        return float(np.max(np.abs(self.strain[2]), where=loaded, initial=0.0))

    @property
    def overlap_share(self) -> float:
        """Largest overlap of the surfaces by the penalty springs, over the rigid approach [1].

        Used as the relative error of the penalty in the normal direction.
        """
        return over(self.overlap, abs(self.solution.approach))


@dataclass(frozen=True)
class _Increment:
    """Solver of one load increment, from a contact state to prescribed loads, in penalty passes.

    A pass is a solve with given multipliers of the penalty law. The exact law needs one pass.

    contact    contact problem at the points of the surface, without loads
    before     contact state at the start of the increment
    loads      prescribed loads or motions at the end of the increment
    tolerance  upper limit of every residual [1]
    free       free motion of points until their contact (2, points) [length]; 0 without
    """

    contact: PointContact
    before: PointState
    loads: Loads
    tolerance: float
    free: Field | float = 0.0

    def all_passes(self) -> list[_Pass]:
        """Solve the contact problem of the increment in all its penalty passes.

        The exact law has one pass.
        """
        first, penalty = self.first_pass(), self.contact.penalty
        if penalty is None:
            return [first]
        # With stiff springs at Gauss points, one update is necessary for the accuracy of the mesh.
        fewest = int(self.contact.at_gauss_points)
        return repeat_passes(first, self.next_pass, self.penalty_error, penalty, fewest)

    def first_pass(self) -> _Pass:
        """Solve the contact problem of the increment with the initial penalty multipliers.

        The multipliers are the tractions at zero deformation of the penalty springs. Without a
        penalty they are zero, and this pass is the only one. With a penalty they are the shear at
        the start of the increment and, at nodes, the multiplier of the pressure at the start, so
        that the pressure changes with the loads only. An updated multiplier would change it without
        a load, and this change slips coupled bodies. At Gauss points the multiplier of the pressure
        is zero, because pressure oscillations would otherwise accumulate over the increments. At
        nodes both are zero if updates are not allowed.
        """
        before, penalty = self.before, self.contact.penalty
        multiplier = np.zeros_like(before.tractions)
        if self.contact.at_gauss_points:
            multiplier[:2] = before.shear
        elif penalty is not None and penalty.augmentations > 0:
            multiplier = np.concatenate([before.shear, before.multiplier[2:]])
        return self._solve_pass(multiplier, before.tractions, before.motions or AT_REST)

    def next_pass(self, last: _Pass) -> _Pass:
        """Solve the contact problem of the increment again, with updated penalty multipliers.

        The multipliers are the tractions of the last pass, so that the penalty springs carry less.
        In the result, the numbers of iterations and linear systems are the sums over all passes.

        last  solution of the last pass
        """
        motions = last.motions or self.before.motions or AT_REST
        after = self._solve_pass(last.tractions, last.tractions, motions)
        outer_iterations, solves = (
            last.outer_iterations + after.outer_iterations,
            last.solves + after.solves,
        )
        return replace(after, outer_iterations=outer_iterations, solves=solves)

    def penalty_error(self, one: _Pass) -> float:
        """Compute the relative error [1] of one penalty pass by the deformation of its springs.

        Passes are repeated until this error is allowed. The error is the largest of three ratios.
        The first is the largest overlap of the surfaces over the rigid approach. The second is the
        tangential strain of the springs over the largest tangential displacement by shear in the
        history, both as means weighted with the shear. The third is the first times the ratio of
        the tangential displacements by pressure and by shear: the overlap changes the pressure in
        this proportion, and an update of its multiplier slips coupled bodies without a load. The
        third applies at nodes only, and with updates: at Gauss points every increment starts
        without a multiplier, and without updates there is no such slip.

        At Gauss points the error is multiplied by (WIDEST_ZONE × a/b)², at most 1. Here a is the
        contact radius and b the outer radius of the mesh's contact zone. The discretisation error
        is proportional to the inverse of this square, and the error of the penalty need not be
        smaller.

        one  solution of the pass
        """
        least = ROUND_OFF * min(1.0, self.contact.friction.largest)
        moved = self.largest_displacement(one) + least * abs(one.solution.approach)
        shear, pressure, share = one.solution.shear, one.solution.pressure, one.overlap_share
        by_pressure, _ = self.contact.compliance.displacement(pressure, np.zeros_like(shear))
        strain = over(self.shear_weighted_mean(one, one.strain[:2]), moved)
        if not self.contact.at_gauss_points:
            slip = over(self.shear_weighted_mean(one, by_pressure), moved)
            updated = self.contact.penalty is not None and self.contact.penalty.augmentations > 0
            return max(share, strain, share * slip if updated else 0.0)
        rings = self.contact.rings
        touching = np.flatnonzero(one.solution.pressure > 0)
        reached = float(rings.radii[touching[-1]]) if len(touching) else rings.reach
        return max(share, strain) * min(1.0, WIDEST_ZONE * reached / rings.reach) ** 2

    def largest_displacement(self, one: _Pass) -> float:
        """Compute the largest mean displacement of the bodies by shear in the load history.

        The result [length] is the maximum over all increments, up to the given pass. The mean is
        taken over the contact, weighted with the shear. The tangential error of the penalty springs
        is divided by this displacement. The displacement of coupled bodies by pressure is left out,
        because it does not decrease with the coefficient of friction.

        one  solution of a pass of the current increment
        """
        by_shear = self._displacement_by_shear(one.solution.shear)
        by_shear -= self.contact.compliance.springs * one.solution.shear
        return max(self.before.moved, self.shear_weighted_mean(one, by_shear))

    def _displacement_by_shear(self, shear: Field) -> Field:
        """Compute the tangential displacement by shear without pressure (2, points) [length]."""
        return self.contact.compliance.displacement(np.zeros_like(shear[0]), shear)[0]

    def shear_weighted_mean(self, one: _Pass, vectors: Field) -> float:
        """Compute the mean length of tangential vectors over the contact, weighted with the shear.

        Used for the mean tangential displacement, and for the mean tangential strain of the penalty
        springs. The result has the unit of the vectors and is 0 without shear.

        one      solution of the penalty pass whose shear is the weight
        vectors  vectors at the points, such as displacements (2, points)
        """
        shear = self.contact.compliance.areas * np.hypot(*one.solution.shear)
        return over(float(np.sum(shear * np.hypot(*vectors))), float(np.sum(shear)))

    def end_state(self, passes: list[_Pass]) -> PointState:
        """Create the contact state at the end of the increment from its last penalty pass.

        Slip and dissipated energy are added to those at the start of the increment.

        passes  solutions of all passes; the exact law has one pass
        """
        contact, before, last = self.contact, self.before, passes[-1]
        compliance, problem, solution = contact.compliance, last.problem, last.solution
        p, q, w = solution.pressure, solution.shear, compliance.areas
        in_stick = (problem.friction.limit(p) > 0) & ~solution.in_slip
        slipped = np.where(in_stick, 0.0, self._touching_share(p) * last.passed)
        energy = None
        if last.motions is not None and before.dissipated_energy is not None:
            bounds = problem.bound(before.pressure), problem.bound(p)
            friction = sliding_friction(before.shear, q, last.passed, *bounds)
            energy = before.dissipated_energy + float(np.sum(w * friction * slipped))
        changed = np.hypot(*q - before.shear) * np.hypot(*slipped)
        target, force = problem.tangential, problem.normal.force
        carried = compliance.tangential_loads(q)
        stuck = in_stick & compliance.carries_shear
        # The friction limit is computed only where it decides the status.
        decided = not compliance.acting or bool(np.any(stuck))
        return PointState(
            axisymmetric=contact.axisymmetric,
            pressure=p,
            shear=q,
            displacement=last.displacement,
            multiplier=last.multiplier,
            gap=last.law_gap - last.strain[2],
            slip=before.slip - slipped,
            in_stick=in_stick,
            status=contact_status(
                (p > 0) & compliance.carries_shear,
                stuck,
                np.inf if decided else problem.limit_ratio(p, carried),
            ),
            normal_force=float(np.sum(w * p)) if force is None else force,
            approach=solution.approach,
            loads=_prescribed_or_carried(target.loads, carried, compliance.acting),
            motions=last.motions,
            twist=target.motions[TWIST],
            dissipated_energy=energy,
            residuals=last.residuals,
            friction_changed=float(np.sum(w * changed)),
            overlap=last.overlap,
            moved=self.largest_displacement(last),
            outer_iterations=last.outer_iterations,
            solves=last.solves,
            augmentations=len(passes) - 1,
            strain=self.loads.strain,
            algorithm=solution.algorithm,
            prescribed=self.loads,
        )

    def _solve_pass(self, multiplier: Field, start: Field, motions: Triple) -> _Pass:
        """Solve the contact problem of the increment for given multipliers of the penalty law.

        If a residual exceeds the tolerance, the solve is repeated with a smaller tolerance of the
        algorithm. The residuals follow from displacements that are computed again from the final
        tractions.

        multiplier  tractions without the contribution of the penalty springs, r, θ, z (3, points)
        start       initial guess of the tractions r, θ, z (3, points)
        motions     initial guess of the shifts and the twist
        raises      NotConverged, GrossSliding
        """
        problem = self.problem(multiplier)
        p, q = start[2], start[:2]
        aim, outer_iterations, solves = 0.5 * self.tolerance, 0, 0
        for _ in range(MAX_ATTEMPTS):
            solution = solve_points(problem, p, q, motions, aim)
            outer_iterations, solves = (
                outer_iterations + solution.outer_iterations,
                solves + solution.solves,
            )
            self._refuse_above_limit(problem, solution.pressure)
            done = self._judge_solution(problem, solution, multiplier, outer_iterations, solves)
            if done.residuals.worst <= self.tolerance:
                return done
            p, q = solution.pressure, solution.shear
            motions = solution.motions or motions
            aim *= 0.1
        raise NotConverged("the increment", solves, done.residuals.worst, self.tolerance)

    def problem(self, multiplier: Field) -> PointProblem:
        """Return the contact problem of the increment for given multipliers of the penalty law.

        multiplier  tractions without the contribution of the penalty springs, r, θ, z (3, points)
        """
        contact, before, loads = self.contact, self.before, self.loads
        compliance = contact.compliance
        # At Gauss points the strain of the springs at the start is omitted, because the
        # displacements of the bodies cannot follow it.
        strained = 0.0 if contact.at_gauss_points else before.shear - before.multiplier[:2]
        memory = before.displacement + compliance.springs * (multiplier[:2] + strained)
        return PointProblem(
            compliance,
            contact.gap - compliance.springs * multiplier[2],
            contact.friction,
            memory
            + self.free
            - np.tensordot(before.motions or AT_REST, compliance.motions, axes=1)
            - (loads.strain - before.strain) * compliance.stretch,
            loads.normal,
            loads.tangential,
        )

    @staticmethod
    def _refuse_above_limit(problem: PointProblem, pressure: Vector) -> None:
        """Raise GrossSliding if friction cannot carry the prescribed tangential loads.

        problem   problem with the friction limit of the points, and the prescribed loads
        pressure  solved pressure at the points (points,) [force/length^2]
        """
        loads = problem.tangential.loads
        acting = {k: loads[k] or 0.0 for k in problem.compliance.acting}
        torque = abs(acting.pop(TWIST, 0.0))
        force = hypot(*acting.values())
        if force or torque:
            refuse_above_limit(force, torque, problem.limit_ratio(pressure, loads))

    def _judge_solution(
        self,
        problem: PointProblem,
        solution: PointSolution,
        multiplier: Field,
        outer_iterations: int,
        solves: int,
    ) -> _Pass:
        """Compute displacements, slip and residuals of a solution of the increment.

        Return the solution together with these fields as a penalty pass. The residuals determine
        whether the solution is accepted.

        problem     compliance, gap, friction and prescribed loads
        solution    tractions and rigid motion of the indenter
        multiplier  tractions without the contribution of the penalty springs, r, θ, z (3, points)
        outer_iterations, solves
                    numbers of outer iterations and of linear iterations so far
        """
        compliance, motions = problem.compliance, solution.motions
        if motions is None and not np.any(problem.bound(solution.pressure)):
            # Without friction at any point the motion of the indenter is indeterminate and is kept.
            motions = self.before.motions
        u_t, u_z = compliance.displacement(solution.pressure, solution.shear)
        passed = np.zeros_like(u_t)
        if motions is not None:
            moved = np.tensordot(motions, compliance.motions, axes=1)
            passed = moved + problem.target - u_t
        gap = problem.gap + u_z - solution.approach
        # The tangential strain of the springs is not a displacement of the bodies.
        displacement = u_t - compliance.springs * solution.shear
        residuals = self._law_residuals(
            problem, solution, gap, passed if motions is not None else None
        )
        return _Pass(
            problem,
            solution,
            multiplier,
            displacement,
            gap,
            passed,
            motions,
            residuals,
            outer_iterations,
            solves,
        )

    def _touching_share(self, p: Vector) -> Vector:
        """Compute the contact fraction of each point: the part of the increment in contact.

        The fractions (points,) are between 0 and 1. They follow from the motion of the contact edge
        along the ray of the point. Used to count slip only while the surfaces are in contact.

        p  pressure at the end of the increment (points,)
        """
        compliance, before = self.contact.compliance, self.before
        rings = compliance.rings
        apart_before, apart = (before.pressure == 0) & (before.gap > 0), p == 0
        if np.array_equal(apart_before, apart):  # without the edges, which are expensive
            return np.where(apart, 0.0, 1.0)
        fields = apart_before, apart, before.pressure, p
        rays = zip(*(compliance.scalar_on_grid(values).T for values in fields), strict=True)
        shares = [
            touching_share(rings.radii, apart_before, apart, *map(rings.contact_edge, edges))
            for apart_before, apart, *edges in rays
        ]
        axis, *others = np.stack(shares, axis=1)
        return np.concatenate([axis[:1], *others])

    def _law_residuals(
        self, problem: PointProblem, solution: PointSolution, g: Vector, passed: Field | None
    ) -> Residuals:
        """Compute the residuals of the contact law, the friction law and the loads for a solution.

        With a penalty the residuals are those of the penalty law. The increment is converged if all
        residuals are at most the tolerance.

        problem   compliance, gap, friction and prescribed loads
        solution  tractions and rigid motion of the indenter
        g         gap plus the strain of the penalty springs (points,) [length]
        passed    slip in the increment minus the strain of the springs (2, points) [length]; None
                  if the motion of the indenter is undefined
        """
        p, q, w = solution.pressure, solution.shear, problem.compliance.areas
        bound, approach = problem.bound(p), solution.approach
        normal = problem.normal.force
        carried = float(np.sum(w * p))
        pressing = Residuals(
            complementarity=complementarity(w * p, g, approach),
            penetration=penetration(g, approach),
            normal_equilibrium=None if normal is None else abs(carried - normal) / normal,
        )
        if self.contact.rings.path is Path.PRESSING:
            return pressing
        direction = None
        if passed is not None:
            # Displacement by shear alone: under full stick from the start, a rigid motion has no
            # such displacement.
            by_shear = np.abs(self._displacement_by_shear(q))
            moved = np.maximum(by_shear, np.abs(self.before.displacement))
            moved = np.maximum(moved, ROUND_OFF * approach)
            direction = slip_direction(w * q, w * bound, passed, moved)
        acting, loads = problem.compliance.acting, problem.tangential.loads
        pushing, turning = equilibrium(
            problem.compliance.tangential_loads(q),
            [load if k in acting else None for k, load in enumerate(loads)],
            (float(np.sum(w * bound)), float(np.sum(w * problem.compliance.levers * bound))),
        )
        return pressing.with_shear(
            ShearResiduals(
                friction_cone=friction_cone(q, bound),
                slip_direction=direction,
                tangential_equilibrium=pushing,
                torque_equilibrium=turning,
            )
        )


def over(part: float, whole: float) -> float:
    """Compute the ratio part / whole of a relative error, also for a zero denominator.

    The ratio is 0 if the numerator `part` is zero, and infinite if only the denominator `whole` is
    zero.
    """
    if not part:
        return 0.0
    return part / whole if whole else float("inf")


def _prescribed_or_carried(
    prescribed: tuple[float | None, ...], carried: Vector, acting: tuple[int, ...]
) -> Triple:
    """Return the prescribed loads, else those of the shear (3,),
    on the motions that symmetry allows."""
    along, across, torque = (
        float(carried[k]) if load is None or k not in acting else load
        for k, load in enumerate(prescribed)
    )
    return along, across, torque


def touching_share(
    radii: Field, apart_before: Mask, apart: Mask, edge_before: float, edge: float
) -> Field:
    """Compute the contact fraction of each ring: the part of an increment in contact, 0 to 1.

    Particles slip past each other only while they are in contact. If the contact edge moves from a₀
    to a₁ and passes a ring of radius r, the ring is in contact for the fraction |a - r|/|a₁ - a₀|
    of the motion, with a the larger of a₀ and a₁. This fraction is correct to first order in the
    increment. The result has the shape (rings,).

    radii  radii of the rings (rings,) [length]
    apart_before, apart
           True for rings with a gap at the start, and at the end (rings,)
    edge_before, edge
           radius a₀ of the contact edge at the start, and a₁ at the end [length]; 0 without contact
    """
    widest, travel = max(edge_before, edge), abs(edge - edge_before)
    passed = apart_before != apart
    share = np.where(apart, 0.0, 1.0)
    if travel > 0:
        share[passed] = np.clip((widest - radii[passed]) / travel, 0.0, 1.0)
    return share
