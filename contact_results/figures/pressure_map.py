"""The pressure on the surface."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from contact_results.figures import style
from contact_results.figures.map_panels import MapFrame, draw_cells, map_axes
from contact_results.figures.shown_steps import normal_load, runs_of_equal, selected, span
from contact_results.natural_sizes import SI, Units

if TYPE_CHECKING:
    from contact_results.surface import Cells, Result


def pressure_map(result: Result, cells: Cells, units: Units = SI) -> Figure:
    """Pressure at the end of the loading steps; neighbours of equal pressure share a panel."""
    frame = MapFrame.around_contact(result, cells, units)
    groups = runs_of_equal(selected(result.steps), lambda step: step.pressure)
    peak = max(step.peak_pressure for step in result.steps)
    unit = units.of("pressure", peak, "Pa")
    figure = style.new_figure(*frame.figure_size(len(groups)))
    axes = map_axes(figure, frame, len(groups))
    for ax, group in zip(axes, groups, strict=True):
        colours = {"cmap": style.MAGNITUDE_MAP, "vmin": 0.0, "vmax": peak / unit.size}
        pressure = np.where(group[0].in_contact, group[0].pressure / unit.size, np.nan)
        image = draw_cells(ax, frame, pressure, **colours)
        ax.set_facecolor(style.OUTSIDE_COLOUR)
        ax.set_title(f"{span(group)}: {normal_load(group[0])}")
    figure.colorbar(image, ax=axes, label=unit.labelled("pressure p"), shrink=0.9)
    return figure
