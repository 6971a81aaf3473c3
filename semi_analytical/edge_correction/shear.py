"""Deferred correction of the shear of uncoupled bodies for a stick border that cuts cells.

Let n be the direction of slip, p the pressure and µ the coefficient of friction. The shear is q =
µp n - d. The deficit d from gross slip vanishes in the slip zone. It falls to zero towards the
stick border like the pressure of a smaller contact (Cattaneo 1938). Fits of p and d therefore yield
the shear within the cells. After a load reversal from the shear q' with the direction of slip n',
the change of the shear obeys Cattaneo's law with twice the friction (Masing's rule, Mindlin and
Deresiewicz 1953): q = q' + µp (n - n') - d.
"""

from dataclasses import dataclass, replace
from math import inf

import numpy as np

from contact_scene.array_types import Field, Mask, Vector, VectorField
from contact_scene.solver_errors import NotConverged
from contact_solver.admissible_shear import magnitude
from contact_solver.conjugate_gradients import Point
from contact_solver.shear import ShearProblem, ShearSolution, solve_shear
from semi_analytical.edge.corrected import CorrectedShear
from semi_analytical.edge.displacement import Within
from semi_analytical.edge.subcell_tractions import (
    SubcellTractions,
    fit_edge,
)
from semi_analytical.edge_correction.operators import EdgeOperators
from semi_analytical.edge_correction.pressure import (
    INNER_REDUCTION,
    LEAST_SETTLED,
    MAX_ITERATIONS,
    MAX_UNSAFE,
    edge_travel,
    has_settled,
    left_over,
    relaxation_factor,
)
from semi_analytical.edge_correction.shear_at_edge import direction_of_slip
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.increments.tangential_state import TangentialState
from semi_analytical.operator.points import map_of_points, points_of, shear_inverse_in

WithinVector = tuple[Within, Within]


@dataclass(frozen=True)
class Deficit:
    """Shear deficit in the stick zone: shear of gross slip minus actual shear.

    The edge correction of the shear fits the deficit near the border of the stick zone.

    shear  deficit, zero in the slip zone (2, nx, ny) [force/length^2]
    full   shear of gross slip (2, nx, ny) [force/length^2]
    slip   direction of slip, extended to all cells (2, nx, ny)
    stick  cells that may have a deficit (nx, ny)
    edge   subcell values of the magnitude of the deficit along the stick border
    """

    shear: VectorField
    full: VectorField
    slip: VectorField
    stick: Mask
    edge: SubcellTractions


def sliding_shear(
    operators: EdgeOperators, bound: Field, limit: Within, solved: TangentialState
) -> CorrectedShear:
    """Return the corrected shear in gross slip: the friction limit µp in the direction of slip.

    operators  surface displacements by tractions that vary within cells
    bound      friction limit µp, mean of each cell (nx, ny) [force/length^2]
    limit      variation of µp within the cells
    solved     tangential state without a stick zone; supplies the direction of slip and the shift
    """
    slip = direction_of_slip(solved.shear, magnitude(solved.shear) > 0)
    shear, nowhere = bound * slip, np.zeros(bound.shape, dtype=bool)
    x, y = (
        Within.combine(n * limit.slopes + np.stack(np.gradient(n)) * bound, [(n, limit)])
        for n in slip
    )
    return CorrectedShear(
        shear=shear,
        within=(x, y),
        slip=slip,
        displacement=operators.displace_means(shear) + operators.displace_by_shear(x, y),
        shift=solved.shift,
        stick=nowhere,
        stick_cells=0.0,
    )


def grown_shear(
    operators: EdgeOperators,
    last: CorrectedShear,
    ratio: Vector,
    change: Field,
    grown: Within,
) -> CorrectedShear:
    """Return the corrected shear of a contact that has grown without slip: q' + k Δp.

    operators  surface displacements by tractions that vary within cells
    last       corrected shear q' at the start, with stick zone and shift at the end
    ratio      ratio k of the growth of shear and pressure (2,)
    change     change Δp of the corrected pressure (nx, ny) [force/length^2]
    grown      change of the variation of the pressure within the cells
    """
    whole = np.ones_like(change)
    x, y = (
        Within.combine(one.slopes + k * grown.slopes, [(whole, one), (k * whole, grown)])
        for k, one in zip(ratio, last.within, strict=True)
    )
    shear = last.shear + ratio[:, None, None] * change
    displacement = operators.displace_means(shear) + operators.displace_by_shear(x, y)
    return replace(
        last, shear=shear, within=(x, y), displacement=displacement, slip=np.zeros_like(shear)
    )


