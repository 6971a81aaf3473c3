"""A solved state with its edges inside the cells."""

from __future__ import annotations

from semi_analytical.edge.corrected import Corrected
from semi_analytical.edge_correction.operators import EdgeOperators
from semi_analytical.edge_correction.pressure import edge_pressure
from semi_analytical.increment import State
from semi_analytical.model import ContactModel


class EdgeCorrection:
    """Of the states of a model. They remain as they are, and so does what follows from them."""

    def __init__(self, model: ContactModel) -> None:
        self._operators = EdgeOperators(model)

    def __call__(self, state: State, tolerance: float) -> Corrected | None:
        """The state with its edges inside the cells; None where that is not safe."""
        return edge_pressure(self._operators, state.target, state.pressing.pressure, tolerance)
