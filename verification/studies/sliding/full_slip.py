"""Where the stick area vanishes, extrapolated from the increments in which there is still some.

The stick area falls to zero linearly in the shift: exactly so for Cattaneo and Mindlin's contact,
where c²/a² = 1 - shift / (shift at sliding), and to leading order wherever a smooth field passes
its last extremum. So a line through area against shift gives the shift.

The force has a kink there: what a stick zone still carries goes with its radius, so that to the
power 3/2 of the shift that is left it falls short of a smooth curve (exactly so in that contact: T
= µW (1 - (1 - shift / shift at sliding)^(3/2))). A curve through the increments cuts that corner.
So this part is fitted and taken out, and the force is read off the smooth rest, between the last
increment that has stick area and the first that has none. The bar is what half a cell more or less
of stick radius would change, the scatter about the line, how far the fit is from the curve, and how
far a straight line between the increments of the rest is from it.

A stick zone that is small from the outset and leaves the contact as a whole has no such line: then
the middle between those two increments is given, and half their distance as bar.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from verification.studies.sliding.path import SlidingPath, SlidingPoint

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
    shift = np.array([p.shift for p in points])
    radius = np.sqrt([p.stick_fraction for p in points])
    fitted, scatter = _intercept(radius**2, shift)
    inside = float(np.clip(fitted, path.points[end - 1].shift, path.points[end].shift))
    half_cell = path.cell_over_radius / 2
    by_cell = [_intercept((radius + e) ** 2, shift)[0] for e in (-half_cell, half_cell)]
    by_fit = [fitted - scatter, fitted + scatter]
    force, *others = _forces_at(path, points, inside)
    bars = [
        max(abs(_forces_at(path, points, s)[0] - force) for s in ends) for ends in (by_cell, by_fit)
    ]
    return FullSlip(force, inside, hypot(*bars, *(other - force for other in others)))


def _forces_at(
    path: SlidingPath, points: Sequence[SlidingPoint], vanishing: float
) -> tuple[float, float, float]:
    """Force where the stick area vanishes at a shift: by the curve through the smooth rest of all
    increments, by straight lines through it, and by the fit to these points alone."""
    shifts = np.array([p.shift for p in path.points])
    forces = np.array([p.force for p in path.points])
    near = np.array([p.shift for p in points])
    basis = np.stack([np.ones_like(near), near - vanishing, _left(near, vanishing)], axis=1)
    fit, *_ = np.linalg.lstsq(basis, np.array([p.force for p in points]), rcond=None)
    rest = forces - fit[2] * _left(shifts, vanishing)
    at = np.clip(vanishing, shifts[0], shifts[-1])
    curve = PchipInterpolator(shifts, rest)
    return float(curve(at)), float(np.interp(at, shifts, rest)), float(fit[0])


def _left(shift: NDArray[np.float64], vanishing: float) -> NDArray[np.float64]:
    """What is left to the end of the stick area, over the shift there, to the power 3/2."""
    return np.asarray(np.maximum(1 - shift / vanishing, 0.0) ** 1.5)


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
