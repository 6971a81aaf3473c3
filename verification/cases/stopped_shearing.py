"""A contact of alike bodies sheared once, with stops: how its means err against the closed form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from contact_results.quantities import shift_along_x
from contact_scene import IsotropicMaterial
from verification.closed_forms.tangential_history import TangentialHistory
from verification.judging.order_of_convergence import Followed, OrderOfConvergence
from verification.problems import paper_scene as paper

if TYPE_CHECKING:
    import fem_reference
    import semi_analytical

    Result: TypeAlias = semi_analytical.Result | fem_reference.Result


@dataclass(frozen=True)
class StoppedShearing:
    """The paper's contact pressed and then sheared to some parts of µW, one loading step each.

    Errors at single stops change their sign from grid to grid: the edges of contact and stick zone
    fall anywhere. Their root mean square over all stops does not.
    """

    material: IsotropicMaterial
    parts: tuple[float, ...]

    @cached_property
    def stops(self) -> tuple[TangentialHistory, ...]:
        """The closed form at every stop."""
        virgin = TangentialHistory(paper.partial_slip(self.material, 0.0))
        return tuple(virgin.loaded_to(part * paper.FRICTION_LIMIT) for part in self.parts)

    @property
    def sliding_shift(self) -> float:
        """Shift at which the whole contact slides [length]."""
        return self.stops[0].virgin.sliding_shift

    def over_stops(self, result: Result, error: Callable[[Any, TangentialHistory], float]) -> float:
        """Root mean square of an error of the end of a step and the closed form there."""
        ends = zip(result.steps[1:], self.stops, strict=True)
        return float(np.sqrt(np.mean([error(end, exact) ** 2 for end, exact in ends])))

    def shift_error(self, result: Result) -> float:
        """Of the tangential shift, over the shift at gross sliding [1]."""
        scale = self.sliding_shift
        return self.over_stops(
            result, lambda end, exact: (shift_along_x(end) - exact.shift) / scale
        )

    def energy_error(self, result: Result) -> float:
        """Of the dissipated energy, over µW times the shift at gross sliding [1]."""
        scale = paper.FRICTION_LIMIT * self.sliding_shift
        return self.over_stops(
            result, lambda end, exact: (end.dissipated_energy - exact.dissipated_energy) / scale
        )

    def orders(
        self, levels: tuple[str, ...], expected: float, of_shift: str, of_energy: str
    ) -> tuple[OrderOfConvergence, OrderOfConvergence]:
        """Of shift and dissipated energy; the reasons of their common order last."""
        stops = f"at {self.listed} µW, root mean square"
        return (
            OrderOfConvergence(
                "order_of_shift", Followed.SHIFT,
                f"tangential shift {stops}", levels, self.shift_error, expected, of_shift,
            ),
            OrderOfConvergence(
                "order_of_energy", Followed.ENERGY,
                f"dissipated energy {stops}", levels, self.energy_error, expected, of_energy,
            ),
        )  # fmt: skip

    @property
    def listed(self) -> str:
        """The parts in words."""
        return ", ".join(f"{part:g}" for part in self.parts[:-1]) + f" and {self.parts[-1]:g}"
