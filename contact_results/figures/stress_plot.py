"""Figures of the stress below a contact: section, and profiles over depth and surface."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from contact_results.figures import style
from contact_results.figures.section_panel import draw_section, show_depths
from contact_results.stress.files import interface_points
from contact_results.stress.points import StressField, StressIncrement, StressPoints
from contact_scene.reading.engineering_units import engineering_unit, quantity

BAR = {"fraction": 0.05, "pad": 0.03}
SECTION = "stress_section.png"
LINES = "stress_lines.png"


def write_stress_figures(field: StressField, directory: Path, title: str) -> Sequence[str]:
    """Write the two figures of the stress below a contact; return their file names.

    field      computed stress
    directory  output directory
    title      title of each figure
    """
    with style.figure_style():
        for name, draw in ((SECTION, section_plot), (LINES, line_plot)):
            style.save(draw(field, title), directory / name, style.OF_SECTIONS)
    return SECTION, LINES


def section_plot(field: StressField, title: str) -> Figure:
    """Draw four stresses on the section, z downward, with dashed interfaces.

    The stresses are von Mises, σxx, σxz and the tensile stress. Call within `figure_style`.

    field  stress in one body
    title  title of the figure
    """
    points = field.section
    panels = {
        "von Mises": points.von_mises,
        "σxx": points.components["xx"],
        "σxz": points.components["xz"],
        "tensile stress (largest principal)": np.maximum(points.principal[0], 0.0),
    }
    half = float(points.x.min()) >= 0
    width = 6.4 if half else 9.0
    figure = _titled_figure(width, 6.4, title)
    place = {"bottom": 0.08, "top": 0.92, "wspace": 0.2, "hspace": 0.1}
    place |= {"left": 0.7 / width, "right": 1 - 0.75 / width}  # labels of either side [inch]
    axes = figure.subplots(2, 2, sharex=True, sharey=True, gridspec_kw=place)
    for ax, (name, values) in zip(axes.flat, panels.items(), strict=True):
        length = draw_section(figure, ax, field, values, name, bar=BAR)
    for ax in axes[-1]:
        ax.set_xlabel(length.labelled(field.label))
    for ax in axes[:, 0]:
        ax.set_ylabel(length.labelled("depth z"))
    return figure


def line_plot(field: StressField, title: str) -> Figure:
    """Draw stresses over depth on the z axis and below the trailing edge, and along the surface.

    The trailing edge is the edge with the larger σxx at the surface. A body with layers has a panel
    of its outermost interface as well. Call within `figure_style`.

    field  stress in one body
    title  title of the figure
    """
    rows, columns = (2, 2) if field.body.layers else (1, 3)
    figure = _titled_figure(3.7 * columns, 4.4 * rows, title)
    place = {"left": 0.2 / columns, "right": 1 - 0.1 / columns, "wspace": 0.25, "hspace": 0.28}
    place |= {"bottom": 0.12 / rows, "top": 1 - 0.16 / rows}
    axes = figure.subplots(rows, columns, gridspec_kw=place)
    axis, below, surface, *interface = axes.flat
    draw_depth(axis, field, field.axis, "on the axis")
    draw_depth(below, field, *_below_edge(field))
    draw_surface(surface, field)
    for ax in interface:
        draw_interface(ax, field)
    return figure


def draw_interface(ax: Any, field: StressField) -> None:
    """Draw stresses along the outermost interface: σxx on its sides, σzz and σxz, which are equal.

    ax     axes of matplotlib
    field  stress in one body with layers
    """
    reach = field.shown[0]
    length = engineering_unit(reach, "m")
    sides = {
        side: points.select(np.flatnonzero(np.abs(points.x) <= reach))
        for number, side, points in interface_points(field)
        if number == 1 and points.x.size
    }
    if not sides:  # files of finite elements end at a depth that a thick layer exceeds
        ax.set_axis_off()
        ax.set_title("The outermost interface is below the section.")
        return
    lines = {f"σxx {side}": (points, "xx") for side, points in sides.items()}
    lines |= {f"σ{name}": (sides["above"], name) for name in ("zz", "xz")}
    largest = max(np.abs(points.components[name]).max() for points, name in lines.values())
    unit = engineering_unit(float(largest), "Pa")
    for number, (label, (points, name)) in enumerate(lines.items()):
        values = points.components[name] / unit.size
        ax.plot(points.x / length.size, values, label=label, **style.line_style(number))
    ax.axhline(0.0, color="black", linewidth=0.5)
    depth = quantity(float(sides["above"].depth.flat[0]), "m", 3)
    ax.set_xlabel(f"{length.labelled(field.label)} on the interface z = {depth}")
    ax.set_ylabel(unit.labelled("stress"))
    style.legend_above(ax)


def draw_surface(ax: Any, field: StressField) -> None:
    """Draw σxx and σyy at the smallest depth, with dotted lines at the contact edges.

    The stress at a fitted contact edge is included. If no contact edge was fitted, the dotted lines
    are at the contact radius.

    ax     axes of matplotlib
    field  stress in one body
    """
    reach = field.shown[0]
    length = engineering_unit(reach, "m")
    surface, ends = _shallowest_points(field), _edge_crossings(field)
    parts = [surface.select(np.abs(surface.x) <= reach), *([ends] if ends else [])]
    x = np.concatenate([part.x for part in parts])
    order = np.argsort(x, kind="stable")
    lines = {
        f"σ{name}": np.concatenate([part.components[name] for part in parts])[order]
        for name in ("xx", "yy")
    }
    unit = engineering_unit(float(max(np.abs(v).max() for v in lines.values())), "Pa")
    for number, (name, values) in enumerate(lines.items()):
        ax.plot(x[order] / length.size, values / unit.size, label=name, **style.line_style(number))
    ax.axhline(0.0, color="black", linewidth=0.5)
    for edge in _edge_positions(field):
        if edge >= surface.x.min():
            ax.axvline(edge / length.size, color=style.GREY, linewidth=0.7, linestyle=":")
    depth = float(surface.depth[0])
    place = f"{field.label}, z = {quantity(depth, 'm', 3) if depth else 0}"
    ax.set_xlabel(f"{length.labelled(place)}; dotted: edge of the contact")
    ax.set_ylabel(unit.labelled("stress"))
    style.legend_above(ax)


def _edge_crossings(field: StressField) -> StressPoints | None:
    """Select the points at which the fitted contact edge crosses y = 0, sorted along x.

    Each crossing is represented by the fitted point nearest to y = 0. Returns None if no edge was
    fitted or if the fit does not determine the stress.
    """
    if field.edge is None or not field.edge.determined:
        return None
    points = field.edge.points
    spacing = np.diff(np.unique(_shallowest_points(field).x)).max()
    crossing = points.select(np.abs(points.y) < spacing)
    order = np.argsort(crossing.x, kind="stable")
    groups = np.split(order, np.flatnonzero(np.diff(crossing.x[order]) > spacing) + 1)
    nearest = [group[np.argmin(np.abs(crossing.y[group]))] for group in groups if len(group)]
    return crossing.select(np.array(nearest)) if nearest else None


def _edge_positions(field: StressField) -> Sequence[float]:
    """Return the fitted contact edge at y = 0, or else ± the contact radius [length]."""
    ends = _edge_crossings(field)
    if ends is None:
        return (-_contact_radius(field), _contact_radius(field))
    return tuple(float(x) for x in ends.x)


def _contact_radius(field: StressField) -> float:
    """Return the contact radius; for finite elements that of the last loaded ring [length]."""
    return float(str(field.how.get("contact_radius", field.how.get("loaded_radius"))))


def _shallowest_points(field: StressField) -> StressPoints:
    points = field.section
    at = np.flatnonzero(points.depth == points.depth.min())
    return points.select(at[np.argsort(points.x.flat[at], kind="stable")])


def _below_edge(field: StressField) -> tuple[StressPoints, str]:
    """Select the points of the stress section below the trailing contact edge, sorted by depth.

    The trailing edge is the edge with the larger σxx at the surface.

    Returns the points, and their place in words.
    """
    surface, points = _shallowest_points(field), field.section
    ends = [int(np.argmin(np.abs(surface.x - x))) for x in _edge_positions(field)]
    edge = float(surface.x[max(ends, key=lambda k: surface.components["xx"][k])])
    below = np.flatnonzero(np.abs(points.x - edge) <= 1e-9 * _contact_radius(field))
    order = np.lexsort([points.material.flat[below], points.depth.flat[below]])
    return points.select(below[order]), f"below the edge x = {quantity(edge, 'm', 3)}"


def draw_depth(ax: Any, field: StressField, points: StressPoints, where: str) -> None:
    """Draw stress components and the von Mises stress over depth, z downward.

    There is one line per stress and material.

    ax      axes of matplotlib
    field   stress below a contact, whose visible depth limits the figure
    points  points on a vertical line
    where   place of this line in words
    """
    deepest = field.shown[1]
    length = engineering_unit(deepest, "m")
    line = points.select(points.depth <= deepest)
    lines = {f"σ{name}": line.components[name] for name in ("xx", "yy", "zz", "xz")}
    lines["von Mises"] = line.von_mises
    unit = engineering_unit(float(max(np.abs(v).max() for v in lines.values())), "Pa")
    for number, (name, values) in enumerate(lines.items()):
        for material in np.unique(line.material):
            inside = line.material == material
            ax.plot(
                values[inside] / unit.size,
                line.depth[inside] / length.size,
                label=name if material == line.material[0] else None,
                **style.line_style(number),
            )
    ax.axvline(0.0, color="black", linewidth=0.5)
    ax.set_xlabel(unit.labelled("stress"))
    ax.set_ylabel(length.labelled(f"depth z {where}"))
    show_depths(ax, field, length)
    style.legend_above(ax)


def _titled_figure(width: float, height: float, title: str) -> Figure:
    figure = style.new_figure(width, height, arranged=False)
    figure.suptitle(fill(title, int(13 * width)), fontsize=9.0, parse_math=False)
    return figure


def write_history_figure(
    history: Sequence[StressIncrement], layers: int, path: Path, title: str
) -> None:
    """Draw the stress at chosen points over the increments, with one panel per point.

    layers  number of layers of the body
    path    path of the image file
    """
    count = len(history[0].errors)
    with style.figure_style():
        figure = style.new_figure(6.4, 0.5 + 2.6 * count)
        figure.suptitle(title, fontsize=style.STYLE["axes.titlesize"], parse_math=False)
        axes = figure.subplots(count, sharex=True, squeeze=False)[:, 0]
        for n, ax in enumerate(axes):
            _draw_point(ax, history, n, layers)
        axes[-1].set_xlabel("increment; dotted: ends of load steps")
        style.save(figure, path)


def _draw_point(ax: Any, history: Sequence[StressIncrement], n: int, layers: int) -> None:
    """Draw σxx, σzz, σxz and the largest principal stress of one point over the increments.

    The stated errors are drawn as error bars. Dotted lines mark the ends of load steps.

    ax      axes of matplotlib
    n       index of the point
    layers  number of layers of the body
    """
    values = {
        f"σ{name}": [each.points.components[name][n] for each in history]
        for name in ("xx", "zz", "xz")
    }
    values["σ₁"] = [each.points.principal[0][n] for each in history]
    errors = np.array([each.errors[n] for each in history])
    unit = engineering_unit(float(np.max(np.abs(list(values.values())))), "Pa")
    numbers = np.arange(1, len(history) + 1)
    for number, (label, stress) in enumerate(values.items()):
        bars, y = errors / unit.size, np.array(stress) / unit.size
        ax.errorbar(numbers, y, bars, label=label, linewidth=1.2, **style.line_style(number))
    for k in np.flatnonzero(np.diff([each.step for each in history])):
        ax.axvline(k + 1, color=style.GREY, linewidth=0.7, linestyle=":")
    point = history[0].points
    place = (quantity(float(field[n]), "m") for field in (point.x, point.y, point.depth))
    ax.set_title(f"x, y, depth = {', '.join(place)}, {point.material_name(n, layers)}")
    ax.set_ylabel(unit.labelled("stress"))
    ax.xaxis.set_major_locator(MaxNLocator(integer=True))
    style.legend_beside(ax)
