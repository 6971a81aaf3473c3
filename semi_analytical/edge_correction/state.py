"""A solved state with its edges inside the cells."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.corrected import Corrected, CorrectedShear
from semi_analytical.edge.displacement import Within
from semi_analytical.edge.rim import Rim
from semi_analytical.edge_correction.operators import EdgeOperators
from semi_analytical.edge_correction.pressure import edge_pressure
from semi_analytical.edge_correction.shear import ShearProblem, edge_shear, sliding_shear
from semi_analytical.increment import State
from semi_analytical.model import ContactModel
from semi_analytical.sheared import rigid

Field = NDArray[np.float64]


class EdgeCorrection:
    """Of the states of a model. They remain as they are, and so does what follows from them."""

    def __init__(self, model: ContactModel) -> None:
        self._operators = EdgeOperators(model)
        self._last: tuple[Field, tuple[Corrected, Rim] | None] | None = None

    def __call__(self, before: State | None, state: State, tolerance: float) -> Corrected | None:
        """The state with its edges inside the cells; None where that is not safe.

        before  a state before, the corrected one where there is one: surfaces remember it
        """
        pressed = self._pressed(state, tolerance)
        if pressed is None or state.sheared is None:
            return None if pressed is None else pressed[0]
        corrected, contact = pressed
        sheared = self._sheared(before, state, corrected.pressure, contact, tolerance)
        return None if sheared is None else replace(corrected, sheared=sheared)

    def _pressed(self, state: State, tolerance: float) -> tuple[Corrected, Rim] | None:
        """The pressure; of a pressure that has not changed it is known."""
        p = state.pressing.pressure
        if self._last is None or self._last[0] is not p:
            self._last = p, edge_pressure(self._operators, state.target, p, tolerance)
        return self._last[1]

    def _sheared(
        self,
        before: State | None,
        state: State,
        pressure: Field,
        contact: Rim,
        tolerance: float,
    ) -> CorrectedShear | None:
        model, solved = self._operators.model, state.sheared
        assert solved is not None
        bound = model.friction.limit(pressure)
        nothing = np.zeros_like(solved.shear)
        still = Within.of(nothing[0], contact.i[:0], contact.j[:0], contact.parts[:0])
        if not np.any(solved.shear):
            return CorrectedShear(
                shear=nothing,
                within=(still, still),
                slip=nothing,
                displacement=nothing,
                shift=solved.shift,
                stick=contact.region,
                stick_cells=contact.area,
                change=0.0,
            )
        mu = model.friction.uniform
        assert mu is not None
        limit = Within.of(bound, contact.i, contact.j, mu * contact.parts)
        if not np.any(solved.in_stick):
            return sliding_shear(self._operators, bound, limit, solved)
        slips = (bound > 0) & ~solved.in_stick
        last = before.corrected.sheared if before and before.corrected else None
        if last is None or solved.shift is None or not np.any(slips):
            return None
        assert before is not None
        assert before.sheared is not None
        assert last.shift is not None
        if before.target != state.target and np.any(last.shear):
            return None  # nobody knows how the border of stick lies to the one before
        turned = np.sum(last.slip * solved.shear * slips) < 0
        problem = ShearProblem(
            operators=self._operators,
            bound=bound,
            contact=contact,
            limit=limit,
            force=solved.force,
            target=last.displacement - rigid(model, last.shift),
            before=(last.shear, last.within),
            turned=last.slip if turned else None,
            tolerance=tolerance,
        )
        return edge_shear(problem, solved, before.sheared.shear)
