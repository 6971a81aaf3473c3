"""Tractions over the radius as finite elements give them, and their errors."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from fem_reference import Increment

Field = NDArray[np.float64]
SHOWN = 1.1  # contact radii
IN_ELEMENT = 40  # points of a sum that stands for an integral


def at_radii(increment: Increment, traction: Field, r: Field) -> Field:
    """Values between the rings; towards an edge the square of a traction is nearly linear in r²."""
    squared = np.interp(np.square(r), increment.radii**2, np.sign(traction) * traction**2)
    return np.asarray(np.sign(squared) * np.sqrt(np.abs(squared)))


def largest_error(
    increment: Increment, traction: Field, answer: Any, exact: Callable[[Field], Field],
    start: float, end: float,
) -> float:  # fmt: skip
    """Between two radii, against a field of an answer: at the rings, or at the radii that the
    answer is tabulated at; dimension of the traction."""
    tabulated = getattr(answer, "radii", None)
    r = increment.radii if tabulated is None else tabulated
    found = traction if tabulated is None else at_radii(increment, traction, r)
    judged = (r >= start) & (r <= end)
    return float(np.max(np.abs(found - exact(r))[judged]))


def between_rings(increment: Increment, radius: float) -> Field:
    """Radii out to a tenth beyond this one, many in every element [length]."""
    judged = increment.radii[:-1] < SHOWN * radius
    starts, sides = increment.radii[:-1][judged], np.diff(increment.radii)[judged]
    parts = (np.arange(IN_ELEMENT) + 0.5) / IN_ELEMENT
    return np.asarray((starts[:, None] + sides[:, None] * parts).ravel())


def relative_l2(
    increment: Increment, traction: Field, exact: Callable[[Field], Field], radius: float
) -> float:
    """√∫(traction - exact)² r dr / √∫ exact² r dr, linear between the rings as it is meant [1]."""
    r = between_rings(increment, radius)
    known = exact(r)
    error = np.interp(r, increment.radii, traction) - known
    return float(np.sqrt(np.sum(error**2 * r) / np.sum(known**2 * r)))


def relative_l1(
    increment: Increment, traction: Field, exact: Callable[[Field], Field], radius: float
) -> float:
    """∫|traction - exact| r dr / ∫p r dr, to be divided by a friction coefficient [1]."""
    r = between_rings(increment, radius)
    error = np.interp(r, increment.radii, traction) - exact(r)
    pressure = np.interp(r, increment.radii, increment.pressure)
    return float(np.sum(np.abs(error) * r) / np.sum(pressure * r))


def judged_within(elements: int) -> float:
    """Part of the contact radius where tractions are judged: 0.9, or less on coarse meshes, where
    the ripple of the last five elements at the edge reaches further in."""
    return min(0.9, 1 - 5 / elements)
