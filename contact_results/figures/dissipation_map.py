"""Where friction dissipates energy."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from contact_results.figures import style
from contact_results.figures.map_panels import MapFrame, draw_cells, map_axes
from contact_results.figures.shown_steps import selected, span
from contact_results.natural_sizes import SI, Units
from contact_scene.engineering_units import engineering_unit, quantity

if TYPE_CHECKING:
    from contact_results.surface import Cells, Increment, Result

Field = NDArray[np.float64]


def dissipating(steps: Sequence[Increment], cells: Cells) -> list[tuple[Increment, Field]]:
    """The steps in which energy is dissipated, with how much per area in each (nx, ny)."""
    given = ((step, cells.scalar(step, "dissipation")) for step in steps)
    known = [(step, field) for step, field in given if field is not None]
    if not known:
        return []
    within = [known[0], *((now, d1 - d0) for (_, d0), (now, d1) in pairwise(known))]
    return [(step, lost) for step, lost in within if np.any(lost)]


def dissipation_map(result: Result, cells: Cells, units: Units = SI) -> Figure:
    """Energy per area dissipated within the loading steps, not since the start."""
    frame = MapFrame.around_contact(result, cells, units)
    lost = {step.step: field for step, field in dissipating(result.steps, cells)}
    steps = selected([step for step in result.steps if step.step in lost])
    peak = max(float(np.max(lost[step.step])) for step in steps)
    unit = engineering_unit(peak, "J/m²")
    figure = style.new_figure(*frame.figure_size(len(steps)))
    axes = map_axes(figure, frame, len(steps))
    for ax, step in zip(axes, steps, strict=True):
        colours = {"cmap": style.MAGNITUDE_MAP, "vmin": 0.0, "vmax": peak / unit.size}
        inside = step.in_contact | (lost[step.step] > 0)
        image = draw_cells(
            ax, frame, np.where(inside, lost[step.step] / unit.size, np.nan), **colours
        )
        ax.set_facecolor(style.OUTSIDE_COLOUR)
        total = float(np.sum(lost[step.step])) * cells.cell_area
        ax.set_title(f"{span([step])}: {quantity(total, 'J', 3)}")
    figure.colorbar(image, ax=axes, label=f"energy dissipated per area ({unit.name})", shrink=0.9)
    return figure
