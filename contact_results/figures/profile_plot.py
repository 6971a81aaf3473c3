"""Pressure and shear along y = 0."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from contact_results.figures import style
from contact_results.figures.map_panels import MapFrame
from contact_results.figures.shown_steps import (
    runs_of_equal,
    selected,
    shear_of,
    sheared,
    span,
)
from contact_results.surface import surface_of
from contact_scene.engineering_units import EngineeringUnit, engineering_unit
from semi_analytical import Result


def profile_plot(result: Result) -> Figure:
    """Pressure, and where there is friction shear, at the end of the loading steps."""
    with_shear = bool(sheared(result.steps))
    frame = MapFrame.around_contact(result)
    figure = style.new_figure(6.0, 5.6 if with_shear else 3.2)
    axes = figure.subplots(2 if with_shear else 1, 1, sharex=True, squeeze=False)[:, 0]
    _draw_pressure(axes[0], result, frame.unit)
    if with_shear:
        _draw_shear(axes[1], result, frame.unit)
    axes[-1].set_xlabel(f"x at y = 0 ({frame.unit.name})")
    axes[-1].set_xlim(-frame.shown[0] / frame.unit.size, frame.shown[0] / frame.unit.size)
    return figure


def _draw_pressure(ax: Any, result: Result, length: EngineeringUnit) -> None:
    unit = engineering_unit(max(step.peak_pressure for step in result.steps), "Pa")
    groups = runs_of_equal(selected(result.steps), lambda step: step.pressure)
    for number, group in enumerate(groups):
        pressure = surface_of(result).along(group[0].pressure) / unit.size
        ax.plot(result.grid.x / length.size, pressure, label=span(group), **_line(number))
    ax.set_ylim(bottom=0.0)
    ax.set_ylabel(f"pressure p ({unit.name})")
    _legend(ax)


def _draw_shear(ax: Any, result: Result, length: EngineeringUnit) -> None:
    x = result.grid.x / length.size
    steps = selected(sheared(result.steps))
    # The larger component on this line: the load may act along y.
    k = int(np.argmax([max(np.max(np.abs(shear_of(step)[k])) for step in steps) for k in (0, 1)]))
    unit = engineering_unit(max(float(np.max(np.abs(shear_of(step)[k]))) for step in steps), "Pa")
    mu = result.scene.friction.coefficient if result.scene.friction else None
    if isinstance(mu, float):
        for number, group in enumerate(runs_of_equal(steps, lambda step: step.pressure)):
            bound = mu * surface_of(result).along(group[0].pressure) / unit.size
            ax.fill_between(x, -bound, bound, color=style.GREY, alpha=0.12, linewidth=0)
            label = "± µp" if number == 0 else None
            ax.plot(x, bound, color=style.GREY, linewidth=0.8, label=label)
            ax.plot(x, -bound, color=style.GREY, linewidth=0.8)
    for number, step in enumerate(steps):
        shear = surface_of(result).along(shear_of(step)[k]) / unit.size
        ax.plot(x, shear, label=span([step]), **_line(number))
    ax.axhline(0.0, color="black", linewidth=0.5)
    ax.set_ylabel(f"shear $q_{'xy'[k]}$ ({unit.name})")
    _legend(ax)


def _line(number: int) -> dict[str, Any]:
    return {"color": style.LINE_COLOURS[number], "linestyle": style.LINE_STYLES[number]}


def _legend(ax: Any) -> None:
    ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), handlelength=2.6)
