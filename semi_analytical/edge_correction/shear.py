"""The shear with its edges inside the cells, at the border of stick as at that of contact.

With n the direction of slip, q = µp n - d: d vanishes where cells slip, and towards the border of
the stick zone it falls to zero like the pressure of a smaller contact (Cattaneo 1938). So q is
within the cells what p and d are. After a reversal the same holds of what the shear has changed by,
at twice the friction (Masing's rule: Mindlin and Deresiewicz 1953): q = q' + µp (n - n') - d, with
q' and n' before it.
"""

from dataclasses import dataclass, replace

import numpy as np

from contact_scene.array_types import Field, Mask, Vector, VectorField
from contact_scene.solver_errors import NotConverged
from semi_analytical.edge.corrected import CorrectedShear
from semi_analytical.edge.displacement import Within
from semi_analytical.edge.subcell_tractions import (
    SubcellTractions,
    rim,
)
from semi_analytical.edge_correction.operators import EdgeOperators
from semi_analytical.edge_correction.pressure import (
    INNER_REDUCTION,
    LEAST_SETTLED,
    MAX_ITERATIONS,
    MAX_UNSAFE,
    SETTLED,
    next_change,
    relaxation_factor,
)
from semi_analytical.edge_correction.shear_at_edge import direction_of_slip
from semi_analytical.increments.tangential_state import TangentialState
from semi_analytical.tangential.admissible_shear import (
    ShearSum,
    magnitude,
)
from semi_analytical.tangential.linearised_shear import Point
from semi_analytical.tangential.tangential_problem import (
    TangentialSolution,
    solve_tangential,
)

WithinVector = tuple[Within, Within]


@dataclass(frozen=True)
class Missing:
    """What is missing from full slip: shear (2, nx, ny), that of full slip (2, nx, ny), its
    direction (2, nx, ny), where there is anything missing (nx, ny), and the border of that."""

    shear: VectorField
    full: VectorField
    slip: VectorField
    stick: Mask
    edge: SubcellTractions


def sliding_shear(
    operators: EdgeOperators, bound: Field, limit: Within, solved: TangentialState
) -> CorrectedShear:
    """The shear where all slips: the limit, along the slip.

    bound, limit  see `ShearProblem`
    """
    slip = direction_of_slip(solved.shear, magnitude(solved.shear) > 0)
    shear, nowhere = bound * slip, np.zeros(bound.shape, dtype=bool)
    x, y = (
        Within.summed(n * limit.slopes + np.stack(np.gradient(n)) * bound, [(n, limit)])
        for n in slip
    )
    model = operators.model
    operator, domain = model.operator(model.grid.cells), model.domain
    by_means = domain.extend(operator.tangential(domain.restrict(shear)))
    return CorrectedShear(
        shear=shear,
        within=(x, y),
        slip=slip,
        displacement=by_means + operators.by_shear(x, y),
        shift=solved.shift,
        stick=nowhere,
        stick_cells=0.0,
        change=0.0,
    )


