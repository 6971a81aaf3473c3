"""What a report shows of pressing with friction: profiles, and errors by grid and increments."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from verification.exhibits.chart import Chart, Look, Panel, curve
from verification.exhibits.profile_chart import SHOWN
from verification.exhibits.table import NONE, Table
from verification.judging.ladder import cells_label
from verification.judging.pressing_errors import (
    judged_radii,
    pressure_at,
    pressure_error,
    shear_at,
    shear_error,
)
from verification.observed.end_state import approach, contact_radius, stick_radius
from verification.observed.radial_profile import outward
from verification.problems.indentation import Indentation
from verification.problems.paper_scene import HERTZ
from verification.quantities import shear_of

if TYPE_CHECKING:
    from semi_analytical import Result


def indentation_table(results: Iterable[tuple[Indentation, Result]]) -> Table:
    """One row per run."""
    rows = tuple(
        (
            f"{one.name}, {result.grid.cells[0]}², {len(result.increments)}",
            f"{approach(result) / one.approach - 1:+.1e}",
            f"{contact_radius(result) / one.contact_radius - 1:+.1e}",
            *(
                f"{error(result, -1, one.problem(one.increments)):.1e}"
                for error in (pressure_error, shear_error)
            ),
            f"{stick_radius(result) / one.contact_radius:.4f} ({one.stick_part:.4f})",
            f"{np.median([i.convolutions for i in result.increments]):.0f}",
        )
        for one, result in results
    )
    return Table(
        title="Errors, stick radius and cost",
        columns=("contact, cells, increments", "approach", "radius", "pressure / p_H",
                 "shear / µp_H", "c / a (reference)", "convolutions per increment"),
        rows=rows,
        note="Approach, radius and pressure hardly notice the increments; the shear of the stick "
        "zone is first order in them.", units=NONE
    )  # fmt: skip


def indentation_chart(one: Indentation, result: Result) -> Chart:
    """Pressure and outward shear over the reference, each with a strip of the difference."""
    grid, end, a = result.grid, result.steps[-1], one.contact_radius
    half = slice(grid.cells[0] // 2, None)
    row = grid.cells[1] // 2
    r = np.hypot(grid.x[half], grid.y[row]) / a
    shown = r < SHOWN
    unit = HERTZ.peak_pressure
    radii = judged_radii(result, one.problem(one.increments))
    fields = {
        "p / p_H": (end.pressure, one.pressure, pressure_at, unit),
        "q / µp_H": (outward(shear_of(end), grid), one.shear, shear_at, one.friction * unit),
    }
    panels = []
    for name, (field, exact, at, scale) in fields.items():
        found = at(result, radii).mean(axis=1)
        panels += [
            Panel(
                x_label="",
                y_label=name,
                curves=(
                    curve(
                        "reference", one.row["r_over_a"], exact(one.radii) / scale, Look.REFERENCE
                    ),
                    curve("computed", r[shown], field[half, row][shown] / scale),
                ),
                height=1.6,
            ),
            Panel(
                x_label="",
                y_label=f"Δ{name}",
                curves=(curve("", radii / a, (found - exact(radii)) / scale),),
            ),
        ]
    panels[-1] = panels[-1].model_copy(update={"x_label": "r / a"})
    return Chart(
        name=f"frictional_indentation_{one.file_name}",
        title=f"Pressure and outward shear, {one.name}",
        caption=f"Computed on {cells_label(grid.cells[0])} cells in {one.increments} increments "
        "along the cells next to y = 0, over the reference. The shear rises in the stick disc and "
        "follows µp outside it. Below either: computed, as the mean around the circle, less the "
        "reference, at the radii that are judged.",
        rows=tuple((panel,) for panel in panels),
    )
