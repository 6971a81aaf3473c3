"""Where the stick area vanishes, extrapolated from the increments in which there is still some.

The stick area falls to zero linearly in the shift: exactly so for Cattaneo and Mindlin's contact,
where c²/a² = 1 - shift / (shift at sliding), and to leading order wherever a smooth field passes
its last extremum. So a line through area against shift gives the shift, and the force is read off
the smooth curve of force against shift, between the last increment that has stick area and the
first that has none. The bar is what half a cell more or less of stick radius
would change, and the scatter about the line.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from verification.studies.sliding_runs.path import SlidingPath, SlidingPoint

# The line is fitted to stick areas below this part of the contact area.
LARGEST_FRACTION = 0.12
# A zone of fewer cells is not resolved.
FEWEST_CELLS = 4
FEWEST_POINTS = 3


@dataclass(frozen=True)
class FullSlip:
    """The state in which the last cell lets go.

    force        T / µW
    shift        [length]
    uncertainty  of the force
    """

    force: float
    shift: float
    uncertainty: float

    @property
    def text(self) -> str:
        """Force and bar for people."""
        return f"{self.force:.3f} ± {self.uncertainty:.3f}"


def full_slip(path: SlidingPath) -> FullSlip | None:
    """Extrapolated full slip; None where the path does not get there or resolves too little."""
    end = 1 + max((n for n, p in enumerate(path.points) if not p.full_slip), default=0)
    points = _resolved(path.points[:end])
    if len(points) < FEWEST_POINTS or end == len(path.points):
        return None
    shift = np.array([p.shift for p in points])
    radius = np.sqrt([p.stick_fraction for p in points])
    bracket = path.points[end - 1].shift, path.points[end].shift

    def force(shift: float) -> float:
        return float(curve(np.clip(shift, *bracket)))

    curve = PchipInterpolator([p.shift for p in path.points], [p.force for p in path.points])
    shift_0, scatter = _intercept(radius**2, shift)
    half_cell = path.cell_over_radius / 2
    by_cell = [_intercept((radius + e) ** 2, shift)[0] for e in (-half_cell, half_cell)]
    by_scatter = [shift_0 - scatter, shift_0 + scatter]
    bars = [max(abs(force(s) - force(shift_0)) for s in ends) for ends in (by_cell, by_scatter)]
    return FullSlip(force(shift_0), float(np.clip(shift_0, *bracket)), hypot(*bars))


def _resolved(points: Sequence[SlidingPoint]) -> list[SlidingPoint]:
    """Increments whose stick zone is small, but not too small for the cells."""
    return [
        p
        for p in points
        if p.shift > 0 and p.stick_fraction <= LARGEST_FRACTION and p.stick_cells >= FEWEST_CELLS
    ]


def _intercept(area: NDArray[np.float64], shift: NDArray[np.float64]) -> tuple[float, float]:
    """Shift at zero area of the least-squares line, and its standard error."""
    basis = np.stack([np.ones_like(area), area], axis=1)
    coefficients, *_ = np.linalg.lstsq(basis, shift, rcond=None)
    left = shift - basis @ coefficients
    free = max(1, len(shift) - 2)
    variance = float(np.sum(left**2)) / free * np.linalg.inv(basis.T @ basis)[0, 0]
    return float(coefficients[0]), sqrt(variance)

