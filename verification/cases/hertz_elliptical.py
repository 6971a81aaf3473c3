"""Hertz contact with an elliptical contact area."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from verification.cases.hertz_point import EDGE
from verification.judging.case import Case, Level
from verification.judging.declared_case import Falls, Refined, case, judged
from verification.judging.drawings import profile
from verification.judging.ladder import on_cells, part_of_side
from verification.judging.observables import APPROACH, CONTACT_RADIUS, PEAK_PRESSURE, PRESSURE_L2
from verification.judging.refinement import refinement
from verification.problems.elliptical import BARREL, EXACT

MEAN_RADIUS = replace(
    CONTACT_RADIUS,
    name="mean_contact_radius",
    meaning="√(contact area / π) = √(ab)",
    value=lambda exact: float(np.sqrt(exact.semi_axes[0] * exact.semi_axes[1])),
)
ROWS = (
    Refined(
        PEAK_PRESSURE, 2.0, 1.5e-4,
        "order 2; the cap is the figure required of hertz_point at 128 x 128",
    ),
    Refined(APPROACH, 2.0, 5e-5, "order 2; the cap is the figure required of hertz_point"),
    Refined(MEAN_RADIUS, 1.0, part_of_side(0.1), f"{EDGE} along the longer axis"),
    Falls(PRESSURE_L2, 1.0, "square-root edge, as for the circle"),
)  # fmt: skip


def hertz_elliptical(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    grids = on_cells(BARREL, refinement(32, 256 if level is Level.QUICK else 512))
    return case(
        "hertz_elliptical",
        "Elliptical Hertz contact",
        "A barrel with principal radii of 90 mm and 18 mm: the contact is an ellipse with "
        f"b/a = {EXACT.axis_ratio:.4f}. Cells are oblong like the window, three semi-axes along "
        "each side.",
        judged(grids, ROWS),
        charts=(
            profile(
                grids,
                "elliptical_profile",
                "Pressure along the long axis of the ellipse",
                "Computed pressure on the row of cells next to y = 0 over the exact one, and their "
                "difference.",
                "p / p₀",
                EXACT.peak_pressure,
            ),
        ),
    )
