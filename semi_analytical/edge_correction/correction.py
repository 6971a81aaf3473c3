"""Edge correction of states: of the pressure, and of the stick border of uncoupled bodies."""

from dataclasses import replace

import numpy as np

from semi_analytical.edge.corrected import Corrected, CorrectedShear, EdgeReport
from semi_analytical.edge.displacement import Within
from semi_analytical.edge_correction.operators import EdgeOperators
from semi_analytical.edge_correction.pressure import NotFitted, edge_pressure
from semi_analytical.edge_correction.shear import ShearProblem, edge_shear, sliding_shear
from semi_analytical.edge_correction.shear_at_edge import FollowingShear
from semi_analytical.increments.increment import State
from semi_analytical.increments.tangential_state import (
    TangentialState,
    rigid,
    stretched,
)
from semi_analytical.model import ContactModel


class EdgeCorrection:
    """Edge correction of the states of a model, which remain unchanged.

    coupled  whether pressure and shear of the bodies are coupled
    """

    def __init__(self, model: ContactModel, *, coupled: bool) -> None:
        self._domain, self._coupled = model.domain, coupled
        # The direction of slip at the edge of coupled bodies is found on the window.
        self._operators = EdgeOperators(model.on_window if coupled else model)

    def __call__(
        self, last: State | None, state: State, *, way_known: bool, tolerance: float
    ) -> Corrected | EdgeReport:
        """Correct a state, or report the cause for which it cannot be corrected.

        last       an earlier state, from which the stick border of uncoupled bodies follows; None
                   before first touch
        way_known  whether its ends determine the load history from there
        """
        extended = self._extended(state)
        try:
            pressed = self._pressed(last, state, extended)
        except NotFitted as cause:
            return EdgeReport(str(cause))
        sheared = extended.sheared
        if self._coupled or sheared is None:
            return pressed
        free = not np.any(sheared.shear) or not np.any(sheared.in_stick)
        before = self._extended(last) if last and way_known else None
        if free or _leads_to(before, state, sheared):
            return replace(pressed, sheared=self._sheared(before, sheared, pressed, tolerance))
        return pressed

    def _extended(self, state: State) -> State:
        """Extend the fields of a state to the window."""
        extend, sheared = self._domain.extend_fields, state.sheared
        tangential = None if sheared is None else extend(sheared)
        return replace(state, pressing=extend(state.pressing), sheared=tangential)

    def _pressed(self, last: State | None, state: State, extended: State) -> Corrected:
        """The pressure; reused where it has not changed."""
        sheared, law, follows = extended.sheared, self._operators.model.friction, None
        if sheared is not None:
            p = extended.pressing.pressure
            follows = FollowingShear.of(law, p, sheared.shear, sheared.in_stick)
        known = last.corrected if last and last.target == state.target else None
        same = last is not None and np.array_equal(last.pressing.pressure, state.pressing.pressure)
        if not self._coupled and known and same:
            shear = None if follows is None else follows(known.pressure)
            return replace(known, shear=shear, sheared=None)
        solved = extended if self._coupled else state
        return edge_pressure(self._operators, solved, follows, coupled=self._coupled)

    def _sheared(
        self,
        before: State | None,
        solved: TangentialState,
        pressed: Corrected,
        tolerance: float,
    ) -> CorrectedShear | None:
        """The shear at a corrected pressure; None where its stick border cannot be fitted."""
        model, edge = self._operators.model, pressed.edge
        bound = model.friction.limit(pressed.pressure)
        if not np.any(solved.shear):
            nothing = np.zeros_like(solved.shear)
            still = Within.nothing(bound.shape)
            return CorrectedShear(
                shear=nothing,
                within=(still, still),
                slip=nothing,
                displacement=nothing,
                shift=solved.shift,
                stick=pressed.pressure > 0,
                stick_cells=pressed.contact_cells,
                change=0.0,
            )
        parts = model.friction.limit(edge.parts)
        domain = edge.domain
        limit = Within.of(domain.restrict(bound), edge.i, edge.j, parts, domain).extended(domain)
        if not np.any(solved.in_stick):
            return sliding_shear(self._operators, bound, limit, solved)
        assert before is not None
        assert before.sheared is not None
        assert before.corrected is not None
        last = before.corrected.sheared
        assert last is not None
        assert last.shift is not None
        slips = (bound > 0) & ~solved.in_stick
        if not np.any(slips):
            return None
        turned = np.sum(last.slip * solved.shear * slips) < 0
        problem = ShearProblem(
            operators=self._operators,
            bound=bound,
            limit=limit,
            force=solved.force,
            target=last.displacement
            - rigid(model, last.shift)
            - stretched(model.on_window, solved.strain, before.sheared.strain),
            before=(last.shear, last.within),
            turned=last.slip if turned else None,
            tolerance=tolerance,
        )
        return edge_shear(problem, solved, before.sheared.shear)


def _leads_to(before: State | None, state: State, sheared: TangentialState) -> bool:
    """Whether the stick border of a state follows from that of an earlier one."""
    last = before.corrected.sheared if before and before.corrected else None
    if before is None or last is None or last.shift is None or sheared.shift is None:
        return False
    # At another pressure the relation of both stick borders is not known.
    return before.target == state.target or not np.any(last.shear)