@dataclass(frozen=True)
class ShearProblem:
    """An increment at its corrected pressure.

    bound    µp (nx, ny) [force/length^2]
    limit    µp within the cells
    force    (2,) that the shear carries, that of cells however the shear is led
    target   u_t - shift of the state before (2, nx, ny) [length]
    before   its shear (2, nx, ny), and what that is within the cells
    turned   direction of its slip (2, nx, ny) where it is turned round; None where it goes on
    """

    operators: EdgeOperators
    bound: Field
    limit: Within
    force: Vector
    target: VectorField
    before: tuple[VectorField, WithinVector]
    turned: VectorField | None
    tolerance: float

    def full(self, bound: Field, slip: VectorField, before: VectorField) -> VectorField:
        """The shear if all slipped; turned round, if all did that slipped before."""
        return bound * slip if self.turned is None else before + bound * (slip - self.turned)

    def missing(
        self,
        q: VectorField,
        bound: Field,
        before: VectorField,
        stick: Mask,
        edge: SubcellTractions | None,
    ) -> Missing | None:
        """What is missing from full slip along the slip of the nearest slipping cell; None where
        there is no border of stick to fit.

        before  shear of the state before (2, nx, ny)
        edge    about the same border; None where there is none yet
        """
        reached = np.zeros_like(stick) if edge is None else edge.outer
        slips = (bound > 0) & ~(stick & ~reached)
        if not np.any(slips) or not np.any(stick):
            return None
        slip = direction_of_slip(q, slips)
        full = self.full(bound, slip, before)
        shear = np.where(stick, full - q, 0.0)
        border = rim(magnitude(shear), stick, edge)
        if border is None or border.unsafe > MAX_UNSAFE:
            return None
        return Missing(shear, full, slip, stick, border)

    def within(self, q: VectorField, missing: Missing) -> WithinVector:
        """What a shear is within the cells.

        Deep in the stick zone it is what it was, and central differences of what has come since.
        """
        edge = missing.edge
        d = magnitude(missing.shear)
        along = missing.shear / np.where(d > 0, d, 1.0)
        deep = missing.stick.copy()
        deep[edge.i, edge.j] = False
        of_d = Within.of(d, edge.i, edge.j, edge.parts)
        slips = (self.bound > 0) & ~missing.stick
        last, within_last = self.before
        since_turn = 0.0 if self.turned is None else 1.0
        found = []
        for k in (0, 1):
            n = missing.slip[k] - (0.0 if self.turned is None else self.turned[k])
            turns = np.stack(np.gradient(n)) * np.where(slips, self.bound, 0.0)
            outer = n * self.limit.slopes + turns - along[k] * of_d.slopes
            outer += since_turn * within_last[k].slopes
            since = np.stack(np.gradient(q[k] - last[k])) + within_last[k].slopes
            terms = (
                (np.where(deep, 0.0, n), self.limit),
                (-along[k], of_d),
                (np.where(deep, 1.0, since_turn), within_last[k]),
            )
            found.append(Within.summed(np.where(deep, since, outer), terms))
        return found[0], found[1]

    def solve(
        self, q: VectorField, motion: Field, missing: Missing, u: VectorField
    ) -> TangentialSolution:
        """The shear with the border of stick where it is, solved on the domain.

        Cells that the stick zone only reaches into are missing from full slip what the fit says.
        """
        model = self.operators.model
        domain, operator = model.domain, model.operator(model.grid.cells)
        reached = magnitude(missing.full - missing.edge.means * missing.slip)
        q, target = domain.restrict(q), domain.restrict(self.target - u)
        solution = solve_tangential(
            operator.tangential,
            operator.shear_inverse,
            domain.restrict(
                np.where(missing.edge.outer, np.minimum(reached, self.bound), self.bound)
            ),
            target,
            ShearSum(self.force / model.grid.cell_area, domain.summed),
            Point(q, operator.tangential(q)),
            motion,
            model.self_compliance,
            self.tolerance,
            INNER_REDUCTION,
        )
        return replace(
            solution,
            shear=domain.extend(solution.shear),
            displacement=domain.extend(solution.displacement),
            in_slip=domain.extend(solution.in_slip),
        )


def edge_shear(
    problem: ShearProblem, solved: TangentialState, before: VectorField
) -> CorrectedShear | None:
    """A solved shear with its edges inside the cells; None where that is not safe.

    before  shear that the solved one started from (2, nx, ny)
    """
    assert solved.shift is not None
    # What is missing at the solved pressure is about what is missing at the corrected one.
    limit = problem.operators.model.friction.limit(solved.pressure)
    missing = problem.missing(solved.shear, limit, before, solved.in_stick, None)
    if missing is None:
        return None
    full = problem.full(problem.bound, missing.slip, problem.before[0])
    missing = replace(missing, full=full)
    q, motion = full - missing.shear, solved.shift
    step, factor, changes = np.zeros_like(q), 1.0, list[float]()
    for number in range(MAX_ITERATIONS):
        within = problem.within(q, missing)
        u = problem.operators.by_shear(*within)
        try:
            solution = problem.solve(q, motion, missing, u)
        except NotConverged:
            return None
        answer, motion = solution.shear, solution.motion
        last, step = step, answer - q
        changes.append(float(np.sum(magnitude(step)) / np.sum(problem.bound)))
        if next_change(changes) <= SETTLED or number == MAX_ITERATIONS - 1:
            break
        edge, stick = missing.edge, (problem.bound > 0) & ~solution.in_slip
        if number:
            factor = relaxation_factor(factor, last, step)
        q = q + factor * step
        next_missing = problem.missing(
            q, problem.bound, problem.before[0], stick | edge.outer, edge
        )
        if next_missing is None:
            return None
        missing = next_missing
    if changes[-1] > LEAST_SETTLED:
        return None
    return CorrectedShear(
        shear=answer,
        within=within,
        slip=missing.slip,
        displacement=solution.displacement + u,
        shift=motion,
        stick=missing.edge.region,
        stick_cells=missing.edge.area,
        change=changes[-1],
    )
