"""Panels with the surface seen from above, all with the same scales and cut to the contact."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from matplotlib.figure import FigureBase
from numpy.typing import NDArray
from scipy.ndimage import find_objects, label

from contact_results.figures.rings_above import RingsAbove
from contact_results.natural_sizes import SI, Units
from contact_results.surface import Cells
from contact_scene.engineering_units import EngineeringUnit

if TYPE_CHECKING:
    from contact_results.surface import Result

Above: TypeAlias = Cells | RingsAbove
Field = NDArray[np.float64]

PANEL = 2.4  # longer side in inches
NARROWEST = 1.0
COLUMNS = {1: 1, 2: 2, 4: 2}  # by number of panels; three of any other number
ARROWS = 13  # at most, along the longer side
SHORTEST = 0.03  # of the longest arrow; what is shorter is left out
MARGIN = 1.15  # of the contact's extent, so that its edge is seen against the outside


@dataclass(frozen=True)
class MapFrame:
    """What all panels of a figure share: the cells, the part that is shown, the unit of length."""

    cells: Above
    shown: tuple[float, float]
    unit: EngineeringUnit

    @classmethod
    def around_contact(cls, result: Result, cells: Above, units: Units = SI) -> MapFrame:
        """The frame that shows every cell that any step has in contact."""
        touching: list[Any] = [cells.scalar(step, "in_contact") for step in result.steps]
        touched = np.any(touching, axis=0)
        shown = (
            _half_extent(cells.x, touched.any(axis=1)),
            _half_extent(cells.y, touched.any(axis=0)),
        )
        return cls(cells, shown, units.of("length", max(shown), "m"))

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Outer edges of the cells, in the unit of the axes."""
        x, y = (_edge(centres) / self.unit.size for centres in (self.cells.x, self.cells.y))
        return -x, x, -y, y

    def figure_size(self, panels: int, blocks: int = 1) -> tuple[float, float]:
        """Sides in inches that give every panel its place, and a colour bar at the right.

        blocks  how many times the panels are repeated, one below the other
        """
        columns = COLUMNS.get(panels, 3)
        rows = math.ceil(panels / columns) * blocks
        width, height = (max(PANEL * side / max(self.shown), NARROWEST) for side in self.shown)
        return columns * (width + 0.2) + 1.3, rows * (height + 0.55) + 0.2


def _edge(centres: Field) -> float:
    """Of the window, half a cell beyond the last centre."""
    return float(centres[-1] + (centres[1] - centres[0]) / 2)


def _half_extent(centres: Field, touched: NDArray[np.bool_]) -> float:
    edge = _edge(centres)
    reach = np.max(np.abs(centres[touched]), initial=0.0) + edge - centres[-1]
    return float(min(MARGIN * reach, edge))


def map_axes(figure: FigureBase, frame: MapFrame, count: int) -> list[Any]:
    """`count` panels in rows, axes labelled at the left and at the bottom only."""
    columns = COLUMNS.get(count, 3)
    rows = math.ceil(count / columns)
    grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    panels = list(grid.flat)
    for spare in panels[count:]:
        spare.remove()
    for position, ax in enumerate(panels[:count]):
        ax.set_aspect("equal")
        ax.set_xlim(-frame.shown[0] / frame.unit.size, frame.shown[0] / frame.unit.size)
        ax.set_ylim(-frame.shown[1] / frame.unit.size, frame.shown[1] / frame.unit.size)
        if position % columns == 0:
            ax.set_ylabel(frame.unit.labelled("y"))
        if position + columns >= count:
            ax.set_xlabel(frame.unit.labelled("x"))
            ax.tick_params(labelbottom=True)
    return panels[:count]


def draw_cells(ax: Any, frame: MapFrame, values: NDArray[Any], **colours: Any) -> Any:
    """One coloured square per cell: the field as it was computed, not smoothed."""
    return ax.imshow(
        values.T, extent=frame.extent, origin="lower", interpolation="nearest", **colours
    )


def outline(ax: Any, frame: MapFrame, inside: NDArray[np.bool_], colour: str) -> None:
    """The border of a set of cells, if it has one."""
    if inside.any() and not inside.all():
        x, y = frame.cells.x / frame.unit.size, frame.cells.y / frame.unit.size
        ax.contour(x, y, inside.T.astype(float), levels=[0.5], colors=[colour], linewidths=0.8)


def draw_arrows(
    ax: Any, frame: MapFrame, vector: Field, inside: NDArray[np.bool_], colour: str = "white"
) -> None:
    """Arrows as long as a vector field (2, nx, ny) on some of the cells in a set, at their centres;
    the longest reaches to the next, or as far as its patch of the set is wide."""
    size = np.where(inside, np.hypot(*vector), 0.0)
    longest = float(size.max())
    if longest == 0.0:
        return
    x, y = (centres / frame.unit.size for centres in (frame.cells.x, frame.cells.y))
    apart = 2 * max(frame.shown) / frame.unit.size / ARROWS
    every_x, every_y = (max(1, round(apart / (c[1] - c[0]))) for c in (x, y))
    chosen = np.zeros(inside.shape, dtype=bool)
    chosen[len(x) // 2 % every_x :: every_x, len(y) // 2 % every_y :: every_y] = True
    i, j = np.nonzero(chosen & (size > SHORTEST * longest))
    scale = min([apart / longest, *_widths_over(size, inside, i, j, (x[1] - x[0], y[1] - y[0]))])
    u, v = vector[:, i, j] * scale
    edge = "black" if colour == "white" else "none"
    ax.quiver(
        x[i], y[j], u, v, angles="xy", scale_units="xy", scale=1.0, pivot="mid", color=colour,
        edgecolor=edge, linewidth=0.6, width=0.012, headwidth=3.5,
    )  # fmt: skip


def _widths_over(
    size: Field,
    inside: NDArray[np.bool_],
    i: NDArray[np.intp],
    j: NDArray[np.intp],
    cell: tuple[float, float],
) -> Iterator[float]:
    """Of every patch with arrows: its shorter side over the longest arrow in it."""
    patches, _ = label(inside, np.ones((3, 3)))
    slices = find_objects(patches)
    for patch in np.unique(patches[i, j]):
        spans = slices[patch - 1]
        shorter = min(
            (span.stop - span.start) * side for span, side in zip(spans, cell, strict=True)
        )
        yield shorter / float(size[i, j][patches[i, j] == patch].max())
