"""Profiles of pressure and shear on the line through the z axis."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from contact_results.figures import style
from contact_results.figures.shown_steps import SAME, select_steps
from contact_results.result_report import ResultReport
from contact_results.surface import Cells
from contact_scene.friction import FRICTIONLESS, CoulombFriction
from contact_scene.reading.engineering_units import (
    EngineeringUnit,
    engineering_unit,
)

if TYPE_CHECKING:
    from contact_results.surface import Increment, Surface
    from contact_scene.array_types import Field

MARGIN = 1.15  # half length of the line, relative to the extent of the contact


class Curves(NamedTuple):
    """Curves of one traction component along the line of the profiles, one per load step.

    name   label of the axis
    lines  values (n,) by load step [force/length^2]
    unit   unit of the axis
    """

    name: str
    lines: dict[int, Field]
    unit: EngineeringUnit


def profile_plot(report: ResultReport) -> Figure:
    """Draw profiles of pressure and shear at the ends of load steps, one panel per component.

    The panels of shear show the friction limit ± µp at the end of the history. Components that are
    zero have no panel.
    """
    steps, surface = select_steps(report.steps), report.surface
    shears = _shear_curves(surface, steps)
    figure = style.new_figure(6.0, 3.2 + 2.4 * len(shears))
    axes = figure.subplots(1 + len(shears), 1, sharex=True, squeeze=False)[:, 0]
    length = _line_axis(axes[-1], report)
    x = surface.profile_line.places / length.size
    limit = _friction_limit(report.scene.friction or FRICTIONLESS, steps[-1], surface)
    for ax, curves in zip(axes, (_pressure_curves(surface, steps), *shears), strict=True):
        if ax is not axes[0]:
            bound = surface.along(limit) / curves.unit.size
            band = {"color": style.GREY, "alpha": 0.2, "linewidth": 0, "label": "± µp"}
            ax.fill_between(x, -bound, bound, **band)
        for number, (step, values) in enumerate(curves.lines.items()):
            ax.plot(x, values / curves.unit.size, label=f"step {step}", **style.line_style(number))
        ax.axhline(0.0, color="black", linewidth=0.5)
        ax.set_ylabel(curves.unit.labelled(curves.name))
        style.legend_beside(ax)
    axes[0].set_ylim(bottom=0.0)
    return figure


def _friction_limit(friction: CoulombFriction, end: Increment, surface: Surface) -> Field:
    """Compute the friction limit µp on the surface at the end of a load step [force/length^2]."""
    p = _pressure_field(end, surface)
    if isinstance(surface, Cells):
        if surface.of_strips:  # without a map
            return friction.limit(p)
        x, y = surface.x, surface.y
        return friction.on_grid(p.shape, (float(x[1] - x[0]), float(y[1] - y[0]))).limit(p)
    return friction.at_radii(surface.radii.reshape(-1, *(1,) * (p.ndim - 1))).limit(p)


def draw_end(ax: Any, report: ResultReport) -> None:
    """Draw pressure p and shear over coefficient of friction, q/µ, at the end of the history.

    The curves coincide in the slip zone. The shear is omitted if the coefficient of friction varies
    on the surface.

    ax  axes of matplotlib
    """
    length, end, surface = _line_axis(ax, report), report.steps[-1], report.surface
    x, pressure = surface.profile_line.places / length.size, _pressure_curves(surface, [end])
    unit = pressure.unit
    ax.plot(x, pressure.lines[end.step] / unit.size, label=pressure.name, **style.line_style(0))
    friction = report.scene.friction
    coefficient = friction.uniform if friction is not None else None
    if coefficient:
        for number, shear in enumerate(_shear_curves(surface, [end]), 1):
            scaled = shear.lines[end.step] / (coefficient * unit.size)
            name = f"{shear.name.removeprefix('shear ')}/µ"
            ax.plot(x, scaled, label=name, **style.line_style(number))
    ax.axhline(0.0, color="black", linewidth=0.5)
    ax.set_ylabel(unit.labelled("traction"))
    style.legend_above(ax)


def draw_slip(ax: Any, report: ResultReport) -> None:
    """Draw the slip of the surfaces since the start at the ends of load steps, or else the gap.

    ax  axes of matplotlib
    """
    length, end, surface = _line_axis(ax, report), report.steps[-1], report.surface
    gap = surface.scalar(end, "gap")
    assert gap is not None
    outside = np.where(_pressure_field(end, surface) > 0, 0.0, gap)
    unit = engineering_unit(float(np.max(outside)), "m")
    slips = _vector_curves(surface, select_steps(report.steps), "slip", "slip s", "m")
    curves, *_ = *slips, Curves("gap", {end.step: surface.along(outside)}, unit)
    x = surface.profile_line.places / length.size
    for number, (step, values) in enumerate(curves.lines.items()):
        ax.plot(x, values / curves.unit.size, label=f"step {step}", **style.line_style(number))
    ax.axhline(0.0, color="black", linewidth=0.5)
    ax.set_ylabel(curves.unit.labelled(curves.name))
    style.legend_above(ax)


def _pressure_curves(surface: Surface, steps: Sequence[Increment]) -> Curves:
    lines = {step.step: surface.along(_pressure_field(step, surface)) for step in steps}
    unit = engineering_unit(max(step.peak_pressure for step in steps), "Pa")
    return Curves("pressure p", lines, unit)


def _shear_curves(surface: Surface, steps: Sequence[Increment]) -> list[Curves]:
    return _vector_curves(surface, steps, "shear", "shear q", "Pa")


def _vector_curves(
    surface: Surface, steps: Sequence[Increment], name: str, label: str, unit: str
) -> list[Curves]:
    """Return the components of shear or slip along and across the line that exceed round-off."""
    found = ((step.step, surface.vector(step, name)) for step in steps)
    lines = {step: surface.vector_along(vector) for step, vector in found if vector is not None}
    sizes = [np.max(np.abs(vector), axis=1) for vector in lines.values()]
    largest = np.max([(0.0, 0.0), *sizes], axis=0).tolist()
    return [
        Curves(
            f"{label}{surface.profile_line.components[k]}",
            {step: vector[k] for step, vector in lines.items()},
            engineering_unit(largest[k], unit),
        )
        for k in (0, 1)
        if largest[k] > SAME * max(largest)
    ]


def _line_axis(ax: Any, report: ResultReport) -> EngineeringUnit:
    """Label the axis along the line of the profiles and limit it to the contact.

    ax  axes of matplotlib

    Returns the unit of length of this axis.
    """
    surface = report.surface
    places = surface.profile_line.places
    touched = [surface.along(_pressure_field(step, surface)) > 0 for step in report.steps]
    inside = np.flatnonzero(np.any(touched, axis=0))
    ends = [max(inside[0] - 1, 0), min(inside[-1] + 1, len(places) - 1)]
    reach = float(min(MARGIN * np.max(np.abs(places[ends])), np.max(places)))
    length = engineering_unit(reach, "m")
    ax.set_xlabel(length.labelled(surface.profile_line.label))
    ax.set_xlim(-reach / length.size if places[0] < 0 else 0.0, reach / length.size)
    return length


def _pressure_field(step: Increment, surface: Surface) -> Field:
    pressure = surface.scalar(step, "pressure")
    assert pressure is not None
    return pressure
