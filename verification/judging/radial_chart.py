"""A traction of finite elements over the radius, with what it should be."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.profile_chart import ProfileLabels
from verification.observed.ring_errors import SHOWN, at_radii

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
            curve("finite elements", r, found, Look.COMPUTED),
        ),
        height=2.6,
    )
    below = Panel(
        x_label=labels.x_label,
        y_label=labels.difference_label,
        curves=(curve("", known_r, difference, Look.COMPUTED),),
    )
    return Chart(
        name=labels.name, title=labels.title, caption=labels.caption, rows=((above,), (below,))
    )