@dataclass(frozen=True)
class EdgeShearProblem:
    """Tangential problem of an increment of uncoupled bodies at the edge-corrected pressure.

    The previous state is the corrected state from which the shear and the stick border of this
    increment follow. All fields are on the full window.

    operators      surface displacements by tractions that vary within cells
    bound          friction limit µp, mean of each cell (nx, ny) [force/length^2]
    limit          variation of µp within the cells
    force          tangential force of the solved state (2,), in force and displacement control
    target         tangential displacement minus rigid shift of the previous state, corrected for
                   the change of bulk strain (2, nx, ny) [length]
    before         shear of the previous state (2, nx, ny), and its variation within the cells
    reversed_slip  direction of slip of the previous state (2, nx, ny) after a load reversal, else
                   None
    tolerance      residual tolerance of the tangential solves
    """

    operators: EdgeOperators
    bound: Field
    limit: Within
    force: Vector
    target: VectorField
    before: tuple[VectorField, WithinVector]
    reversed_slip: VectorField | None
    tolerance: float

    def gross_slip_shear(self, bound: Field, slip: VectorField, before: VectorField) -> VectorField:
        """Return the shear (2, nx, ny) in gross slip at the edge-corrected pressure.

        The shear is µp n, or q' + µp (n - n') after a load reversal from the shear q' with the
        direction of slip n'.

        bound   friction limit µp (nx, ny) [force/length^2]
        slip    direction of slip n (2, nx, ny)
        before  shear q' of the previous state (2, nx, ny) [force/length^2]
        """
        last = self.reversed_slip
        return bound * slip if last is None else before + bound * (slip - last)

    def deficit(
        self,
        q: VectorField,
        bound: Field,
        before: VectorField,
        stick: Mask,
        edge: SubcellTractions | None,
    ) -> Deficit | None:
        """Compute the shear deficit (gross slip minus actual shear), fitted at the stick border.

        None is returned if no stick border can be fitted. The direction of slip in the stick zone
        is that of adjacent slipping cells, and their mean far from them.

        q       shear (2, nx, ny) [force/length^2]
        bound   friction limit µp (nx, ny) [force/length^2]
        before  shear of the previous state (2, nx, ny) [force/length^2]
        stick   cells that may have a deficit (nx, ny)
        edge    fitted stick border of the preceding iteration; None in the first one
        """
        reached = np.zeros_like(stick) if edge is None else edge.outer
        slips = (bound > 0) & ~(stick & ~reached)
        if not np.any(slips) or not np.any(stick):
            return None
        slip = direction_of_slip(q, slips)
        full = self.gross_slip_shear(bound, slip, before)
        shear = np.where(stick, full - q, 0.0)
        border = fit_edge(magnitude(shear), stick, edge)
        if border is None or border.unsafe > MAX_UNSAFE:
            return None
        return Deficit(shear, full, slip, stick, border)

    def within(self, q: VectorField, deficit: Deficit) -> WithinVector:
        """Compute the variation of both shear components within the cells, for the edge correction.

        Deep in the stick zone the result is the variation of the previous state plus central
        differences of the change of the shear. Elsewhere the variations of the friction limit and
        of the shear deficit are combined.

        q        cell means of the shear (2, nx, ny) [force/length^2]
        deficit  deficit of q from gross slip, with the fitted stick border
        """
        edge = deficit.edge
        d = magnitude(deficit.shear)
        along = deficit.shear / np.where(d > 0, d, 1.0)
        deep = deficit.stick.copy()
        deep[edge.i, edge.j] = False
        of_d = Within.from_subcells(d, edge.i, edge.j, edge.parts)
        slips = (self.bound > 0) & ~deficit.stick
        last, within_last = self.before
        after_reversal = 0.0 if self.reversed_slip is None else 1.0
        found = []
        for k in (0, 1):
            n = deficit.slip[k] - (0.0 if self.reversed_slip is None else self.reversed_slip[k])
            of_direction = np.stack(np.gradient(n)) * np.where(slips, self.bound, 0.0)
            outer = n * self.limit.slopes + of_direction - along[k] * of_d.slopes
            outer += after_reversal * within_last[k].slopes
            inner = np.stack(np.gradient(q[k] - last[k])) + within_last[k].slopes
            terms = (
                (np.where(deep, 0.0, n), self.limit),
                (-along[k], of_d),
                (np.where(deep, 1.0, after_reversal), within_last[k]),
            )
            found.append(Within.combine(np.where(deep, inner, outer), terms))
        return found[0], found[1]

    def solve(
        self, q: VectorField, motion: Field, deficit: Deficit, u: VectorField
    ) -> ShearSolution:
        """Solve the tangential problem for a given displacement by shear variation within cells.

        The solution is computed on the reduced domain and extended to the full window. In cells
        that the stick border cuts and whose centre slips, the fitted deficit lowers the friction
        limit.

        q        initial guess of the shear (2, nx, ny) [force/length^2]
        motion   initial guess of the rigid tangential shift (2,) [length]
        deficit  shear deficit with the fitted stick border
        u        tangential displacement by the shear variation within cells (2, nx, ny) [length]
        """
        model = self.operators.model
        domain, operator = model.domain, model.operator(model.grid.cells)
        outer = magnitude(deficit.full - deficit.edge.means * deficit.slip)
        bound = np.where(deficit.edge.outer, np.minimum(outer, self.bound), self.bound)
        q = domain.restrict(q)
        load = TangentialTarget(force=self.force)
        problem = ShearProblem(
            map_of_points(operator.tangential, q.shape[1:]),
            shear_inverse_in(operator, q.shape[1:], model.self_compliance),
            points_of(domain.restrict(bound)),
            points_of(domain.restrict(self.target - u)),
            load.motions(model),
            model.self_compliance,
        )
        start = Point(points_of(q), points_of(operator.tangential(q)))
        guess = load.scaled(model, motion)
        solution = solve_shear(problem, start, guess, self.tolerance, INNER_REDUCTION)
        return replace(
            solution,
            shear=domain.extend(solution.shear.reshape(q.shape)),
            displacement=domain.extend(solution.displacement.reshape(q.shape)),
            in_slip=domain.extend(solution.in_slip.reshape(q.shape[1:])),
            motion=load.unscaled(model, solution.motion),
        )


