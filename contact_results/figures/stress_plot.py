"""Stress below a contact: sections, lines down the axis, and lines along the interfaces."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.tri import Triangulation
from numpy.typing import NDArray

from contact_results.directory.atomic_file import atomic_file
from contact_results.figures import style
from contact_results.stress.extremes import interface_sides
from contact_results.stress.points import StressField, StressPoints
from contact_results.stress.tables import sides
from contact_scene import Body
from contact_scene.engineering_units import EngineeringUnit, engineering_unit

SECTION, AXIS, INTERFACES = "stress_section.png", "stress_axis.png", "stress_interfaces.png"
MOST_INTERFACES = 4
# Quadrilaterals within a cell: of a nine-node element the quarters around its middle.
PARTS = {"quad": ((0, 1, 2, 3),), "quad9": ((0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3))}

Values = NDArray[np.float64]


def write_stress_figures(field: StressField, body: Body, directory: Path, title: str) -> None:
    """Write the figures of the section y = 0; without layers there is none of interfaces."""
    figures: dict[str, Callable[[StressField, Body, str], Figure]] = {
        SECTION: section_plot,
        AXIS: axis_plot,
    }
    if body.layers:
        figures[INTERFACES] = interface_plot
    with style.figure_style():
        for name, draw in figures.items():
            with atomic_file(directory / name) as path:
                style.save(draw(field, body, title), path)


def section_plot(field: StressField, body: Body, title: str) -> Figure:
    """Four stresses on the section, z downward, interfaces dashed; call within `figure_style`."""
    points = field.section
    panels = {
        "von Mises": points.von_mises,
        "σ_xx": points.components["xx"],
        "σ_xz": points.components["xz"],
        "tension (largest principal)": np.maximum(points.principal[0], 0.0),
    }
    reach, depth = field.shown
    length = engineering_unit(reach, "m")
    quarters = _quarters(points, reach, depth)
    left = max(-reach, float(points.x.min()))
    figure = _titled(9.0 if left < 0 else 6.4, 6.4, title)
    axes = figure.subplots(2, 2, sharex=True, sharey=True)
    for ax, (name, values) in zip(axes.flat, panels.items(), strict=True):
        _draw_section(figure, ax, points, quarters, values, name, length)
        _draw_interfaces(ax, body, depth, length)
        ax.set_aspect("equal")
        ax.set_xlim(left / length.size, reach / length.size)
        ax.set_ylim(depth / length.size, 0.0)
    for ax in axes[-1]:
        ax.set_xlabel(f"{field.label} ({length.name})")
    for ax in axes[:, 0]:
        ax.set_ylabel(f"depth z ({length.name})")
    return figure


def axis_plot(field: StressField, body: Body, title: str) -> Figure:
    """Stresses down the axis, one line per material; call within `figure_style`."""
    depth = field.shown[1]
    axis = field.axis.chosen(field.axis.depth <= depth)
    lines = {f"σ_{name}": axis.components[name] for name in ("xx", "yy", "zz", "xz")}
    lines["von Mises"] = axis.von_mises
    length = engineering_unit(depth, "m")
    unit = engineering_unit(float(max(np.abs(v).max() for v in lines.values())), "Pa")
    figure = _titled(5.2, 4.8, title)
    ax = figure.subplots()
    for number, (name, values) in enumerate(lines.items()):
        for material in np.unique(axis.material):
            inside = axis.material == material
            ax.plot(
                values[inside] / unit.size,
                axis.depth[inside] / length.size,
                label=name if material == axis.material[0] else None,
                **style.line(number),
            )
    _draw_interfaces(ax, body, depth, length)
    ax.axvline(0.0, color="black", linewidth=0.5)
    ax.set_ylim(depth / length.size, 0.0)
    ax.set_xlabel(f"stress on the z axis ({unit.name})")
    ax.set_ylabel(f"depth z ({length.name})")
    style.legend_beside(ax)
    return figure


def interface_plot(field: StressField, body: Body, title: str) -> Figure:
    """What an interface carries, and what jumps there; call within `figure_style`."""
    reach = field.shown[0]
    length = engineering_unit(reach, "m")
    shown = min(len(body.layers), MOST_INTERFACES)
    unit = engineering_unit(float(np.abs(field.section.stress).max()), "Pa")
    figure = _titled(9.6, 2.6 * shown + 0.5, title)
    axes = figure.subplots(shown, 2, sharex=True, squeeze=False)
    for number, side, points in sides(field, body):
        if number > shown:
            break
        carried, jumping = axes[number - 1]
        near = points.chosen(np.abs(points.x) <= reach)
        x, stress = near.x / length.size, near.components
        if side == "above":
            for n, name in enumerate(("zz", "xz")):
                label = f"σ_{name}"
                carried.plot(x, stress[name] / unit.size, label=label, **style.line(n))
        values = {"σ_xx": stress["xx"], "von Mises": near.von_mises}
        for n, (name, jump) in enumerate(values.items(), 2 * (side == "below")):
            jumping.plot(x, jump / unit.size, label=f"{name} {side}", **style.line(n))
        for ax in (carried, jumping):
            ax.set_title(f"interface {number}, z = {length.text(float(near.depth[0]))}")
    for ax in axes.flat:
        ax.axhline(0.0, color="black", linewidth=0.5)
        ax.set_ylabel(f"stress ({unit.name})")
        style.legend_beside(ax)
    for ax in axes[-1]:
        ax.set_xlabel(f"{field.label} ({length.name})")
    return figure


def _quarters(points: StressPoints, reach: float, depth: float) -> NDArray[np.int64]:
    """(n, 4) corners of what is at least partly in view."""
    assert points.cells is not None
    kind, cells = points.cells
    across, down = np.abs(points.x.ravel()), points.depth.ravel()
    near = (across[cells].min(axis=1) <= reach) & (down[cells].min(axis=1) <= depth)
    return cells[near][:, np.array(PARTS[kind])].reshape(-1, 4)


def _with_middles(values: Values, quarters: NDArray[np.int64]) -> Values:
    return np.concatenate([values.ravel(), values.ravel()[quarters].mean(axis=1)])


def _draw_section(
    figure: Figure,
    ax: Any,
    points: StressPoints,
    quarters: NDArray[np.int64],
    values: Values,
    name: str,
    length: EngineeringUnit,
) -> None:
    """Linear within the triangles between each side of a quadrilateral and its middle."""
    x, z, drawn = (_with_middles(part, quarters) for part in (points.x, points.depth, values))
    middles = np.arange(len(drawn) - len(quarters), len(drawn))
    around = np.stack([quarters, np.roll(quarters, 1, axis=1)], axis=-1)
    triangles = np.concatenate([np.column_stack([around[:, k], middles]) for k in range(4)])
    in_view = drawn[triangles]
    unit = engineering_unit(float(np.abs(in_view).max()), "Pa")
    limit = float(np.abs(in_view).max()) / unit.size or 1.0
    signed = bool(np.any(in_view < 0))
    image = ax.tripcolor(
        Triangulation(x / length.size, z / length.size, triangles),
        drawn / unit.size,
        shading="gouraud",
        cmap=style.SIGNED_MAP if signed else style.MAGNITUDE_MAP,
        vmin=-limit if signed else 0.0,
        vmax=limit,
    )
    figure.colorbar(image, ax=ax, label=f"{name} ({unit.name})")


def _draw_interfaces(ax: Any, body: Body, deepest: float, length: EngineeringUnit) -> None:
    for _, side, depth, _ in interface_sides(body):
        if side == "above" and depth < deepest:
            ax.axhline(depth / length.size, color=style.GREY, linewidth=0.7, linestyle="--")


def _titled(width: float, height: float, title: str) -> Figure:
    figure = style.new_figure(width, height)
    figure.suptitle(fill(title, int(13 * width)), fontsize=9.0)
    return figure
