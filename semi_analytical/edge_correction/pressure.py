"""Deferred correction of the pressure for a contact edge that cuts cells.

Towards the contact edge the pressure falls like a power α of the distance. A pressure that is
uniform in each cell then has an error of O(h), with h the cell size. Each iteration has three
steps: fit φ = p^(1/α), which passes smoothly through zero at the edge; compute the displacement by
the pressure variation within cells; solve the normal problem again with this displacement. For
coupled bodies the shear is updated with the pressure and contributes to u_z.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Field, Mask, Vector
from contact_scene.body_pair import outermost_beta
from contact_solver.conjugate_gradients import Point
from contact_solver.pressure import close_gap
from semi_analytical.edge.clipped_power_means import Exponent
from semi_analytical.edge.corrected import Corrected, EdgeReport
from semi_analytical.edge.displacement import Within
from semi_analytical.edge.film import FilmLaw
from semi_analytical.edge.fit import peak_of
from semi_analytical.edge.subcell_tractions import (
    SubcellTractions,
    fit_edge,
)
from semi_analytical.edge_correction.operators import EdgeOperators
from semi_analytical.edge_correction.shear_at_edge import FollowingShear
from semi_analytical.increments.increment import State
from semi_analytical.increments.normal_solve import MARGIN
from semi_analytical.model import ContactModel
from semi_analytical.operator.box import (
    Box,
    box_around,
)
from semi_analytical.operator.points import fields_of, points_of

# Least relaxation factor. With λ an eigenvalue of the derivative of one iteration, the error is
# multiplied by 1 - (1 - λ) factor. λ lies between 0 (smooth changes) and -2 (changes that alternate
# between cells, on films thinner than a cell): 1/2 has the smallest bound for these, 1/2.
LEAST_FACTOR = 0.5
# The bound 1/2 reaches SETTLED in 7 more iterations, and the edge in a few more.
MAX_ITERATIONS = 10
# Reduction of the residual by the linear solve of an iteration.
INNER_REDUCTION = 0.1
# Largest predicted next change of a traction over the first one. The first change is the error of
# uniform cells; a hundredth of it is about the error of the fits, for all sizes of cells.
SETTLED = 1e-2
# Largest last travel of the edge over the radius: the accuracy required of a radius on 128
# cells per side. The next ones are smaller.
STEADY = 5e-5
# Largest predicted next change of an iteration that does not halve the change in two steps, as
# where the fits of neighbouring cells alternate for ever on a film: the accuracy of a radius.
STALLED = 5e-5
# Largest last change of the pressure after all iterations, Σ|Δp|/Σp.
LEAST_SETTLED = 1e-3
# Largest fraction of the edge without a reliable fit.
MAX_UNSAFE = 0.03


class NotFitted(Exception):
    """Error raised if the edge correction of a contact state is impossible.

    The message states the cause, for instance a rough contact edge.
    """


def edge_pressure(
    operators: EdgeOperators, state: State, shear: FollowingShear | None, *, coupled: bool
) -> Corrected:
    """Correct the pressure of a state for an edge that cuts cells, by deferred correction.

    operators  surface displacements by tractions that vary within cells
    state      solved state with uniform pressure in each cell, on the full window for coupled
               bodies
    shear      shear as a function of the pressure; None without friction
    coupled    True if the shear causes normal displacements

    Raises NotFitted if the contact is too thin, its edge is rough, or the iteration does not
    converge.
    """
    problem = _Problem(operators, state, shear, coupled)
    p = state.pressing.pressure
    edge = problem.fit_edge(p, None)
    response = problem.response(state.pressing.approach, p)
    step, factor, changes = np.zeros_like(p), 1.0, list[float]()
    for number in range(MAX_ITERATIONS):
        solved = problem.solve(p, edge)
        last, step = step, solved.pressure - p
        if number:
            factor = relaxation_factor(factor, last, step)
        changes.append(float(np.sum(np.abs(step)) / np.sum(p)))
        before, p = _Iterate(p, edge, response), p + factor * step
        edge = problem.fit_edge(p, edge)
        approach, _ = state.target.reached(operators.model, solved.motion)
        response = problem.response(approach, p)
        if has_settled(changes, edge_travel(before.edge, edge)):
            break
    change = changes[-1]
    if change > LEAST_SETTLED:
        raise NotFitted(
            f"the correction does not converge: its last change is {change:.1e}, allowed are "
            f"{LEAST_SETTLED:.0e}"
        )
    return problem.assemble_result(_Iterate(p, edge, response), before, solved, changes)


def has_settled(changes: Sequence[float], travel: float) -> bool:
    """Return True if the iteration of the edge correction has converged, or stalls near the limit.

    changes  relative changes of the traction in all iterations so far, at least one
    travel   `edge_travel` in the last iteration
    """
    predicted = next_change(changes)
    if len(changes) > 3 and 2 * changes[-1] > changes[-3]:
        return predicted <= STALLED
    return predicted <= SETTLED * changes[0] and travel <= STEADY


def next_change(changes: Sequence[float]) -> float:
    """Predict the relative change of a traction in the next iteration of the edge correction.

    The prediction multiplies the last change by the ratio of the last two changes, at most 1. The
    first change is excluded from the ratio, because it is the discretisation error of the cells.
    With fewer than three changes the last change is returned.

    changes  relative changes of all iterations so far, at least one
    """
    *before, last = changes
    return last * min(1.0, last / before[-1]) if len(before) > 1 else last


def left_over(changes: Sequence[float]) -> float:
    """Estimate the error of the edge correction after its last iteration, over the last change.

    The result is κ/(1-κ). The contraction factor κ is the mean ratio of successive changes without
    the first change. It is 1/2 if there are too few changes. It is limited to 0.9, because ten
    iterations cannot resolve slower convergence.

    changes  relative changes of the traction in all iterations
    """
    _, *later = changes
    contraction = 0.5
    if len(later) > 1 and later[0]:
        contraction = (later[-1] / later[0]) ** (1 / (len(later) - 1))
    contraction = min(contraction, 1 - 1 / MAX_ITERATIONS)
    return contraction / (1 - contraction)


def relaxation_factor(factor: float, last: Field, change: Field) -> float:
    """Compute the relaxation factor of the next change of a traction in the edge correction.

    Aitken's method (Irons and Tuck 1969) is used. The result lies between LEAST_FACTOR and 1.

    factor  relaxation factor that `last` was multiplied by
    last    change of the traction in the preceding iteration, before relaxation (…, nx, ny)
    change  change of the traction in the present iteration, before relaxation (…, nx, ny)
    """
    fall = last - change
    found = factor * float(np.sum(last * fall) / np.sum(fall**2))
    return max(LEAST_FACTOR, min(found, 1.0))


def edge_travel(before: SubcellTractions, after: SubcellTractions) -> float:
    """Compute the mean distance that an edge moves in one iteration, over the radius √(area/π).

    Motions inwards and outwards do not cancel: the result bounds the relative change of the radius,
    and does not vanish by chance.

    before, after  tractions along the edge of the region in the two iterations
    """
    moved = float(np.sum(np.abs(after.covered - before.covered)))
    return moved / float(2 * np.sum(before.covered))


class _NormalResult(NamedTuple):
    """Result of one normal solve of the edge correction, with a fixed contact edge.

    pressure           mean pressure of each cell (nx, ny) [force/length^2]
    motion             rigid motions of the indenter, see `NormalTarget.motions`
    edge_displacement  normal displacement by the pressure variation within cells and by the shear
                       (nx, ny) [length]
    """

    pressure: Field
    motion: Vector
    edge_displacement: Field


class _Iterate(NamedTuple):
    """One iterate of the edge correction of the pressure.

    pressure  mean pressure of each cell (nx, ny) [force/length^2]
    edge      pressure in the subcells along the contact edge
    response  approach [length]; at a prescribed approach the sum of the pressure over the cells
    """

    pressure: Field
    edge: SubcellTractions
    response: float


@dataclass(frozen=True)
class _Problem:
    """Problem of the edge correction of the pressure of one solved state.

    Methods of this class are the steps of one iteration of the deferred correction.

    operators  surface displacements by tractions that vary within cells
    state      solved state with uniform pressure in each cell
    shear      shear as a function of the pressure; None without friction
    coupled    True if the shear causes normal displacements
    """

    operators: EdgeOperators
    state: State
    shear: FollowingShear | None
    coupled: bool

    @property
    def model(self) -> ContactModel:
        return self.operators.model

    @cached_property
    def contact(self) -> Mask:
        """Mask of the cells in contact in the solved state, before the edge correction (nx, ny)."""
        return self.state.pressing.pressure > 0

    @cached_property
    def box(self) -> Box:
        """Smallest box of cells that contains the contact area and a margin of MARGIN cells.

        The normal solves of the edge correction are restricted to this box.
        """
        return box_around(self.contact, MARGIN, self.model.domain)

    @cached_property
    def gap(self) -> Field:
        return self.state.target.gap(self.model)

    @cached_property
    def exponent(self) -> Exponent:
        """Exponent α of the pressure p ~ s^α at the distance s from the contact edge.

        The exponent is 1/2. If coupled bodies slip, the exponent is a field (nx, ny).
        """
        solved = self.state.sheared
        if not self.coupled or self.shear is None or solved is None:
            return 0.5
        if not np.any(self.contact & ~solved.in_stick):
            return 0.5
        return self.shear.exponent(self.contact, outermost_beta(self.model.scene))

    @cached_property
    def film(self) -> FilmLaw | None:
        return self.operators.film(self.contact, self.model.domain)

    def fit_edge(self, p: Field, before: SubcellTractions | None) -> SubcellTractions:
        """Fit the pressure near the contact edge, and compute its subcell values.

        p       mean pressure of each cell (nx, ny) [force/length^2]
        before  fitted edge of the preceding iteration; None in the first one

        Raises NotFitted if the contact is too thin or its edge is rough.
        """
        edge = fit_edge(p, p > 0, before, self.exponent, self.model.domain, self.film)
        if edge is None:
            raise NotFitted("the contact is too thin")
        if edge.unsafe > MAX_UNSAFE:
            raise NotFitted(f"the edge is rough: {edge.unsafe:.2g} of it cannot be fitted")
        return edge

    def response(self, approach: float, p: Field) -> float:
        """Return the scalar response of the bodies that the load does not prescribe.

        The response is the approach [length], or at a prescribed approach the sum of the pressure
        over the cells. Its change between iterations yields the error of the approach or of the
        normal force.

        approach  approach of the iterate [length]
        p         mean pressure of each cell (nx, ny) [force/length^2]
        """
        return approach if self.state.target.approach is None else float(np.sum(p))

    def solve(self, p: Field, edge: SubcellTractions) -> _NormalResult:
        """Solve the normal problem for a fixed contact edge, by conjugate gradients.

        The problem is linear, because the edge determines the cells in contact. Partly covered
        cells whose centre lies outside the edge have the fitted pressure. The cells in contact
        carry the rest of the load.

        p     mean pressure of each cell in the preceding iteration (nx, ny) [force/length^2]
        edge  contact edge fitted to that pressure
        """
        box, target = self.box.slices, self.state.target
        contact = points_of(edge.region[box])
        outer = points_of(np.where(edge.outer, edge.means, 0.0)[box])
        edge_displacement = self.edge_displacement(p, edge)
        gap = points_of((self.gap + edge_displacement)[box])
        problem = replace(
            target.problem(self.model, self.box),
            gap=np.where(contact, gap, np.inf),
            motions=target.motions(self.model, self.box).less(outer[None]),
        )
        gap = problem.finite_gap
        inner = problem.admissible(np.where(contact, points_of(p[box]), 0.0))
        u = problem.displace(inner + outer)
        open_gap = u + gap - problem.closure(problem.motion(inner, u + gap))
        (inner, u), _ = close_gap(problem, contact, Point(inner, u), open_gap, INNER_REDUCTION)
        pressure = problem.admissible(inner) + outer
        return _NormalResult(
            self.box.embed(pressure.reshape(self.box.shape), p.shape),
            problem.motion(inner, u + gap),
            edge_displacement,
        )

    def edge_displacement(self, p: Field, edge: SubcellTractions) -> Field:
        """Compute the normal surface displacement that a pressure uniform in each cell omits.

        The result (nx, ny) [length] is the displacement by the variation of the pressure within
        cells. For coupled bodies the displacement by the shear is added.

        p     mean pressure of each cell (nx, ny) [force/length^2]
        edge  pressure in the subcells along the contact edge
        """
        by_p = Within.from_subcells(p, edge.i, edge.j, edge.parts, edge.domain)
        if not self.coupled or self.shear is None:
            return np.asarray(self.operators.displace_by_pressure(by_p)[0])
        q, limit = self.shear(p), self.model.friction.limit
        of_limit = Within.from_subcells(limit(p), edge.i, edge.j, limit(edge.parts))
        within = [of_limit.along(n, one) for n, one in zip(self.shear.slip, q, strict=True)]
        u = self.operators.apart(*within, by_p)[0]
        return np.asarray(u + self.model.operator(p.shape).normal_by_shear(q))

    def assemble_result(
        self, last: _Iterate, before: _Iterate, solved: _NormalResult, changes: Sequence[float]
    ) -> Corrected:
        """Assemble the corrected state on the full window, with estimates of its iteration errors.

        last     last iterate of the edge correction
        before   iterate before `last`
        solved   last normal solve
        changes  relative change of the pressure in each iteration
        """
        edge = last.edge
        target, extend = self.state.target, self.model.domain.extend
        approach, tilt = target.reached(self.model, solved.motion)
        closure = target.motions(self.model, Box.whole(self.gap.shape)).displacement(solved.motion)
        u = solved.edge_displacement + self.model.operator(self.gap.shape).normal(solved.pressure)
        gap = np.maximum(self.gap + u - fields_of(closure[0], self.gap.shape), 0.0)
        gap[edge.region] = 0.0
        p = extend(last.pressure)
        peak, before_peak = peak_of(p), peak_of(extend(before.pressure))
        left = left_over(changes)
        report = EdgeReport(
            response=left * abs(last.response / before.response - 1),
            peak=left * abs(peak.value / before_peak.value - 1),
            ridge=peak.ridge,
            radius=left * edge_travel(before.edge, edge),
        )
        return Corrected(
            pressure=p,
            peak=peak.value,
            gap=extend(gap),
            approach=approach,
            contact_cells=edge.area,
            change=changes[-1],
            edge=edge,
            report=report,
            tilt=tilt,
            shear=None if self.shear is None else self.shear(p),
        )
