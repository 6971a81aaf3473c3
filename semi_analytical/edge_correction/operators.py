"""Operators of what tractions do within the cells of a model."""

from __future__ import annotations

from semi_analytical.edge.displacement import EdgeOperator
from semi_analytical.edge.kernels import PART_OFFSETS, PARTS, EdgeKernels
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.influence.coefficients import InfluenceCoefficients
from semi_analytical.model import ContactModel


class EdgeOperators:
    """Of a model, on its whole window, each built when first asked for."""

    def __init__(self, model: ContactModel) -> None:
        self.model = model
        self._parts: InfluenceCoefficients | None = None
        self._known: dict[str, EdgeOperator] = {}

    def __getitem__(self, component: str) -> EdgeOperator:
        """The operator of a component of the influence coefficients."""
        if component not in self._known:
            model = self.model
            if self._parts is None:
                dx, dy = model.grid.spacing
                self._parts = influence_coefficients(
                    model.scene.body,
                    model.scene.indenter,
                    (dx / PARTS, dy / PARTS),
                    (PART_OFFSETS, PART_OFFSETS),
                )
            kernels = EdgeKernels(component, model.coefficients, self._parts)
            self._known[component] = EdgeOperator(kernels, model.grid.cells, model.convolutions)
        return self._known[component]
