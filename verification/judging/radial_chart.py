"""A traction of finite elements over the radius, with what it should be."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.profile_chart import ProfileLabels
from verification.observed.ring_errors import SHOWN, at_radii
from verification.solver import Solver

if TYPE_CHECKING:
    from fem_reference import Increment

Field = NDArray[np.float64]


def radial_chart(
    labels: ProfileLabels,
    radius: float,
    scale: float,
    increment: Increment,
    traction: Field,
    exact: tuple[Field, Field],
    profile: str,
) -> Chart:
    """A traction over the radius with what it should be in grey, and their difference below.

    radius  that r is divided by; scale what the traction is divided by
    exact   radii and values of the reference
    profile by which a page finds it drawn by both solvers
    """
    shown = increment.radii <= SHOWN * radius
    r, found = increment.radii[shown] / radius, traction[shown] / scale
    known_r, known = exact[0] / radius, exact[1] / scale
    difference = at_radii(increment, traction, exact[0]) / scale - known
    above = Panel(
        x_label="",
        y_label=labels.y_label,
        curves=(
            curve("reference", known_r, known, Look.REFERENCE, 0, profile, Solver.ELEMENTS),
            curve("finite elements", r, found, Look.COMPUTED, 0, profile, Solver.ELEMENTS),
        ),
        height=2.6,
    )
    below = Panel(
        x_label=labels.x_label,
        y_label=labels.difference_label,
        curves=(curve("", known_r, difference, Look.COMPUTED, 0, profile, Solver.ELEMENTS),),
    )
    return Chart(
        name=labels.name, title=labels.title, caption=labels.caption, rows=((above,), (below,))
    )
