"""Tractions over the radius as finite elements give them: their errors, and charts of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.profile_chart import ProfileLabels

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
    increment: Increment, traction: Field, exact: Callable[[Field], Field], within: float
) -> float:
    """Of the rings out to a radius, against a closed form of the radius; dimension of the
    traction."""
    judged = increment.radii <= within
    return float(np.max(np.abs(traction - exact(increment.radii))[judged]))


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


def radial_chart(
    labels: ProfileLabels,
    radius: float,
    scale: float,
    increment: Increment,
    traction: Field,
    exact: tuple[Field, Field],
) -> Chart:
    """A traction over the radius with what it should be in grey, and their difference below.

    radius  that r is divided by; scale what the traction is divided by
    exact   radii and values of the reference
    """
    shown = increment.radii <= SHOWN * radius
    r, found = increment.radii[shown] / radius, traction[shown] / scale
    known_r, known = exact[0] / radius, exact[1] / scale
    difference = at_radii(increment, traction, exact[0]) / scale - known
    above = Panel(
        x_label="",
        y_label=labels.y_label,
        curves=(
            curve("reference", known_r, known, Look.REFERENCE),
            curve("finite elements", r, found),
        ),
        height=2.6,
    )
    below = Panel(
        x_label=labels.x_label,
        y_label=labels.difference_label,
        curves=(curve("", known_r, difference),),
    )
    return Chart(
        name=labels.name, title=labels.title, caption=labels.caption, rows=((above,), (below,))
    )
