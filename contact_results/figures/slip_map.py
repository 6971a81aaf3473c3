"""How far the bodies have slipped, and where to."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from contact_results.figures import style
from contact_results.figures.map_panels import (
    Above,
    MapFrame,
    draw_arrows,
    draw_cells,
    map_axes,
    outline,
)
from contact_results.figures.shown_steps import selected, span, tangential_load, vectors
from contact_results.natural_sizes import SI, Units

if TYPE_CHECKING:
    from contact_results.surface import Result


def slip_map(result: Result, cells: Above, units: Units = SI) -> Figure:
    """Slip of the body on the indenter since the start of the history, at the end of the steps that
    have any: its size as a colour, arrows along it, and the border of the stick zone."""
    frame = MapFrame.around_contact(result, cells, units)
    slips = selected(vectors(cells, result.steps, "slip"))
    largest = max(float(np.max(np.hypot(*slip))) for _, slip in slips)
    unit = units.of("slip", largest, "m")
    width, height = frame.figure_size(len(slips))
    figure = style.new_figure(width, height + 0.2)
    axes = map_axes(figure, frame, len(slips))
    for ax, (step, slip) in zip(axes, slips, strict=True):
        touching, sticking = cells.scalar(step, "in_contact"), cells.scalar(step, "in_stick")
        assert touching is not None
        colours = {"cmap": style.MAGNITUDE_MAP, "vmin": 0.0, "vmax": largest / unit.size}
        size = np.where(touching, np.hypot(*slip) / unit.size, np.nan)
        image = draw_cells(ax, frame, size, **colours)
        ax.set_facecolor(style.OUTSIDE_COLOUR)
        draw_arrows(ax, frame, slip, touching)
        if sticking is not None:
            outline(ax, frame, sticking, "white")
        ax.set_title(f"{span([step])}: {tangential_load(step)}")
    figure.colorbar(image, ax=axes, label=unit.labelled("slip since the start"), shrink=0.9)
    figure.supylabel("arrows: slip of the body; white: stick", fontsize=style.CAPTION_SIZE)
    return figure
