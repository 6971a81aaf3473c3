"""Overview figure of a run at the end of its history, in six panels."""

from __future__ import annotations

from collections.abc import Iterable
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import AutoLocator, MaxNLocator
from matplotlib.transforms import offset_copy

from contact_results.figures import style
from contact_results.figures.load_plot import draw_loading, draw_loop, load_loop
from contact_results.figures.map_panels import MapFrame
from contact_results.figures.maps import draw_panel, draw_zones, zone_patches
from contact_results.figures.profile_plot import draw_end, draw_slip
from contact_results.figures.section_panel import draw_section
from contact_results.figures.stress_plot import draw_depth, draw_surface
from contact_results.key_numbers import key_numbers
from contact_results.result_report import ResultReport
from contact_results.stress.below_contact import body_response
from contact_results.stress.loaded_bodies import loaded_bodies
from contact_results.surface import Cells
from contact_scene.reading.engineering_units import (
    engineering_unit,
    quantity,
)

if TYPE_CHECKING:
    from contact_results.stress.points import StressField

LEAST_MOVES = 3  # smallest number of increments with tangential load for a loop
DOTS_PER_INCH = 90
# Sides of a panel, and of its place with labels, legend and colour bar [inch].
PANEL = (2.6, 2.55)
PLACE = (3.85, 3.45)
MARGIN = 0.65
TITLE = 0.4  # height of a title of two lines above the panels [inch]
TITLE_TOP = 0.08  # space above the title [inch]
# Places of the labels of both axes in sides of a panel, and their distances from it [point].
LABELS = ((0.5, 0.0), (0.0, 0.5))
LABEL_SHIFTS = ((0.0, -19.0), (-30.0, 0.0))
# Largest number of intervals between ticks.
MAX_INTERVALS = 5
MAX_LETTERS = 44  # of a line of key numbers: to the edge of the picture
LEAST_SHARE = 0.3  # of a panel's side, below which an axis of equal scales has two ticks
BAR: dict[str, Any] = {"fraction": 0.05, "pad": 0.03}


def overview(report: ResultReport, frame: MapFrame | None) -> Figure:
    """Draw the overview: profile, zones, history, stress on section and surface, key numbers.

    A result with a single increment has the stress on the z axis instead of a history. The stress
    is omitted without contact, for a rigid body, and if it would take too long. Call within
    `figure_style`.

    frame  frame of the map; None for a line contact
    """
    state = loaded_bodies(report.result, report.surface, report.steps[-1])
    field = None
    if state is not None and state.body.deforms:
        field = body_response(state).drawn_stress()
    columns = 3 if field else 2
    width, height = columns * PLACE[0], 2 * PLACE[1] + TITLE
    figure = style.new_figure(width, height, arranged=False)
    title = report.scene.title or "Contact"
    figure.suptitle(
        fill(f"{title}: end of step {report.steps[-1].step}", 120 if field else 80),
        fontsize=9.0,
        parse_math=False,
        y=1.0 - TITLE_TOP / height,
    )
    profile, zones, history, *stressed, numbers = (
        figure.add_axes(
            (
                (column * PLACE[0] + MARGIN) / width,
                ((1 - row) * PLACE[1] + MARGIN - 0.15) / height,
                PANEL[0] / width,
                PANEL[1] / height,
            )
        )
        for row in (0, 1)
        for column in range(columns)
    )
    draw_end(profile, report)
    if frame is None:
        draw_slip(zones, report)
    else:
        _draw_surface_map(figure, zones, report, frame)
    loop = load_loop(report.increments)
    if loop is not None and np.count_nonzero(loop.forces) >= LEAST_MOVES:
        draw_loop(history, loop)
    elif field and len(report.increments) == 1:
        draw_depth(history, field, field.axis, "on the axis")
    else:
        draw_loading(history, report.increments)
    if field:
        section, surface = stressed
        _draw_stress(figure, section, surface, report, field)
    _write_numbers(numbers, report)
    _place_labels(figure, (profile, zones, history, *stressed))
    return figure


