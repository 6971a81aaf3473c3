"""Both solvers on the line of the load: shear along it and pressure, where they can be compared."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fem_reference.harmonics.surface_tractions import tractions_at
from verification.cases.fem_levels import judged_within
from verification.cases.paper_scene import FRICTION, HERTZ

if TYPE_CHECKING:
    import semi_analytical
    from fem_reference import Result

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Of elements or cells, whichever is larger: shear has a cusp where stick begins.
FRONT, AXIS = 1.5, 2.0


@dataclass(frozen=True)
class Line:
    """Both solutions at the centres of the cells on y = 0, at the end of a step."""

    fem: Result
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
        difference = np.abs(self.fem_tractions()[0] - self.sam_tractions()[0])
        judged = self._inside & ~self._near_fronts
        return np.asarray(difference[judged] / (FRICTION * HERTZ.peak_pressure))

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
        elements = self.fem.discretisation.elements_per_radius
        reach = judged_within(elements) * self.fem.steps[self.step - 1].contact_radius
        r = np.abs(self.x)
        return np.asarray((r > AXIS * self._width) & (r < reach))

    @property
    def _near_fronts(self) -> Mask:
        """Where stick begins or ends in either solution."""
        sam, row = self.sam.steps[self.step - 1], self.sam.grid.cells[1] // 2
        assert sam.in_stick is not None
        middles = 0.5 * (self.x[1:] + self.x[:-1])
        cells = sam.in_stick[:, row]
        fronts = list(middles[cells[1:] != cells[:-1]])
        fem = self.fem.steps[self.step - 1]
        assert fem.in_stick is not None
        between = 0.5 * (fem.radii[1:] + fem.radii[:-1])
        rays = fem.in_stick.reshape(len(fem.radii), -1)
        for sign, stuck in ((1, rays[:, 0]), (-1, rays[:, -1])):
            fronts.extend(sign * between[stuck[1:] != stuck[:-1]])
        near = np.zeros(len(self.x), dtype=bool)
        for front in fronts:
            near |= np.abs(self.x - front) <= FRONT * self._width
        return near
