"""Figures of the stress below a contact: section, depth profiles, surface profile."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from contact_results.directory.atomic_file import atomic_file
from contact_results.figures import style
from contact_results.figures.section_panel import draw_section, show_depths
from contact_results.stress.points import StressField, StressPoints
from contact_scene import Body
from contact_scene.reading.engineering_units import (
    EngineeringUnit,
    engineering_unit,
)

BAR = {"fraction": 0.05, "pad": 0.03}
SECTION, AXIS, SURFACE = "stress_section.png", "stress_axis.png", "stress_surface.png"


def write_stress_figures(
    field: StressField, body: Body, directory: Path, title: str
) -> Sequence[str]:
    """Write the three figures of the stress below a contact; return their file names.

    field      computed stress
    body       layers and base of the stressed body
    directory  output directory
    title      title of each figure
    """
    figures: dict[str, Callable[[StressField, Body, str], Figure]] = {
        SECTION: section_plot,
        AXIS: axis_plot,
        SURFACE: surface_plot,
    }
    with style.figure_style():
        for name, draw in figures.items():
            with atomic_file(directory / name) as path:
                dots = style.OF_SECTIONS if name == SECTION else style.DOTS_PER_INCH
                style.save(draw(field, body, title), path, dots)
    return list(figures)


def section_plot(field: StressField, body: Body, title: str) -> Figure:
    """Draw four stresses on the section, z downward, with dashed interfaces.

    The stresses are von Mises, σ_xx, σ_xz and the tensile stress. Call within `figure_style`.
    """
    points = field.section
    panels = {
        "von Mises": points.von_mises,
        _named("xx"): points.components["xx"],
        _named("xz"): points.components["xz"],
        "tensile stress (largest principal)": np.maximum(points.principal[0], 0.0),
    }
    half = float(points.x.min()) >= 0
    width = 6.4 if half else 9.0
    figure = _titled(width, 6.4, title)
    place = {"bottom": 0.08, "top": 0.92, "wspace": 0.2, "hspace": 0.1}
    place |= {"left": 0.7 / width, "right": 1 - 0.75 / width}  # labels of either side [inch]
    axes = figure.subplots(2, 2, sharex=True, sharey=True, gridspec_kw=place)
    for ax, (name, values) in zip(axes.flat, panels.items(), strict=True):
        length = draw_section(figure, ax, field, body, values, name, bar=BAR)
    for ax in axes[-1]:
        ax.set_xlabel(length.labelled(field.label))
    for ax in axes[:, 0]:
        ax.set_ylabel(length.labelled("depth z"))
    return figure


def axis_plot(field: StressField, body: Body, title: str) -> Figure:
    """Draw stresses over depth, on the z axis and below the trailing contact edge.

    The trailing edge is the edge with the larger σ_xx at the surface. There is one line per stress
    and material. Call within `figure_style`.
    """
    depth = field.shown[1]
    lines = {"on the z axis": field.axis, **_below_edge(field)}
    length = engineering_unit(depth, "m")
    figure = _titled(4.2 * len(lines) + 1.4, 4.8, title)
    place = {"left": 0.08, "right": 0.86, "bottom": 0.11, "top": 0.88, "wspace": 0.08}
    axes = figure.subplots(1, len(lines), sharey=True, squeeze=False, gridspec_kw=place)[0]
    for ax, (where, points) in zip(axes, lines.items(), strict=True):
        draw_depth(ax, points, body, depth, length)
        ax.set_title(where)
    axes[0].set_ylabel(length.labelled("depth z"))
    style.legend_beside(axes[-1])
    return figure


def surface_plot(field: StressField, body: Body, title: str) -> Figure:
    """Draw σ_xx and σ_yy along the surface. Call within `figure_style`."""
    figure = _titled(6.4, 3.4, title)
    place = {"left": 0.12, "right": 0.97, "bottom": 0.15, "top": 0.8}
    draw_surface(figure.subplots(gridspec_kw=place), field)
    return figure


def draw_surface(ax: Any, field: StressField) -> None:
    """Draw σ_xx and σ_yy at the surface z = 0, with dotted lines at the contact edges.

    The stress at a fitted contact edge is included.

    ax  axes of matplotlib
    """
    reach = field.shown[0]
    length = engineering_unit(reach, "m")
    surface, ends = _at_surface(field), _ends(field)
    parts = [surface.chosen(np.abs(surface.x) <= reach), *([ends] if ends else [])]
    x = np.concatenate([part.x for part in parts])
    order = np.argsort(x, kind="stable")
    lines = {
        _named(name): np.concatenate([part.components[name] for part in parts])[order]
        for name in ("xx", "yy")
    }
    unit = engineering_unit(float(max(np.abs(v).max() for v in lines.values())), "Pa")
    for number, (name, values) in enumerate(lines.items()):
        ax.plot(x[order] / length.size, values / unit.size, label=name, **style.line(number))
    ax.axhline(0.0, color="black", linewidth=0.5)
    for edge in _places_of_ends(field):
        if edge >= surface.x.min():
            ax.axvline(edge / length.size, color=style.GREY, linewidth=0.7, linestyle=":")
    dotted = "edge of the contact" if ends else "contact radius"
    ax.set_xlabel(f"{length.labelled(f'{field.label}, z = 0')}; dotted: {dotted}")
    ax.set_ylabel(unit.labelled("stress"))
    style.legend_above(ax)


def _ends(field: StressField) -> StressPoints | None:
    """Select the points at which the fitted contact edge crosses y = 0, sorted along x.

    Each crossing is represented by the fitted point nearest to y = 0. Returns None if no edge was
    fitted or if the fit does not determine the stress.
    """
    if field.edge is None or not field.edge.determined:
        return None
    points = field.edge.points
    spacing = np.diff(np.unique(_at_surface(field).x)).max()
    crossing = points.chosen(np.abs(points.y) < spacing)
    order = np.argsort(crossing.x, kind="stable")
    groups = np.split(order, np.flatnonzero(np.diff(crossing.x[order]) > spacing) + 1)
    nearest = [group[np.argmin(np.abs(crossing.y[group]))] for group in groups if len(group)]
    return crossing.chosen(np.array(nearest)) if nearest else None


def _places_of_ends(field: StressField) -> Sequence[float]:
    """Return the coordinates x of the contact edge at y = 0 [length].

    Without a fitted edge, these are ± the contact radius.
    """
    ends = _ends(field)
    if ends is None:
        return (-_radius(field), _radius(field))
    return tuple(float(x) for x in ends.x)


def _radius(field: StressField) -> float:
    """Return the contact radius; for finite elements that of the last loaded ring [length]."""
    return float(str(field.how.get("contact_radius", field.how.get("loaded_radius"))))


def _at_surface(field: StressField) -> StressPoints:
    """Select the points of the stress section at its smallest depth, sorted along x."""
    points = field.section
    at = np.flatnonzero(points.depth == points.depth.min())
    return points.chosen(at[np.argsort(points.x.flat[at], kind="stable")])


def _below_edge(field: StressField) -> dict[str, StressPoints]:
    """Select the points of the stress section below the trailing contact edge, sorted by depth.

    The trailing edge is the edge with the larger σ_xx at the surface. The result is a dictionary
    with one entry: the title of the panel, and the points.
    """
    surface, points = _at_surface(field), field.section
    ends = [int(np.argmin(np.abs(surface.x - x))) for x in _places_of_ends(field)]
    edge = float(surface.x[max(ends, key=lambda k: surface.components["xx"][k])])
    below = np.flatnonzero(np.abs(points.x - edge) <= 1e-9 * _radius(field))
    order = np.lexsort([points.material.flat[below], points.depth.flat[below]])
    where = f"below the edge, x = {engineering_unit(abs(edge), 'm').text(edge, 3)}"
    return {where: points.chosen(below[order])}


def draw_depth(
    ax: Any,
    points: StressPoints,
    body: Body,
    deepest: float,
    length: EngineeringUnit,
) -> None:
    """Draw stress components and the von Mises stress over depth, z downward.

    There is one line per stress and material.

    ax       axes of matplotlib
    points   points on a vertical line
    body     layers and base, for the interfaces
    deepest  largest depth of the figure [length]
    length   unit of the depth axis
    """
    line = points.chosen(points.depth <= deepest)
    lines = {_named(name): line.components[name] for name in ("xx", "yy", "zz", "xz")}
    lines["von Mises"] = line.von_mises
    unit = engineering_unit(float(max(np.abs(v).max() for v in lines.values())), "Pa")
    for number, (name, values) in enumerate(lines.items()):
        for material in np.unique(line.material):
            inside = line.material == material
            ax.plot(
                values[inside] / unit.size,
                line.depth[inside] / length.size,
                label=name if material == line.material[0] else None,
                **style.line(number),
            )
    ax.axvline(0.0, color="black", linewidth=0.5)
    ax.set_xlabel(unit.labelled("stress"))
    show_depths(ax, body, deepest, length)


def _named(component: str) -> str:
    """Return the label of a stress component, such as σ_xx, in the notation of matplotlib."""
    return f"$σ_{{{component}}}$"


def _titled(width: float, height: float, title: str) -> Figure:
    """Create a figure with a title that is wrapped to its width.

    width, height  size of the figure [inch]
    """
    figure = style.new_figure(width, height, arranged=False)
    figure.suptitle(fill(title, int(13 * width)), fontsize=9.0)
    return figure
