"""Tractions over the radius as finite elements give them: their errors, and charts of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from verification.cases.chart import Chart, Look, Panel, curve
from verification.cases.profile_chart import ProfileLabels

if TYPE_CHECKING:
    from fem_reference import Increment

Field = NDArray[np.float64]
SHOWN = 1.1  # contact radii


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
