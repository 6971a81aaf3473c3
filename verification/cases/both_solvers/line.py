"""Both solvers on the line of the load: shear along it and pressure, where they can be compared."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from verification.cases.both_solvers.left_out import AXIS, FRONT, Field, Mask, kept_fronts
from verification.observed.ring_errors import judged_within
from verification.observed.ring_tractions import tractions_at
from verification.problems.paper_scene import FRICTION, HERTZ

if TYPE_CHECKING:
    import fem_reference
    import semi_analytical


@dataclass(frozen=True)
class Line:
    """Both solutions at the centres of the cells on y = 0, at the end of a step."""

    fem: fem_reference.Result
    sam: semi_analytical.Result
    step: int

    @property
    def x(self) -> Field:
        """Positions [length]."""
        return self.sam.grid.x

    def fem_tractions(self) -> tuple[Field, Field]:
        """q_x and p by finite elements."""
        q, p = tractions_at(self.fem.steps[self.step - 1], self.x, 0 * self.x)
        return q[0], p

    def sam_tractions(self) -> tuple[Field, Field]:
        """q_x and p on the cells."""
        end, row = self.sam.steps[self.step - 1], self.sam.grid.cells[1] // 2
        assert end.shear is not None
        return end.shear[0][:, row], end.pressure[:, row]

    @property
    def shear_difference(self) -> Field:
        """|Δq_x| / µp_H where it is judged."""
        left_out = np.any(list(self.left_out.values()), axis=0)
        return np.asarray(self.shear_apart[~left_out])

    @property
    def shear_apart(self) -> Field:
        """|Δq_x| / µp_H on all of the line."""
        difference = np.abs(self.fem_tractions()[0] - self.sam_tractions()[0])
        return np.asarray(difference / (FRICTION * HERTZ.peak_pressure))

    @property
    def left_out(self) -> dict[str, Mask]:
        """Where shear is not judged, by the reason."""
        return {
            "near the axis": np.abs(self.x) <= AXIS * self._width,
            "near the edge of contact": np.abs(self.x) >= self._reach,
            "where stick begins or ends, or did": self._near_fronts,
        }

    @property
    def pressure_difference(self) -> Field:
        """|Δp| / p_H where it is judged."""
        difference = np.abs(self.fem_tractions()[1] - self.sam_tractions()[1])
        return np.asarray(difference[self._inside] / HERTZ.peak_pressure)

    @property
    def _width(self) -> float:
        """Of an element or a cell, whichever is larger [length]."""
        return float(max(self.fem.steps[0].radii[1], self.sam.grid.spacing[0]))

    @property
    def _inside(self) -> Mask:
        """Away from axis and edge."""
        r = np.abs(self.x)
        return np.asarray((r > AXIS * self._width) & (r < self._reach))

    @property
    def _reach(self) -> float:
        """How far from the axis the edge is not felt [length]."""
        elements = self.fem.discretisation.elements_per_radius
        return float(judged_within(elements) * self.fem.steps[self.step - 1].contact_radius)

    @property
    def _near_fronts(self) -> Mask:
        """Where stick begins or ends in either solution, or did when the load turned and no slip
        has passed since."""
        near = np.zeros(len(self.x), dtype=bool)
        for front in (*self._sam_fronts(), *self._fem_fronts()):
            near |= np.abs(self.x - front) <= FRONT * self._width
        return near

    def _sam_fronts(self) -> list[float]:
        row = self.sam.grid.cells[1] // 2
        done = [one for one in self.sam.increments if one.step <= self.step]
        stuck = np.stack([_stick(one)[:, row] for one in done])
        return kept_fronts(self.x, stuck, _ends_of_steps([one.step for one in done]))

    def _fem_fronts(self) -> list[float]:
        done = [one for one in self.fem.increments if one.step <= self.step]
        rays = [_stick(one).reshape(len(one.radii), -1) for one in done]
        turns, radii = _ends_of_steps([one.step for one in done]), done[-1].radii
        ahead = kept_fronts(radii, np.stack([stuck[:, 0] for stuck in rays]), turns)
        behind = kept_fronts(radii, np.stack([stuck[:, -1] for stuck in rays]), turns)
        return [*ahead, *(-front for front in behind)]


def _stick(one: fem_reference.Increment | semi_analytical.Increment) -> Mask:
    assert one.in_stick is not None
    return one.in_stick


def _ends_of_steps(steps: list[int]) -> list[int]:
    """Of increments in these steps, the ones that end theirs."""
    last = {step: k for k, step in enumerate(steps)}
    return list(last.values())
