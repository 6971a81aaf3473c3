"""Pressure, shear and slip on the line through the axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from contact_results.figures import style
from contact_results.figures.shown_steps import SAME, runs_of_equal, selected, span, vectors
from contact_results.natural_sizes import SI, Units
from contact_scene.engineering_units import EngineeringUnit
from contact_scene.friction import FRICTIONLESS

if TYPE_CHECKING:
    from contact_results.surface import Field, Increment, Result, Surface

MARGIN = 1.15  # of the contact's extent, so that its edge is seen against the outside


@dataclass(frozen=True, eq=False)
class Component:
    """Pressure, or a component of shear or slip, on the line at the end of some load steps.

    name   label of the axis
    steps  those shown
    lines  values (n,) by the number of the step
    unit   of the axis
    """

    name: str
    steps: Sequence[Increment]
    lines: dict[int, Field]
    unit: EngineeringUnit

    def draw(self, ax: Any, x: Field) -> None:
        """Draw a line for every step; equal neighbours share one."""
        for number, group in enumerate(self.groups):
            values = self.lines[group[0].step] / self.unit.size
            ax.plot(x, values, label=span(group), **style.line(number))
        ax.axhline(0.0, color="black", linewidth=0.5)
        ax.set_ylabel(self.unit.labelled(self.name))
        style.legend_beside(ax)

    @property
    def groups(self) -> list[list[Increment]]:
        """Adjacent steps with equal values."""
        return runs_of_equal(self.steps, lambda step: self.lines[step.step])


def profile_plot(result: Result, surface: Surface, units: Units = SI) -> Figure:
    """Draw pressure, and shear if there is any, at the end of the load steps."""
    shears = _components(surface, result.steps, ("shear", "q", "Pa"), units)
    figure = style.new_figure(6.0, 3.2 + 2.4 * len(shears))
    axes = figure.subplots(1 + len(shears), 1, sharex=True, squeeze=False)[:, 0]
    length = _line_axis(axes[-1], result, surface, units)
    x = surface.line.places / length.size
    _pressures(surface, result.steps, units).draw(axes[0], x)
    axes[0].set_ylim(bottom=0.0)
    for ax, shear in zip(axes[1:], shears, strict=True):
        _draw_limit(ax, x, result, surface, shear)
        shear.draw(ax, x)
    return figure


def draw_end(ax: Any, result: Result, surface: Surface, units: Units = SI) -> None:
    """Draw the pressure at the end of the history, with shear over the coefficient of friction
    where that is one number, so that the two meet where the surface slips."""
    length, end = _line_axis(ax, result, surface, units), result.steps[-1]
    x, pressure = surface.line.places / length.size, _pressures(surface, [end], units)
    unit = pressure.unit
    ax.plot(x, pressure.lines[end.step] / unit.size, label=pressure.name, **style.line(0))
    friction = result.scene.friction
    coefficient = friction.uniform if friction is not None else None
    if coefficient:
        shears = _components(surface, [end], ("shear", "q", "Pa"), units)
        for number, shear in enumerate(shears, 1):
            scaled = shear.lines[end.step] / (coefficient * unit.size)
            name = f"{shear.name.removeprefix('shear ')}/µ"
            ax.plot(x, scaled, label=name, **style.line(number))
    ax.axhline(0.0, color="black", linewidth=0.5)
    ax.set_ylabel(unit.labelled("traction"))
    ax.legend(loc="best", fontsize="small")


def slip_plot(result: Result, surface: Surface, units: Units = SI) -> Figure | None:
    """Draw the slip since the start of the history at the end of the load steps; None without."""
    slips = _components(surface, result.steps, ("slip", "s", "m"), units)
    if not slips:
        return None
    figure = style.new_figure(6.0, 0.8 + 2.4 * len(slips))
    axes = figure.subplots(len(slips), 1, sharex=True, squeeze=False)[:, 0]
    x = surface.line.places / _line_axis(axes[-1], result, surface, units).size
    for ax, slip in zip(axes, slips, strict=True):
        slip.draw(ax, x)
        _draw_stick(ax, x, surface, slip)
    axes[0].set_title("bars: where it sticks", loc="left", fontsize=style.CAPTION_SIZE)
    return figure


def _pressures(surface: Surface, steps: Sequence[Increment], units: Units) -> Component:
    lines = {step.step: surface.along(_pressure(step, surface)) for step in selected(steps)}
    unit = units.of("pressure", max(step.peak_pressure for step in steps), "Pa")
    return Component("pressure p", selected(steps), lines, unit)


def _components(
    surface: Surface, steps: Sequence[Increment], named: tuple[str, str, str], units: Units
) -> list[Component]:
    """Return the components along and across the line that are more than round-off.

    named  the field, its symbol and its unit
    """
    name, symbol, unit = named
    shown = selected(vectors(surface, steps, name))
    lines = {step.step: surface.vector_along(vector) for step, vector in shown}
    if name == "slip":  # there is none where nothing touches
        for step, _ in shown:
            apart = surface.along(_pressure(step, surface)) <= 0
            lines[step.step] = np.where(apart, np.nan, lines[step.step])
    sizes = [np.nanmax(np.abs(vector), axis=1, initial=0.0) for vector in lines.values()]
    largest = np.max([(0.0, 0.0), *sizes], axis=0).tolist()
    return [
        Component(
            f"{name} ${symbol}_{{{surface.line.components[k]}}}$",
            [step for step, _ in shown],
            {step: vector[k] for step, vector in lines.items()},
            units.of(name, largest[k], unit),
        )
        for k in (0, 1)
        if largest[k] > SAME * max(largest)
    ]


def _draw_stick(ax: Any, x: Field, surface: Surface, shown: Component) -> None:
    """Draw a bar for every step above the axis of places, over those that stick at its end."""
    for number, group in enumerate(shown.groups):
        sticking = surface.scalar(group[-1], "in_stick")
        if sticking is None:
            continue
        height = np.full(len(x), 0.02 + 0.03 * number)
        height[surface.along(sticking.astype(float)) <= 0.5] = np.nan
        colour = style.LINE_COLOURS[number]
        ax.plot(x, height, color=colour, linewidth=3.0, transform=ax.get_xaxis_transform())


def _draw_limit(ax: Any, x: Field, result: Result, surface: Surface, shear: Component) -> None:
    """Draw ± µp in grey."""
    groups = runs_of_equal(shear.steps, lambda step: _pressure(step, surface))
    for number, group in enumerate(groups):
        limit = (result.scene.friction or FRICTIONLESS).limit(_pressure(group[0], surface))
        bound = surface.along(limit) / shear.unit.size
        ax.fill_between(x, -bound, bound, color=style.GREY, alpha=0.12, linewidth=0)
        label = "± µp" if number == 0 else None
        ax.plot(x, bound, color=style.GREY, linewidth=0.8, label=label)
        ax.plot(x, -bound, color=style.GREY, linewidth=0.8)


def _line_axis(ax: Any, result: Result, surface: Surface, units: Units) -> EngineeringUnit:
    """Label the line and cut it to the contact; returns the unit of length."""
    places = surface.line.places
    touched = [surface.along(_pressure(step, surface)) > 0 for step in result.steps]
    inside = np.flatnonzero(np.any(touched, axis=0))
    ends = [max(inside[0] - 1, 0), min(inside[-1] + 1, len(places) - 1)]
    reach = float(min(MARGIN * np.max(np.abs(places[ends])), np.max(places)))
    length = units.of("length", reach, "m")
    ax.set_xlabel(length.labelled(surface.line.label))
    ax.set_xlim(-reach / length.size if places[0] < 0 else 0.0, reach / length.size)
    return length


def _pressure(step: Increment, surface: Surface) -> Field:
    pressure = surface.scalar(step, "pressure")
    assert pressure is not None
    return pressure
