"""Pressure and shear of bodies that couple, with their edges inside the cells.

Where friction slips at the edge of a contact, the shear and the pressure that goes with it fall to
zero like s^α, s the distance from the edge and

    α = ½ + arctan(µβ q·n/|q|)/π

with n the outward normal and Dundurs' β of the outermost materials: in a wedge of slip at the edge
u_z' = -(2/E*)(H p + β q) on both sides of it, H the Hilbert transform (Comninou 1976 for the plane
problem; near its edge every smooth contact is plane). Fitted with that exponent, p^(1/α) passes
smoothly through zero. Within the cells the shear is what the pressure is there, times their ratio,
and each moves the surface in the other's direction, too.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt, gaussian_filter

from contact_scene.pair import outermost_beta
from contact_scene.solver_errors import NotConverged
from contact_scene.summary import ContactStatus
from semi_analytical.admissible_shear import ShearSum, Vector, magnitude
from semi_analytical.box import Box
from semi_analytical.edge.corrected import Corrected, CorrectedShear
from semi_analytical.edge.displacement import Within
from semi_analytical.edge.peak import peak_of
from semi_analytical.edge.rim import Rim, area_within, rim
from semi_analytical.edge_correction.closing import Closed, closed
from semi_analytical.edge_correction.coupled_shear import shear_over_pressure, shear_within
from semi_analytical.edge_correction.mixing import Mixing
from semi_analytical.edge_correction.operators import EdgeOperators
from semi_analytical.edge_correction.pressure import (
    ENOUGH,
    MOST_ROUNDS,
    MOST_UNSAFE,
    has_settled,
    settles,
)
from semi_analytical.edge_correction.shear import direction_of_slip
from semi_analytical.edge_correction.stick_area import stick_area
from semi_analytical.increment import State
from semi_analytical.linearised_shear import Point
from semi_analytical.model import ContactModel
from semi_analytical.part import WHOLE
from semi_analytical.sheared import Sheared, rigid
from semi_analytical.tangential import TangentialSolution, solve_tangential

Field = NDArray[np.float64]
VectorField = NDArray[np.float64]
Mask = NDArray[np.bool_]
WithinVector = tuple[Within, Within]

# Least cells between the edge and the stick zone, between which the law of the edge holds, unless
# its power is within WEAK of a root's: then the pressure beyond is hardly another one.
BESIDE_STICK, WEAK = 5.0, 0.0125
# Cells over which the distance from the edge is smoothed to have its normal.
SMOOTHED = 2.0


class CoupledEdgeCorrection:
    """Of the states of a model. They remain as they are, and so does what follows from them."""

    def __init__(self, model: ContactModel) -> None:
        self._operators = EdgeOperators(model)

    def __call__(
        self, last: State | None, state: State, *, way_known: bool, tolerance: float
    ) -> Corrected | None:
        """The state with its edges inside the cells; None where that is not safe: the contact is
        too thin, its edge is rough, all slides, strong friction slips on a few cells only, the
        rounds do not settle, or the edge is that of a thin film, whose law with friction is not
        known.

        last       the state before, whose surfaces are those of cells where it has not been
                   corrected itself; None before first touch
        way_known  whether it is that of the increment before: friction remembers the way
        """
        solved = state.sheared
        assert solved is not None
        if not way_known or solved.shift is None or solved.status is ContactStatus.GROSS_SLIDING:
            return None
        if self._operators.film(state.pressing.pressure > 0, WHOLE) is not None:
            return None
        model = self._operators.model
        target, sliding = np.zeros_like(solved.shear), np.zeros(solved.in_stick.shape)
        if last is not None:
            assert last.sheared is not None
            edged = last.corrected.sheared if last.corrected else None
            before = edged or last.sheared
            assert before.shift is not None
            target = before.displacement - rigid(model, before.shift)
            if edged is None and last.target == state.target:
                sliding = _beyond(solved.in_stick)
        problem = _Problem(self._operators, state, solved, solved.shift, target, sliding, tolerance)
        return problem.corrected()


class _Answer(NamedTuple):
    """Of a round: tractions (q_x/µ, q_y/µ, p), and what they follow from."""

    tractions: Field
    pressed: Closed
    sheared: TangentialSolution
    displacement: VectorField
    within: WithinVector


@dataclass(frozen=True)
class _Problem:
    """An increment.

    solved, shift  its shear on cells, and the shift that goes with it
    target         u_t - shift of the state before (2, nx, ny) [length]
    sliding        how much cells slip as those without edges do (nx, ny), from 0 to 1: where the
                   state before has no edges inside the cells and the contact has rested since
    """

    operators: EdgeOperators
    state: State
    solved: Sheared
    shift: Vector
    target: VectorField
    sliding: Field
    tolerance: float

    @property
    def model(self) -> ContactModel:
        return self.operators.model

    @cached_property
    def mu(self) -> float:
        mu = self.model.friction.uniform
        assert mu is not None
        return mu

    @cached_property
    def exponent(self) -> Field:
        """With which power of the distance the tractions of the cells nearest fall (nx, ny)."""
        p = self.state.pressing.pressure
        inside = p > 0
        depth = distance_transform_edt(inside) - distance_transform_edt(~inside)
        outward = -np.stack(np.gradient(gaussian_filter(depth, SMOOTHED)))
        size = magnitude(outward)
        outward /= np.where(size > 0, size, 1.0)
        ratio = shear_over_pressure(p, self.solved.shear)
        beta = outermost_beta(self.model.scene)
        return np.asarray(0.5 + np.arctan(beta * np.sum(ratio * outward, axis=0)) / np.pi)

    @property
    def _slips_narrowly(self) -> bool:
        """Whether next to the edge the pressure of strong friction feels the stick zone, too."""
        if not np.any(self.solved.in_stick):
            return False
        depth = distance_transform_edt(self.state.pressing.pressure > 0)
        strong = (depth == 1) & (np.abs(self.exponent - 0.5) > WEAK)
        to_stick = distance_transform_edt(~self.solved.in_stick)
        return bool(np.any(strong & (to_stick < BESIDE_STICK)))

    def corrected(self) -> Corrected | None:
        """The state of the last round; None where it is not safe."""
        if self._slips_narrowly:
            return None
        p, mixing = self.state.pressing.pressure, Mixing()
        x = np.concatenate([self.solved.shear / self.mu, p[None]])
        edge, changes, answer = self._rim(p, None), list[float](), None
        for number in range(MOST_ROUNDS):
            if edge is None or edge.unsafe > MOST_UNSAFE:
                return None
            try:
                answer = self.solve(x, answer, edge)
            except NotConverged:
                return None
            change = answer.tractions - x
            sizes = np.sum(np.abs(change[2])), np.sum(magnitude(change[:2]))
            changes.append(float(max(sizes) / np.sum(x[2])))
            settled = has_settled(change, x[2], int(np.count_nonzero(x[2])))
            if (settled and settles(changes)) or number == MOST_ROUNDS - 1:
                break
            x = _allowed(x + change if number == 0 else mixing.next(x, change))
            edge = self._rim(x[2], edge)
        if answer is None or not settles(changes):
            return None
        return self._state(answer, edge, changes[-1])

    def _rim(self, p: Field, before: Rim | None) -> Rim | None:
        return rim(p, p > 0, before, self.exponent, anew=True)

    def solve(self, x: Field, known: _Answer | None, edge: Rim) -> _Answer:
        """The tractions with the edge where it is: the pressure below the last shear, then the
        shear at that pressure.

        known  answer of the round before
        Cells that the contact only reaches into carry what the fit says of them.
        """
        model, cells = self.model, self.model.grid.cells
        normal, coupling = model.normal_operator(cells), model.coupling_operator(cells)
        tangential = model.tangential_operator(cells)
        q, p = self.mu * x[:2], x[2]
        by_p = Within.of(p, edge.i, edge.j, edge.parts)
        by_q = shear_within(q, p, by_p, edge)
        reached = np.where(edge.outer, edge.means, 0.0)
        *u_t, u_z = self.operators.by_all(cells)(*by_q, by_p)
        gap = self.state.target.gap(model) + u_z + coupling.normal_by_shear(q)
        load = self.state.target.on(model, Box.whole(cells))
        pressed = closed(
            normal,
            normal.precondition,
            gap,
            load.less(reached),
            edge.region,
            p,
            reached,
            ENOUGH,
        )
        p = pressed.pressure
        beside = np.stack(u_t) + coupling.tangential_by_pressure(p)
        sheared = solve_tangential(
            tangential,
            model.shear_inverse(cells),
            model.friction.limit(p),
            self._remembered(known) - beside,
            ShearSum(self.solved.force / model.grid.cell_area),
            Point(q, tangential(q)),
            known.sheared.motion if known else self.shift,
            model.self_compliance,
            self.tolerance,
            ENOUGH,
        )
        return _Answer(
            np.concatenate([sheared.shear / self.mu, p[None]]),
            pressed,
            sheared,
            sheared.displacement + beside,
            by_q,
        )

    def _remembered(self, known: _Answer | None) -> VectorField:
        """By what the surfaces have to be moved to stick (2, nx, ny). What edges within the cells
        move them by is no slip of this increment: of a contact that rests they did so before."""
        if known is None:
            return self.target
        moved = known.displacement - self.solved.displacement
        moved -= rigid(self.model, known.sheared.motion - self.shift)
        return np.asarray(self.target + self.sliding * moved)

    def _state(self, answer: _Answer, edge: Rim | None, change: float) -> Corrected:
        assert edge is not None
        sheared, p = answer.sheared, answer.tractions[2]
        bound = self.model.friction.limit(p)
        stick = (bound > 0) & ~sheared.in_slip
        approach, tilt = self.state.target.reached(self.model, answer.pressed.motion)
        return Corrected(
            pressure=p,
            peak=peak_of(p),
            gap=np.where(edge.region, 0.0, np.maximum(answer.pressed.gap, 0.0)),
            approach=approach,
            contact_cells=area_within(p, edge, self.exponent),
            change=change,
            edge=edge.kept,
            tilt=tilt,
            sheared=CorrectedShear(
                shear=sheared.shear,
                within=answer.within,
                slip=direction_of_slip(sheared.shear, sheared.in_slip),
                displacement=answer.displacement,
                shift=sheared.motion,
                stick=stick,
                stick_cells=stick_area(sheared.shear, bound, stick),
                change=change,
            ),
        )


def _beyond(stick: Mask) -> Field:
    """One in cells beyond a zone, and zero within it and next to it: its border may move there."""
    if not np.any(stick):
        return np.ones(stick.shape)
    return np.clip(distance_transform_edt(~stick) - 1, 0.0, 1.0)


def _allowed(x: Field) -> Field:
    """Tractions (q_x/µ, q_y/µ, p) without tension, and shear within the limit of friction."""
    p, size = np.maximum(x[2], 0.0), magnitude(x[:2])
    share = np.where(size > p, p / np.where(size > 0, size, 1.0), 1.0)
    return np.concatenate([share * x[:2], p[None]])
