"""The method without a penalty: contact and Coulomb's law hold exactly over the hats."""

from dataclasses import dataclass, replace
from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

from contact_scene.march import Place
from fem_reference.contact.complementarity.contact_problem import ContactProblem, contact_problem
from fem_reference.contact.complementarity.ring_increment import advance
from fem_reference.contact.complementarity.ring_state import Slid, State
from fem_reference.contact.one_component import with_shear
from fem_reference.contact.ring_edge import contact_edge, stick_area
from fem_reference.fields import Increment
from fem_reference.loads import Loads
from fem_reference.model import ContactModel
from fem_reference.plan import Plan

Field = NDArray[np.float64]


def complementarity_method(model: ContactModel, plan: Plan) -> "Complementarity":
    """The method on a model, for a path other than Path.HARMONICS."""
    return Complementarity(plan, contact_problem(model, plan.path))


@dataclass(frozen=True)
class Complementarity:
    """Solves increments of one problem, and reports them."""

    plan: Plan
    problem: ContactProblem

    def advance(self, before: State | None, loads: Loads, tolerance: float) -> State:
        """The state at the end of an increment; raises what `increment.advance` raises."""
        return advance(self.problem, before, loads, tolerance)

    def increment(self, state: State, place: Place) -> Increment:
        """The state as it is reported."""
        problem, p = self.problem, state.pressure
        pressed = Increment(
            step=place.step,
            index=place.index,
            increments_in_step=place.increments_in_step,
            radii=problem.radii,
            pressure=p,
            gap=np.where(p > 0, 0.0, np.maximum(state.gap, 0.0) / problem.weights),
            normal_force=state.normal_force,
            approach=state.approach,
            contact_radius=contact_edge(problem.radii, p, problem.edge),
            peak_pressure=float(np.max(p)),
            residuals=state.residuals,
            iterations=state.steps,
            sweeps=state.sweeps,
        )
        return pressed if state.slid is None else self._with_shear(pressed, state, state.slid)

    def _with_shear(self, pressed: Increment, state: State, slid: Slid) -> Increment:
        sideways = self.problem.sideways
        assert sideways is not None
        bound = sideways.friction.limit(sideways.limited(state.pressure))
        in_stick = (state.pressure > 0) & (slid.sides == 0) & (sideways.friction.largest > 0)
        stuck = stick_area(
            pressed.radii, bound, slid.shear[None], slid.sides != 0, pressed.contact_radius
        )
        sheared = replace(
            pressed,
            status=slid.status,
            in_stick=in_stick,
            stick_radius=sqrt(stuck / pi),
            dissipated_energy=slid.dissipated,
        )
        return with_shear(sheared, self.plan, state, slid.shear, slid.slip / self.problem.weights)
