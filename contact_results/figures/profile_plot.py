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
from contact_results.surface import Rings
from contact_scene.engineering_units import EngineeringUnit
from contact_scene.friction import FRICTIONLESS

if TYPE_CHECKING:
    from contact_results.surface import Field, Increment, Result, Surface

POINTS = 12  # of the end of a curve
MARGIN = 1.15  # of the contact's extent, so that its edge is seen against the outside


@dataclass(frozen=True, eq=False)
class Component:
    """One component of shear or slip on the line at the end of some loading steps.

    name   what an axis says
    steps  those shown
    lines  values (n,) by the number of the step
    unit   for the axis
    """

    name: str
    steps: Sequence[Increment]
    lines: dict[int, Field]
    unit: EngineeringUnit


def profile_plot(result: Result, surface: Surface, units: Units = SI) -> Figure:
    """Pressure, and where there is any shear, at the end of the loading steps."""
    shears = _components(surface, result.steps, ("shear", "q", "Pa"), units)
    figure = style.new_figure(6.0, 3.2 + 2.4 * len(shears))
    axes = figure.subplots(1 + len(shears), 1, sharex=True, squeeze=False)[:, 0]
    length = _line_axis(axes[-1], result, surface, units)
    x = surface.line.places / length.size
    _draw_pressure(axes[0], x, result, surface, units)
    for ax, shear in zip(axes[1:], shears, strict=True):
        _draw_bound(ax, x, result, surface, shear)
        _draw_component(ax, x, shear, surface)
    return figure


def draw_end(ax: Any, result: Result, surface: Surface, units: Units = SI) -> None:
    """Pressure at the end of the history, with shear over the coefficient of friction where that is
    one number, so that they meet where it slips."""
    length, end = _line_axis(ax, result, surface, units), result.steps[-1]
    x, edges = surface.line.places / length.size, _Edges.of(surface, end)
    unit = units.of("pressure", end.peak_pressure, "Pa")
    pressure = surface.along(_pressure(end, surface)) / unit.size
    ax.plot(*edges.drawn(x, pressure), label="pressure p", **style.line(0))
    friction = result.scene.friction
    coefficient = friction.uniform if friction is not None else None
    if coefficient:
        shears = _components(surface, [end], ("shear", "q", "Pa"), units)
        for number, shear in enumerate(shears, 1):
            scaled = shear.lines[end.step] / (coefficient * unit.size)
            name = f"{shear.name.removeprefix('shear ')}/µ"
            ax.plot(*edges.drawn(x, scaled), label=name, **style.line(number))
    ax.axhline(0.0, color="black", linewidth=0.5)
    ax.set_ylabel(unit.labelled("traction"))
    ax.legend(loc="best", fontsize="small")


def slip_plot(result: Result, surface: Surface, units: Units = SI) -> Figure | None:
    """Slip since the start of the history at the end of the loading steps; None without any."""
    slips = _components(surface, result.steps, ("slip", "s", "m"), units)
    if not slips:
        return None
    figure = style.new_figure(6.0, 0.8 + 2.4 * len(slips))
    axes = figure.subplots(len(slips), 1, sharex=True, squeeze=False)[:, 0]
    length = _line_axis(axes[-1], result, surface, units)
    for ax, slip in zip(axes, slips, strict=True):
        _draw_component(ax, surface.line.places / length.size, slip, None)
        _draw_stick(ax, surface.line.places / length.size, surface, slip)
    axes[0].set_title("bars: where it sticks", loc="left", fontsize=style.CAPTION_SIZE)
    return figure


