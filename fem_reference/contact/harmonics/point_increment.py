"""One load increment on points: from state to state."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from contact_scene.friction import sliding_friction
from contact_scene.residuals import Residuals
from contact_scene.solver_errors import NotConverged, motion_undefined
from fem_reference.contact.augmentation import Penalty, augmented
from fem_reference.contact.first_touch import touching_share
from fem_reference.contact.friction_limit import reaches_limit
from fem_reference.contact.harmonics.continuation import solve_by_continuation
from fem_reference.contact.harmonics.point_contact import PointContact
from fem_reference.contact.harmonics.point_state import ROUND_OFF, PointState, length, longest
from fem_reference.contact.harmonics.root import Start, solve_by_newton
from fem_reference.contact.harmonics.turns import (
    CoupledProblem,
    CoupledSolution,
    TurnsFailed,
    solve_coupled,
)
from fem_reference.contact.ring_edge import contact_edge
from fem_reference.loads import NormalTarget, TangentialTarget
from fem_reference.residuals import (
    LEAST_SLIP,
    complementarity,
    friction_cone,
    penetration,
)

Field = NDArray[np.float64]
Vector = NDArray[np.float64]

MOST_ATTEMPTS = 4
SPRINGS_ALONE = Penalty(augmentations=0, overlap=np.inf)


def advance(
    contact: PointContact,
    before: PointState | None,
    normal: NormalTarget,
    tangential: TangentialTarget,
    tolerance: float,
    penalty: Penalty = SPRINGS_ALONE,
) -> PointState:
    """The state at the end of an increment; all its residuals are at most the tolerance.

    penalty  how often springs are corrected, where there are any
    raises   NotConverged, SurfacesOverlap, GrossSliding
    """
    before = before or contact.untouched()
    if before.tangential_shift is None:
        raise motion_undefined()
    loads = normal, tangential
    carried = np.concatenate([before.shear, before.pressure[None]])
    if not (any(contact.compliance.springs) and penalty.augmentations):
        carried = np.zeros_like(carried)
    first = _reached(contact, before, before, carried, loads, tolerance)
    if not any(contact.compliance.springs):
        return first

    def again(last: PointState) -> PointState:
        carried = np.concatenate([last.shear, last.pressure[None]])
        state = _reached(contact, before, last, carried, loads, tolerance)
        turns, solves = last.turns + state.turns, last.solves + state.solves
        return replace(state, turns=turns, solves=solves, augmentations=last.augmentations + 1)

    return augmented(first, again, lambda state: state.left, penalty, 0)[-1]


def _reached(
    contact: PointContact,
    before: PointState,
    start: PointState,
    carried: Field,
    loads: tuple[NormalTarget, TangentialTarget],
    tolerance: float,
) -> PointState:
    """The state that springs lead to beside tractions (3, points) that need none.

    Judged by displacements computed afresh from the final tractions, harmonic by harmonic.
    raises  NotConverged, GrossSliding
    """
    compliance, (normal, tangential) = contact.compliance, loads
    (across, along), shift = compliance.springs, before.tangential_shift or 0.0
    target = before.displacement + along * carried[:2] - shift * compliance.e_x
    gap = contact.gap - across * carried[2]
    problem = CoupledProblem(compliance, gap, contact.friction, target, normal, tangential)
    p, q, motion = start.pressure, start.shear, (start.tangential_shift or shift, start.approach)
    aim, turns, solves = 0.5 * tolerance, 0, 0
    for _ in range(MOST_ATTEMPTS):
        solution = _solved(problem, p, q, motion, aim)
        turns, solves = turns + solution.turns, solves + solution.solves
        limit = float(np.sum(compliance.areas * problem.bound(solution.pressure)))
        reaches_limit(tangential.force, limit, unit=1.0)
        state = _Trial.of(problem, before, carried, solution).state(turns, solves)
        if state.residuals.worst <= tolerance:
            return state
        p, q, aim = solution.pressure, solution.shear, 0.1 * aim
        motion = motion[0] if solution.shift is None else solution.shift, solution.approach
    raise NotConverged("the coupled increment", solves, state.residuals.worst, tolerance)


def _solved(
    problem: CoupledProblem, p: Vector, q: Field, motion: tuple[float, float], tolerance: float
) -> CoupledSolution:
    """By turns, which need a shift only below the friction limit; else by Newton's method; where
    that runs to and fro, by continuation."""
    try:
        return solve_coupled(problem, p, q, tolerance)
    except TurnsFailed as error:
        failed = error
    start, spent = Start(p, q, *motion), failed.solves
    for solve in (solve_by_newton, solve_by_continuation):
        try:
            solution = solve(problem, start, tolerance)
        except NotConverged as error:
            spent += error.iterations
            continue
        return replace(solution, turns=failed.turns, solves=spent + solution.solves)
    raise NotConverged("the coupled increment", spent, failed.residual, failed.tolerance)


@dataclass(frozen=True)
class _Trial:
    """A solution with what follows from it.

    carried            as of the state
    displacement, gap  u_t and g at the points, with the strain of springs [length]
    passed             how far the indenter's particles moved past the body's in the increment,
                       (2, points): that way they pull these along
    """

    problem: CoupledProblem
    before: PointState
    carried: Field
    solution: CoupledSolution
    displacement: Field
    gap: Vector
    passed: Field

    @classmethod
    def of(
        cls, problem: CoupledProblem, before: PointState, carried: Field, solution: CoupledSolution
    ) -> "_Trial":
        compliance, shift = problem.compliance, solution.shift
        u_t, u_z = compliance.displacement(solution.pressure, solution.shear)
        passed = np.zeros_like(u_t)
        if shift is not None:
            passed = shift * compliance.e_x + problem.target - u_t
        gap = problem.gap + u_z - solution.approach
        u_t = u_t - compliance.springs[1] * carried[:2]
        return cls(problem, before, carried, solution, u_t, gap, passed)

    def state(self, turns: int, solves: int) -> PointState:
        """The state that the solution makes."""
        problem, before, solution = self.problem, self.before, self.solution
        p, q, w = solution.pressure, solution.shear, problem.compliance.areas
        in_stick = (problem.friction.limit(p) > 0) & ~solution.in_slip
        slipped = np.where(in_stick, 0.0, self._touching_share() * self.passed)
        energy = None
        if solution.shift is not None and before.dissipated_energy is not None:
            bounds = problem.bound(before.pressure), problem.bound(p)
            friction = sliding_friction(before.shear, q, self.passed, *bounds)
            energy = before.dissipated_energy + float(np.sum(w * friction * slipped))
        return PointState(
            compliance=problem.compliance,
            pressure=p,
            shear=q,
            displacement=self.displacement,
            gap=self.gap,
            slip=before.slip - slipped,
            in_stick=in_stick,
            limit=float(np.sum(w * problem.bound(p))),
            normal_force=float(np.sum(w * p)),
            approach=solution.approach,
            tangential_force=float(np.sum(problem.compliance.along_x * q)),
            tangential_shift=solution.shift,
            dissipated_energy=energy,
            residuals=self._residuals(),
            carried=self.carried,
            turns=turns,
            solves=solves,
        )

    def _touching_share(self) -> Vector:
        """See `touching_share`; at the points (points,), ray by ray."""
        compliance, before = self.problem.compliance, self.before
        starts, ends, open_before = (
            compliance.scalar_on_grid(values).T
            for values in (
                before.pressure,
                self.solution.pressure,
                (before.pressure == 0) & (before.gap > 0),
            )
        )
        radii, table = compliance.rings.radii, compliance.rings.edge
        rays = []
        for start, end, apart in zip(starts, ends, open_before, strict=True):
            edges = (contact_edge(radii, pressure, table) for pressure in (start, end))
            rays.append(touching_share(radii, apart, end == 0, *edges))
        axis, *rings = np.stack(rays, axis=1)
        return np.concatenate([axis[:1], *rings])

    def _residuals(self) -> Residuals:
        problem, solution, g = self.problem, self.solution, self.gap
        p, q, w = solution.pressure, solution.shear, problem.compliance.areas
        bound, approach = problem.bound(p), solution.approach
        normal, force = problem.normal.force, problem.tangential.force
        limit = np.sum(w * bound)
        # What shear alone does: where all sticks from the start, all together moves nothing.
        by_shear, _ = problem.compliance.displacement(np.zeros_like(p), q)
        lengths = longest(by_shear), longest(self.before.displacement), ROUND_OFF * approach
        moved = float(np.max(lengths))
        slid = solution.shift is not None
        return Residuals(
            complementarity=complementarity(p, w * g, w, approach),
            penetration=penetration(w * g, w, approach),
            normal_equilibrium=(
                None if normal is None else float(abs(np.sum(w * p) - normal) / normal)
            ),
            friction_cone=friction_cone(length(q), bound),
            slip_direction=slip_direction(q, bound, self.passed, w, moved) if slid else None,
            tangential_equilibrium=(
                None
                if force is None or limit == 0
                else float(abs(np.sum(problem.compliance.along_x * q) - force) / limit)
            ),
        )


def slip_direction(q: Field, bound: Vector, passed: Field, areas: Vector, moved: float) -> float:
    """∫(b|s| − q·s) / ∫b|s| with s the motion of the indenter past the body: zero if the shear has
    its full length along s wherever there is slip.

    moved  largest displacement: the scale where slip nearly vanishes and has no direction
    """
    work = areas * bound * length(passed)
    missing = np.sum(work - areas * np.sum(q * passed, axis=0))
    scale = np.maximum(np.sum(work), LEAST_SLIP * moved * np.sum(areas * bound))
    return 0.0 if scale == 0 else float(missing / scale)
