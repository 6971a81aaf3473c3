"""A solved state with its edges inside the cells."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from semi_analytical.edge.corrected import Corrected, CorrectedShear
from semi_analytical.edge.displacement import Within
from semi_analytical.edge_correction.operators import EdgeOperators
from semi_analytical.edge_correction.pressure import edge_pressure
from semi_analytical.edge_correction.shear import ShearProblem, edge_shear, sliding_shear
from semi_analytical.increment import State
from semi_analytical.model import ContactModel
from semi_analytical.sheared import Sheared, rigid


class EdgeCorrection:
    """Of the states of a model. They remain as they are, and so does what follows from them."""

    def __init__(self, model: ContactModel) -> None:
        self._operators = EdgeOperators(model)

    def __call__(
        self, last: State | None, state: State, *, way_known: bool, tolerance: float
    ) -> Corrected | None:
        """The state with its edges inside the cells; None where that is not safe.

        last       a state before, the corrected one where there is one; None before first touch
        way_known  whether what surfaces remember of the way from there is told by its ends
        """
        sheared = state.sheared
        if sheared is None:
            return self._pressed(last, state, tolerance)
        free = not np.any(sheared.shear) or not np.any(sheared.in_stick)
        before = last if way_known else None
        if not free and not _leads_to(before, state, sheared):
            return None
        pressed = self._pressed(last, state, tolerance)
        if pressed is None:
            return None
        shear = self._sheared(before, state, sheared, pressed, tolerance)
        return None if shear is None else replace(pressed, sheared=shear)

    def _pressed(self, last: State | None, state: State, tolerance: float) -> Corrected | None:
        """The pressure; of one that has not changed it is known."""
        p, target = state.pressing.pressure, state.target
        known = last.corrected if last and last.target == target else None
        if known and last and np.array_equal(last.pressing.pressure, p):
            return known
        return edge_pressure(self._operators, target, p)

    def _sheared(
        self,
        before: State | None,
        state: State,
        solved: Sheared,
        pressed: Corrected,
        tolerance: float,
    ) -> CorrectedShear | None:
        """The shear at a corrected pressure."""
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
        mu = model.friction.uniform
        assert mu is not None
        on_part = Within.of(edge.part.of(bound), edge.i, edge.j, mu * edge.parts, edge.part)
        limit = on_part.unfolded(edge.part)
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
            target=last.displacement - rigid(model, last.shift),
            before=(last.shear, last.within),
            turned=last.slip if turned else None,
            tolerance=tolerance,
        )
        return edge_shear(problem, solved, before.sheared.shear)


def _leads_to(before: State | None, state: State, sheared: Sheared) -> bool:
    """Whether the border of stick of a state is known to follow from a state before."""
    last = before.corrected.sheared if before and before.corrected else None
    if before is None or last is None or last.shift is None or sheared.shift is None:
        return False
    # With another pressure nobody knows how the border of stick lies to the one before.
    return before.target == state.target or not np.any(last.shear)
