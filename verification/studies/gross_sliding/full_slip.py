"""Where the stick area vanishes, extrapolated from the increments in which there is still some.

The stick area falls to zero linearly in the shift: exactly so for Cattaneo and Mindlin's contact,
where c²/a² = 1 - shift / (shift at sliding), and to leading order wherever a smooth field passes
its last extremum. So a line through area against shift gives the shift, and the force is read off
the smooth curve of force against shift, between the last increment that has stick area and the
first that has none. The bar is what half a cell more or less of stick radius would change, the
scatter about the line, and how far a straight line between the increments is from the curve. A
stick zone that is small from the outset and leaves the contact as a whole has no such line: then
the middle between those two increments is given, and half their distance as bar.
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
# A force that is not known better than this is not known.
LARGEST_BAR = 0.05


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
        return f"{self.force:.4f} ± {max(self.uncertainty, 0.0001):.4f}"


def full_slip(path: SlidingPath) -> FullSlip | None:
    """Where all slips from then on; None if the path does not get there or is too coarse."""
    end = 1 + max((n for n, p in enumerate(path.points) if not p.full_slip), default=0)
    if end == len(path.points):
        return None
    largest = max(range(end), key=lambda n: path.points[n].stick_fraction)
    if path.points[largest].stick_fraction <= LARGEST_FRACTION:
        found = _middle(path.points[end - 1], path.points[end])
    else:
        points = _resolved(path.points[largest:end])
        if len(points) < FEWEST_POINTS:
            return None
        found = _extrapolated(path, points, end)
    return found if found.uncertainty <= LARGEST_BAR else None


def _middle(last: SlidingPoint, first: SlidingPoint) -> FullSlip:
    """Between the last increment with stick area and the first without."""
    force, half = (last.force + first.force) / 2, abs(first.force - last.force) / 2
    return FullSlip(force, (last.shift + first.shift) / 2, half)


def _extrapolated(path: SlidingPath, points: Sequence[SlidingPoint], end: int) -> FullSlip:
    """The line through these points, kept between increment `end` - 1 and `end`."""
    shifts, forces = [p.shift for p in path.points], [p.force for p in path.points]
    curve = PchipInterpolator(shifts, forces)

    def force(shift: float) -> float:
        return float(curve(np.clip(shift, shifts[0], shifts[-1])))

    shift = np.array([p.shift for p in points])
    radius = np.sqrt([p.stick_fraction for p in points])
    fitted, scatter = _intercept(radius**2, shift)
    inside = float(np.clip(fitted, shifts[end - 1], shifts[end]))
    half_cell = path.cell_over_radius / 2
    by_cell = [_intercept((radius + e) ** 2, shift)[0] for e in (-half_cell, half_cell)]
    by_fit = [fitted - scatter, fitted + scatter]
    bars = [max(abs(force(s) - force(inside)) for s in ends) for ends in (by_cell, by_fit)]
    straight = float(np.interp(inside, shifts, forces))
    return FullSlip(force(inside), inside, hypot(*bars, straight - force(inside)))


def _resolved(points: Sequence[SlidingPoint]) -> list[SlidingPoint]:
    """Increments whose stick zone is small, but not too small for the cells."""
    small = [p for p in points if p.stick_fraction <= LARGEST_FRACTION]
    return [p for p in small if p.stick_cells >= FEWEST_CELLS]


def _intercept(area: NDArray[np.float64], shift: NDArray[np.float64]) -> tuple[float, float]:
    """Shift at zero area of the least-squares line, and its standard error."""
    basis = np.stack([np.ones_like(area), area], axis=1)
    coefficients, *_ = np.linalg.lstsq(basis, shift, rcond=None)
    left = shift - basis @ coefficients
    free = max(1, len(shift) - 2)
    variance = float(np.sum(left**2)) / free * np.linalg.inv(basis.T @ basis)[0, 0]
    return float(coefficients[0]), sqrt(variance)