def _components(
    surface: Surface, steps: Sequence[Increment], named: tuple[str, str, str], units: Units
) -> list[Component]:
    """Those along and across the line that are more than round-off.

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


def _draw_component(ax: Any, x: Field, shown: Component, tractions: Surface | None) -> None:
    """A line for every step; of tractions to the edges of the contact."""
    groups = runs_of_equal(shown.steps, lambda step: shown.lines[step.step])
    for number, group in enumerate(groups):
        values = shown.lines[group[0].step] / shown.unit.size
        edges = _Edges.of(tractions, group[0]) if tractions else _Edges()
        ax.plot(*edges.drawn(x, values), label=span(group), **style.line(number))
    ax.axhline(0.0, color="black", linewidth=0.5)
    ax.set_ylabel(shown.unit.labelled(shown.name))
    style.legend_beside(ax)


def _draw_stick(ax: Any, x: Field, surface: Surface, shown: Component) -> None:
    """A bar for every step above the axis of places, over those that stick at its end."""
    groups = runs_of_equal(shown.steps, lambda step: shown.lines[step.step])
    for number, group in enumerate(groups):
        sticking = surface.scalar(group[-1], "in_stick")
        if sticking is None:
            continue
        height = np.full(len(x), 0.02 + 0.03 * number)
        height[surface.along(sticking.astype(float)) <= 0.5] = np.nan
        colour = style.LINE_COLOURS[number]
        ax.plot(x, height, color=colour, linewidth=3.0, transform=ax.get_xaxis_transform())


def _draw_pressure(ax: Any, x: Field, result: Result, surface: Surface, units: Units) -> None:
    unit = units.of("pressure", max(step.peak_pressure for step in result.steps), "Pa")
    groups = runs_of_equal(selected(result.steps), lambda step: _pressure(step, surface))
    for number, group in enumerate(groups):
        pressure = surface.along(_pressure(group[0], surface)) / unit.size
        edges = _Edges.of(surface, group[0])
        ax.plot(*edges.drawn(x, pressure), label=span(group), **style.line(number))
    ax.set_ylim(bottom=0.0)
    ax.set_ylabel(unit.labelled("pressure p"))
    style.legend_beside(ax)


def _draw_bound(ax: Any, x: Field, result: Result, surface: Surface, shear: Component) -> None:
    """± µp in grey."""
    groups = runs_of_equal(shear.steps, lambda step: _pressure(step, surface))
    for number, group in enumerate(groups):
        limit = (result.scene.friction or FRICTIONLESS).limit(_pressure(group[0], surface))
        edges = _Edges.of(surface, group[0])
        at, bound = edges.drawn(x, surface.along(limit) / shear.unit.size)
        ax.fill_between(at, -bound, bound, color=style.GREY, alpha=0.12, linewidth=0)
        label = "± µp" if number == 0 else None
        ax.plot(at, bound, color=style.GREY, linewidth=0.8, label=label)
        ax.plot(at, -bound, color=style.GREY, linewidth=0.8)


@dataclass(frozen=True)
class _Edges:
    """Where tractions on rings end between two rings, as the square root of the distance from
    there: a straight line to the next ring would be a kink that nobody has computed.

    ends  of places on the line: the last with pressure, the next without, and how far from the
          last towards the next the edge is
    """

    ends: tuple[tuple[int, int, float], ...] = ()

    @classmethod
    def of(cls, surface: Surface, step: Increment) -> _Edges:
        """From the last two pressures of every end; none of cells, nor where it rises outwards."""
        if not isinstance(surface, Rings):
            return cls()
        p, r = surface.along(_pressure(step, surface)), np.abs(surface.line.places)
        found = []
        for last in np.flatnonzero(p > 0):
            for next_ in (last - 1, last + 1):
                before = 2 * last - next_
                if not (min(next_, before) >= 0 and max(next_, before) < len(p)) or p[next_] > 0:
                    continue
                if 0 < p[last] < p[before] and r[before] < r[last] < r[next_]:
                    # p² falls linearly in r², all the way in Hertz' contact.
                    share = p[last] ** 2 / (p[before] ** 2 - p[last] ** 2)
                    edge = np.sqrt(r[last] ** 2 + (r[last] ** 2 - r[before] ** 2) * share)
                    part = float((edge - r[last]) / (r[next_] - r[last]))
                    found.append((int(last), int(next_), min(1.0, part)))
        return cls(tuple(found))

    def drawn(self, x: Field, values: Field) -> tuple[Field, Field]:
        """Places and values of a traction with its edges between them, along the line."""
        more_x, more = [x], [values]
        down = np.linspace(1.0, 0.0, POINTS)[1:]
        for last, next_, part in self.ends:
            more_x.append(x[last] + (x[next_] - x[last]) * part * (1 - down**2))
            more.append(values[last] * down)
        at, found = np.concatenate(more_x), np.concatenate(more)
        order = np.argsort(at, kind="stable")
        return at[order], found[order]


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