def edge_shear(
    problem: EdgeShearProblem, solved: TangentialState, before: VectorField
) -> CorrectedShear | None:
    """Correct the shear of a state for a stick border that cuts cells, by fixed-point iteration.

    None is returned if the stick border cannot be fitted or the iteration does not converge.

    problem  tangential problem at the pressure of the edge correction
    solved   tangential state with uniform tractions in each cell
    before   uncorrected shear of the previous state (2, nx, ny) [force/length^2]
    """
    assert solved.shift is not None
    # The deficit at the solved pressure is the initial guess of that at the corrected pressure.
    limit = problem.operators.model.friction.limit(solved.pressure)
    deficit = problem.deficit(solved.shear, limit, before, solved.in_stick, None)
    if deficit is None:
        return None
    full = problem.gross_slip_shear(problem.bound, deficit.slip, problem.before[0])
    deficit = replace(deficit, full=full)
    q, motion = full - deficit.shear, solved.shift
    step, factor, changes, travel = np.zeros_like(q), 1.0, list[float](), inf
    for number in range(MAX_ITERATIONS):
        within = problem.within(q, deficit)
        u = problem.operators.displace_by_shear(*within)
        try:
            solution = problem.solve(q, motion, deficit, u)
        except NotConverged:
            return None
        answer, motion = solution.shear, solution.motion
        last, step = step, answer - q
        changes.append(float(np.sum(magnitude(step)) / np.sum(problem.bound)))
        if has_settled(changes, travel) or number == MAX_ITERATIONS - 1:
            break
        edge, stick = deficit.edge, (problem.bound > 0) & ~solution.in_slip
        if number:
            factor = relaxation_factor(factor, last, step)
        q = q + factor * step
        following = problem.deficit(q, problem.bound, problem.before[0], stick | edge.outer, edge)
        if following is None:
            return None
        deficit, travel = following, edge_travel(edge, following.edge)
    if changes[-1] > LEAST_SETTLED:
        return None
    return CorrectedShear(
        shear=answer,
        within=within,
        slip=deficit.slip,
        displacement=solution.displacement + u,
        shift=motion,
        stick=deficit.edge.region,
        stick_cells=deficit.edge.area,
        change=changes[-1],
        radius_left=travel * left_over(changes),
    )
