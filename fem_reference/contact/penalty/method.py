"""The method with a penalty: Gauss-point springs, Coulomb's law by return mapping.

Fields of an increment are values at the Gauss points of the contact edges, `radii` theirs.
"""

from dataclasses import dataclass, replace
from math import pi, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene.march import Place
from contact_scene.pair import contact_modulus
from contact_scene.summary import ContactStatus
from fem_reference.contact.augmentation import Penalty
from fem_reference.contact.friction_limit import contact_status
from fem_reference.contact.one_component import with_shear
from fem_reference.contact.penalty.fitted_edge import stick_area
from fem_reference.contact.penalty.law import penalty_stiffness
from fem_reference.contact.penalty.passes import advance
from fem_reference.contact.penalty.problem import PenaltyProblem, penalty_problem
from fem_reference.contact.penalty.spring_state import PenaltyState
from fem_reference.fields import Increment
from fem_reference.history import Method as Solver
from fem_reference.loads import Loads
from fem_reference.model import ContactModel
from fem_reference.plan import Path, Plan

Field = NDArray[np.float64]


def penalty_method(
    model: ContactModel, plan: Plan, penalty: Penalty, harmonics: int
) -> Solver[Any]:
    """The method on a model.

    On many harmonics it is springs in series with the exact law, between rings instead of Gauss
    points.

    harmonics  the highest one, for Path.HARMONICS
    """
    if plan.path is not Path.HARMONICS:
        return PenaltyMethod(plan, penalty, penalty_problem(model, plan.path, penalty))
    from fem_reference.contact.harmonics.angular_grid import end_grid
    from fem_reference.contact.harmonics.method import harmonic_method

    radii = model.hats.radii
    spring = 1 / penalty_stiffness(penalty, contact_modulus(model.scene), radii[1] - radii[0])
    return harmonic_method(model, plan, end_grid(harmonics), (spring, spring), penalty)


@dataclass(frozen=True)
class PenaltyMethod:
    """Solves increments of one problem, and reports them."""

    plan: Plan
    penalty: Penalty
    problem: PenaltyProblem

    def advance(self, before: PenaltyState | None, loads: Loads, tolerance: float) -> PenaltyState:
        """The state at the end of an increment; raises what `passes.advance` raises."""
        return advance(self.problem, self.penalty, before, loads, tolerance)

    def increment(self, state: PenaltyState, place: Place) -> Increment:
        """The state as it is reported."""
        p, overlap = state.traction[0], state.overlap[0]
        pressed = Increment(
            step=place.step,
            index=place.index,
            increments_in_step=place.increments_in_step,
            radii=self.problem.points.radii,
            pressure=p,
            gap=np.where(p > 0, 0.0, np.maximum(-overlap, 0.0)),
            overlap=float(np.max(np.abs(overlap), where=p > 0, initial=0.0)),
            normal_force=state.normal_force,
            approach=state.approach,
            contact_radius=self.problem.contact_radius(state.edges[0]),
            peak_pressure=float(np.max(p)),
            residuals=state.residuals,
            iterations=state.iterations,
            sweeps=state.sweeps,
            augmentations=state.augmentations,
            path=state.solution.value,
        )
        return pressed if state.slip is None else self._with_shear(pressed, state, state.slip)

    def _with_shear(self, pressed: Increment, state: PenaltyState, slip: Field) -> Increment:
        sheared = replace(
            pressed,
            status=self._status(state),
            in_stick=state.in_contact & ~state.in_slip,
            stick_radius=self._stick_radius(state, pressed.contact_radius),
            dissipated_energy=state.dissipated,
        )
        return with_shear(sheared, self.plan, state, state.traction[1], slip)

    def _stick_radius(self, state: PenaltyState, contact_radius: float) -> float:
        in_stick = state.in_contact & ~state.in_slip
        if np.array_equal(in_stick, state.in_contact):
            return contact_radius
        problem, (p, q) = self.problem, state.edges
        room = problem.friction.limit(p) - np.abs(q)
        area = stick_area(problem.points.radii, room, in_stick, contact_radius, problem.element)
        return sqrt(area / pi)

    def _status(self, state: PenaltyState) -> ContactStatus:
        problem, stuck = self.problem, state.in_contact & ~state.in_slip
        carried = float(problem.surface.resultant(state.traction)[1]) if problem.driven else None
        limit = problem.capacity(state.traction[0])
        return contact_status(state.in_contact, stuck, carried, limit)
