"""The shear on the surface, one row of panels for each of its components."""

import numpy as np
from matplotlib.figure import Figure

from contact_results.figures import style
from contact_results.figures.map_panels import (
    MapFrame,
    draw_cells,
    map_axes,
    outline,
)
from contact_results.figures.shown_steps import (
    SAME,
    selected,
    shear_of,
    sheared,
    span,
    tangential_load,
)
from contact_scene.engineering_units import engineering_unit
from semi_analytical import Result


def shear_map(result: Result) -> Figure:
    """Shear at the end of the steps that have any, with the border of the stick zone.

    The components have scales of their own: the one across the load is a few per cent of the
    one along it, and left out where it is nothing but round-off.
    """
    frame = MapFrame.around_contact(result)
    steps = selected(sheared(result.steps))
    largest = [max(float(np.max(np.abs(shear_of(step)[k]))) for step in steps) for k in (0, 1)]
    components = [k for k in (0, 1) if largest[k] > SAME * max(largest)]
    width, height = frame.figure_size(len(steps), len(components))
    figure = style.new_figure(width, height + 0.3)  # and a line of text at the bottom
    rows = figure.subfigures(len(components), 1, squeeze=False)[:, 0]
    for k, row in zip(components, rows, strict=True):
        unit = engineering_unit(largest[k], "Pa")
        limit = largest[k] / unit.size
        axes = map_axes(row, frame, len(steps))
        for ax, step in zip(axes, steps, strict=True):
            colours = {"cmap": style.SIGNED_MAP, "vmin": -limit, "vmax": limit}
            image = draw_cells(ax, frame, shear_of(step)[k] / unit.size, **colours)
            if step.in_stick is not None:
                outline(ax, frame, step.in_stick, "black")
            ax.set_title(f"{span([step])}: {tangential_load(step)}")
        label = f"shear $q_{'xy'[k]}$ ({unit.name})"
        row.colorbar(image, ax=axes, label=label, shrink=0.9)
    rows[-1].supxlabel("black line: border of the stick zone", fontsize="medium")
    return figure
