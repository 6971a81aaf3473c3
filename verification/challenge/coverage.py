"""Whether the points of a field stand for all of the contact: what is left out has no error."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi

import numpy as np

from verification.challenge.answer import Field
from verification.challenge.requested_quantities import AskedField

# Times N^(-3/4) π^(-1/4), √radius over the area of a disc of N cells: what the number of centres
# in it may be off, as in Gauss's circle. Twice that is seen on our grids, whose axes are its own.
SCATTER = 3.0


def sums_of(
    asked: AskedField, field: Field
) -> Iterator[tuple[str, str, float, float, float, float]]:
    """What sums over the points must give: name, sum in words, what it is, should be, is over, and
    how far it may be off where points do no better."""
    forces, exact = field.value * field.area, asked.traction
    yield "load carried", "Σ value·area", float(np.sum(forces)), asked.total, asked.scale, 0.0
    spread = float(np.sum(forces * (field.x**2 + field.y**2)))
    reach = asked.scale * max(exact.semi_axes) ** 2
    yield "spread of the load", "Σ value·area·r²", spread, exact.spread, reach, 0.0
    area, scatter = _covered(field, exact.semi_axes)
    yield "contact covered", "Σ area in the contact, over its own", area, 1.0, 1.0, scatter


def _covered(field: Field, semi_axes: tuple[float, float]) -> tuple[float, float]:
    """Part of an ellipse that the areas of a field cover, and how far an honest one may be from 1.

    Areas are summed outwards, each in the middle of itself, up to where the edge lies between two
    points. Rings, which stand on one ray, may end half a ring before it; centres of cells scatter.

    semi_axes  of the ellipse around the origin, along x and y [length]
    """
    whole = pi * semi_axes[0] * semi_axes[1]
    out = (field.x / semi_axes[0]) ** 2 + (field.y / semi_axes[1]) ** 2
    order = np.argsort(out)
    out, area = out[order], field.area[order] / whole
    middles = np.cumsum(area) - area / 2
    within = float(np.interp(1.0, out, middles, right=np.nan))
    if np.isnan(within):
        within = float(np.sum(area))
    if not np.any(field.y):
        return within, float(area[max(int(np.searchsorted(out, 1.0, "right")) - 1, 0)]) / 2
    cells = 1 / float(np.median(area))
    return within, SCATTER * cells**-0.75 * pi**-0.25
