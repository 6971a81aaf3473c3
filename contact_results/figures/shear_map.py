"""The shear on the surface, one row of panels for each of its components."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from contact_results.figures import style
from contact_results.figures.map_panels import MapFrame, draw_cells, map_axes, outline
from contact_results.figures.shown_steps import SAME, selected, span, tangential_load, vectors
from contact_results.natural_sizes import SI, Units

if TYPE_CHECKING:
    from contact_results.surface import Cells, Result


def shear_map(result: Result, cells: Cells, units: Units = SI) -> Figure:
    """Shear at the end of the steps that have any, with the border of the stick zone.

    The components have scales of their own: the one across the load is a few per cent of the
    one along it, and left out where it is nothing but round-off.
    """
    frame = MapFrame.around_contact(result, cells, units)
    shears = selected(vectors(cells, result.steps, "shear"))
    largest = np.max([np.max(np.abs(shear), axis=(1, 2)) for _, shear in shears], axis=0).tolist()
    components = [k for k in (0, 1) if largest[k] > SAME * max(largest)]
    width, height = frame.figure_size(len(shears), len(components))
    figure = style.new_figure(width, height + 0.3)  # and a line of text at the bottom
    rows = figure.subfigures(len(components), 1, squeeze=False)[:, 0]
    for k, row in zip(components, rows, strict=True):
        unit = units.of("shear", largest[k], "Pa")
        limit = largest[k] / unit.size
        axes = map_axes(row, frame, len(shears))
        for ax, (step, shear) in zip(axes, shears, strict=True):
            colours = {"cmap": style.SIGNED_MAP, "vmin": -limit, "vmax": limit}
            image = draw_cells(ax, frame, shear[k] / unit.size, **colours)
            if step.in_stick is not None:
                outline(ax, frame, step.in_stick, "black")
            ax.set_title(f"{span([step])}: {tangential_load(step)}")
        label = unit.labelled(f"shear $q_{'xy'[k]}$")
        row.colorbar(image, ax=axes, label=label, shrink=0.9)
    rows[-1].supxlabel("black line: border of the stick zone", fontsize="medium")
    return figure