def _draw_surface_map(figure: Figure, ax: Any, report: ResultReport, frame: MapFrame) -> None:
    """Draw the map of the overview: stick and slip zones, or the pressure without friction.

    ax  axes of matplotlib
    """
    end = report.steps[-1]
    frame.show(ax)
    ax.set_xlabel(frame.unit.labelled("x"))
    ax.set_ylabel(frame.unit.labelled("y"))
    if end.in_stick is not None:
        draw_zones(ax, frame, report, end)
        style.legend_above(ax, handles=zone_patches())
        ax.set_xlabel(frame.unit.labelled("x") + "; arrows: slip in the last increment")
        return
    pressure = frame.cells.scalar(end, "pressure")
    assert pressure is not None
    unit = engineering_unit(float(np.max(pressure)), "Pa")
    seen = np.where(pressure > 0, pressure / unit.size, np.nan)
    image = draw_panel(ax, frame, "", seen, float(np.max(pressure)) / unit.size or 1.0)
    figure.colorbar(image, ax=ax, label=unit.labelled("pressure p"), **BAR)


def _draw_stress(
    figure: Figure, axes: Any, along: Any, report: ResultReport, field: StressField
) -> None:
    """Draw the von Mises stress on the section, and the stress along the surface, for the overview.

    A note states if the contact edge was not fitted on cells.

    axes, along  axes of matplotlib for the section and for the surface
    """
    mises = field.section.von_mises
    length = draw_section(figure, axes, field, mises, "von Mises", bar=BAR)
    axes.set_xlabel(length.labelled(field.label))
    axes.set_ylabel(length.labelled("depth z"))
    draw_surface(along, field)
    if (field.edge is None or not field.edge.determined) and isinstance(report.surface, Cells):
        cell = float(np.diff(field.section.x.ravel()[:2])[0])
        along.text(
            0.5,
            0.02,
            f"by cells of {quantity(cell, 'm', 3)}:\ntoo low beside the edges",
            ha="center",
            fontsize="small",
            transform=along.transAxes,
        )


def _place_labels(figure: Figure, panels: Iterable[Any]) -> None:
    """Place axis labels at fixed distances, and limit the ticks.
    The second layout by which matplotlib places labels takes a sixth of the drawing time."""
    for ax in panels:
        for axis, place, shift in zip((ax.xaxis, ax.yaxis), LABELS, LABEL_SHIFTS, strict=True):
            axis.set_label_coords(*place, offset_copy(ax.transAxes, figure, *shift, "points"))
            if isinstance(axis.get_major_locator(), AutoLocator):
                axis.set_major_locator(MaxNLocator(MAX_INTERVALS, steps=[1, 2, 5, 10]))
                if _drawn_share(ax, axis) < LEAST_SHARE:
                    low, high = sorted(axis.get_view_interval())
                    first, *_, last = (t for t in axis.get_majorticklocs() if low <= t <= high)
                    axis.set_ticks((first, last))


def _drawn_share(ax: Any, axis: Any) -> float:
    """Return the share of its side of a panel that an axis takes, below 1 with equal scales."""
    if ax.get_aspect() == "auto":
        return 1.0
    high = float(ax.get_data_ratio())
    return min(1.0, 1.0 / high if axis is ax.xaxis else high)


def _write_numbers(ax: Any, report: ResultReport) -> None:
    ax.set_axis_off()
    lines = [f"status: {report.steps[-1].status.value}"]
    lines += [f"{name}: {text}" for name, text in key_numbers(report.steps, report.end_errors)]
    lines += [] if report.end_errors else ["errors not stated"]
    text = "\n".join(fill(line, MAX_LETTERS, subsequent_indent="    ") for line in lines)
    ax.text(0.0, 1.1, text, va="top", linespacing=1.35, parse_math=False)
