"""Normal force against approach."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from contact_results.figures import style
from contact_results.figures.shown_steps import on_axis
from contact_results.natural_sizes import SI, Units

if TYPE_CHECKING:
    from contact_results.surface import Result


def loading_plot(result: Result, units: Units = SI) -> Figure:
    """The curve by itself."""
    figure = style.new_figure(5.0, 3.6)
    draw_loading(figure.subplots(), result, units)
    return figure


def draw_loading(ax: Any, result: Result, units: Units = SI) -> None:
    """Force and approach of every increment, from first touch."""
    path = [(0.0, 0.0), *((i.approach, i.normal_force) for i in result.increments)]
    approach, force = np.array(path).T
    x, along = on_axis("approach", approach, units=units)
    y, upward = on_axis("normal_force", force, "W", units)
    # A line between touch and one end would be no path that the contact took.
    line = "-" if len(path) > 3 else ""
    ax.plot(x, y, color=style.LINE_COLOURS[0], linestyle=line, marker="o", markersize=3.5)
    ax.set_xlim(left=0.0)
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel(along)
    ax.set_ylabel(upward)
