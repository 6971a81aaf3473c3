"""Where the bodies stick and where they slip."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from contact_results.figures import style
from contact_results.figures.map_panels import MapFrame, draw_cells, map_axes
from contact_results.figures.shown_steps import selected, span, tangential_load

if TYPE_CHECKING:
    from contact_results.surface import Cells, Result

ZONES = (
    ("no contact", style.OUTSIDE_COLOUR),
    ("slip", style.SLIP_COLOUR),
    ("stick", style.STICK_COLOUR),
)


def stick_slip_map(result: Result, cells: Cells) -> Figure:
    """Zones of stick and slip at the end of the loading steps."""
    frame = MapFrame.around_contact(result, cells)
    steps = selected([step for step in result.steps if step.in_stick is not None])
    width, height = frame.figure_size(len(steps))
    figure = style.new_figure(width - 0.6, height + 0.3)  # a legend below, no colour bar
    colours = ListedColormap([colour for _, colour in ZONES])
    for ax, step in zip(map_axes(figure, frame, len(steps)), steps, strict=True):
        # The zone's number in ZONES: stick implies contact.
        zone = step.in_contact.astype(int) + np.asarray(step.in_stick).astype(int)
        draw_cells(ax, frame, zone, cmap=colours, vmin=0, vmax=len(ZONES) - 1)
        ax.set_title(f"{span([step])}: {tangential_load(step)}")
    patches = [Patch(facecolor=c, edgecolor=style.GREY, label=name) for name, c in ZONES]
    figure.legend(handles=patches, loc="outside upper center", ncols=len(ZONES))
    return figure
