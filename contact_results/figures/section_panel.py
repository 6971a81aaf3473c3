"""Contour plot of a stress on the section y = 0, with the interfaces."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib import patheffects
from matplotlib.colors import Normalize
from matplotlib.figure import FigureBase
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation
from numpy.typing import NDArray

from contact_results.figures import style
from contact_results.stress.body_response import are_layers_thin
from contact_results.stress.points import StressField, StressPoints
from contact_results.stress.stress_maxima import interface_sides
from contact_scene.reading.engineering_units import (
    EngineeringUnit,
    engineering_unit,
)

# Quadrilaterals of a cell by its type; a nine-node element has four.
QUADRILATERALS = {
    "quad": ((0, 1, 2, 3),),
    "quad9": ((0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3)),
}
MAX_LEVELS = 12
# Share of the depth axis on which thin layers are drawn.
STRETCHED = 0.3
HALO = [patheffects.withStroke(linewidth=2.2, foreground="white")]

Values = NDArray[np.float64]


def draw_section(
    figure: FigureBase,
    ax: Any,
    field: StressField,
    values: Values,
    name: str,
    *,
    bar: Mapping[str, Any] | None = None,
) -> EngineeringUnit:
    """Draw contours of a stress on the section, z downward; return the unit of length.

    figure, ax  figure and axes of matplotlib
    field       stress below a contact, with the points of the section
    values      stress at the points of the section [force/length^2]
    name        label of the colour bar
    bar         arguments of `Figure.colorbar`
    """
    points, (reach, depth) = field.section, field.shown
    length = engineering_unit(reach, "m")
    triangles, drawn = _divide_into_triangles(points, values, length, reach, depth)
    in_view = drawn[triangles.triangles]
    unit = engineering_unit(float(np.abs(in_view).max()), "Pa")
    low, high = float(in_view.min()) / unit.size, float(in_view.max()) / unit.size
    levels = even_levels(low, high)
    most = float(np.abs(levels).max())
    signed = levels[0] < 0
    image = ax.tricontourf(
        triangles,
        np.clip(drawn / unit.size, levels[0], levels[-1]),
        levels=levels,
        cmap=style.SIGNED_MAP if signed else style.MAGNITUDE_MAP,
        norm=Normalize(-most if signed else 0.0, most),
    )
    ax.tricontour(
        triangles,
        drawn / unit.size,
        levels=levels,
        colors="black",
        linewidths=0.3,
        linestyles="solid",
    )
    label = unit.labelled(name)
    figure.colorbar(image, ax=ax, ticks=levels, label=label, format="%g", **(bar or {}))
    if not show_depths(ax, field, length):
        ax.set_aspect("equal")
    ax.set_xlim(max(-reach, float(points.x.min())) / length.size, reach / length.size)
    return length


def show_depths(ax: Any, field: StressField, length: EngineeringUnit) -> bool:
    """Draw a line at every interface, and scale the depth axis so that thin layers are visible.

    ax      axes of matplotlib
    field   stress below a contact, whose visible depth limits the figure
    length  unit of the depth axis

    Returns True if the depth axis stretches thin layers.
    """
    body, (_, deepest) = field.body, field.shown
    stretched = are_layers_thin(body, deepest)
    if stretched:
        films = sum(layer.thickness for layer in body.layers) / deepest
        depths, shown = np.array([0.0, films, 1.0]) * deepest / length.size, (0.0, STRETCHED, 1.0)
        ax.set_yscale(
            "function",
            functions=(
                lambda z: np.interp(z, depths, shown),
                lambda at: np.interp(at, shown, depths),
            ),
        )
        ticks = [0.0, *depths[1:2], *MaxNLocator(4).tick_values(*depths[1:])]
        ax.set_yticks([z for z in ticks if z in depths[:2] or depths[1] < z <= depths[2]])
        ax.yaxis.set_major_formatter(lambda z, _: f"{z:.2g}")
    ax.set_ylim(deepest / length.size, 0.0)
    for _, side, depth, _ in interface_sides(body):
        if side == "above" and depth < deepest:
            ax.axhline(
                depth / length.size,
                color="black",
                linewidth=1.0,
                linestyle="--",
                path_effects=HALO,
            )
    return stretched


def even_levels(low: float, high: float) -> Values:
    """Return evenly spaced round contour levels that enclose all values.

    low, high  smallest and largest value
    """
    if low == high:
        low, high = min(low, 0.0), max(high, 0.0) or 1.0
    rounded = MaxNLocator(MAX_LEVELS, steps=[1, 2, 2.5, 5, 10])
    return np.asarray(rounded.tick_values(low, high), dtype=float)


def _divide_into_triangles(
    points: StressPoints, values: Values, length: EngineeringUnit, reach: float, depth: float
) -> tuple[Triangulation, Values]:
    """Divide each visible quadrilateral of the section into four triangles around its centre.

    values        stress at the points of the section
    length        unit of the axes
    reach, depth  extent of the figure to the sides and in depth [length]

    Returns the triangles, and the stress at their nodes; a centre has the mean of its corners.
    """
    quads = _visible_quadrilaterals(points, reach, depth)
    x, z, drawn = (
        np.concatenate([part.ravel(), part.ravel()[quads].mean(axis=1)])
        for part in (points.x, points.depth, values)
    )
    middles = np.arange(len(drawn) - len(quads), len(drawn))
    around = np.stack([quads, np.roll(quads, 1, axis=1)], axis=-1)
    corners = np.concatenate([np.column_stack([around[:, k], middles]) for k in range(4)])
    return Triangulation(x / length.size, z / length.size, corners), drawn


def _visible_quadrilaterals(points: StressPoints, reach: float, depth: float) -> NDArray[np.int64]:
    """Return the corners (n, 4) of the quadrilaterals of all cells that are partly visible."""
    assert points.cells is not None
    kind, cells = points.cells
    across, down = np.abs(points.x.ravel()), points.depth.ravel()
    near = (across[cells].min(axis=1) <= reach) & (down[cells].min(axis=1) <= depth)
    return cells[near][:, np.array(QUADRILATERALS[kind])].reshape(-1, 4)
