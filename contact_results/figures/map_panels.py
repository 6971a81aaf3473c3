"""Panels of maps of the surface, with equal scales and limits around the contact."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from matplotlib.figure import FigureBase
from numpy.typing import NDArray

from contact_results.result_report import ResultReport
from contact_results.surface import Cells, Rings
from contact_scene.array_types import Field
from contact_scene.reading.engineering_units import (
    EngineeringUnit,
    engineering_unit,
)

if TYPE_CHECKING:
    from contact_results.surface import Increment

Above: TypeAlias = "Cells | RingsAbove"

PANEL = 2.4  # longer side of a panel [inch]
NARROWEST = 1.0  # shorter side of a panel [inch]
COLUMNS = {1: 1, 2: 2, 4: 2}  # columns by number of panels; three for other numbers
ARROWS = 13  # largest number of arrows along the longer side
SHORTEST = 0.03  # shortest arrow, relative to the longest
MARGIN = 1.15  # half side of a map, relative to the extent of the contact


RINGS_ACROSS = 121  # cells along a side; odd, so that the axis is a cell centre
RINGS_MARGIN = 1.3  # half side of the cells, relative to the largest contact radius
# Value between 0 (false) and 1 (true) above which a cell counts as true. Cells may lie in the
# middle between two rings, where round-off must not decide.
HALF = 0.5 + 1e-9


@dataclass(frozen=True, eq=False)
class RingsAbove:
    """Surface grid of cells for maps, on which fields of rings are sampled.

    The fields are linear between rings and angles.

    rings  surface grid of the result
    x, y   coordinates of the cell centres (n,) [length]
    """

    rings: Rings
    x: Field
    y: Field

    @classmethod
    def around_contact(cls, steps: Sequence[Increment], rings: Rings) -> RingsAbove:
        """Create cells that cover the largest contact at the end of any load step.

        steps  last increment of each load step
        rings  surface grid of the result
        """
        touched = [_rings_with_contact(rings.scalar(step, "in_contact")) for step in steps]
        reach = RINGS_MARGIN * float(rings.radii[np.any(touched, axis=0)].max())
        centres = np.linspace(-reach, reach, RINGS_ACROSS)
        return cls(rings, centres, centres)

    def scalar(self, step: Increment, name: str) -> NDArray[Any] | None:
        """Sample a scalar field of an increment at the cell centres (nx, ny).

        Returns None if the increment has no such field.

        step  increment of the result
        name  name of the field, an attribute of the increment
        """
        rings, fields = self.rings.full_circle(step)
        field = rings.scalar(fields, name)
        if field is None:
            return None
        sampled = self._interpolate_rings(rings, field.astype(float))
        return sampled > HALF if field.dtype == bool else sampled

    def vector(self, step: Increment, name: str) -> Field | None:
        """Sample the x and y components of shear or slip at the cell centres (2, nx, ny).

        Returns None if the increment has no such vector.

        step  increment of the result
        name  "shear" or "slip"
        """
        rings, fields = self.rings.full_circle(step)
        components = rings.components(fields, name)
        if components is None:
            return None
        sampled = (self._interpolate_rings(rings, part) for part in components)
        return rings.in_scene_axes(sampled, self._polar_coordinates()[1])

    def _polar_coordinates(self) -> tuple[Field, Field]:
        x, y = np.meshgrid(self.x, self.y, indexing="ij")
        cos, sin = self.rings.direction
        angle = np.arctan2(cos * y - sin * x, cos * x + sin * y)
        return np.hypot(x, y), angle % (2 * np.pi)

    def _interpolate_rings(self, rings: Rings, field: Field) -> Field:
        """Interpolate a field of the rings at the cell centres (nx, ny).

        rings  rings with angles over the full circle
        field  values (rings, angles)
        """
        from scipy.ndimage import map_coordinates

        radius, angle = self._polar_coordinates()
        assert rings.angles is not None
        # Repeat the first ray at angle 2π.
        field = np.concatenate([field, field[:, :1]], axis=1)
        rays = np.append(rings.angles, 2 * np.pi)
        at = [
            np.interp(radius, rings.radii, np.arange(len(rings.radii))),
            np.interp(angle, rays, np.arange(len(rays))),
        ]
        return np.asarray(map_coordinates(field, at, order=1))


def _rings_with_contact(field: NDArray[Any] | None) -> NDArray[np.bool_]:
    assert field is not None
    return np.asarray(field.any(axis=tuple(range(1, field.ndim))))


@dataclass(frozen=True)
class MapFrame:
    """Common properties of the maps in one figure: cells, limits, unit of length.

    cells  surface grid of the maps
    shown  half sides of the visible rectangle along x and y [length]
    unit   unit of length of the axes
    """

    cells: Above
    shown: tuple[float, float]
    unit: EngineeringUnit

    @classmethod
    def around_contact(cls, report: ResultReport) -> MapFrame | None:
        """Create the frame of maps that show all cells in contact at the end of any load step.

        Fields on rings are sampled on cells. A line contact has no maps and no frame.
        """
        steps, surface = report.steps, report.surface
        cells: Above
        if surface.of_strips:
            return None
        if isinstance(surface, Rings):
            cells = RingsAbove.around_contact(steps, surface)
        else:
            cells = surface
        touching: list[Any] = [cells.scalar(step, "in_contact") for step in steps]
        touched = np.any(touching, axis=0)
        shown = (
            _half_extent(cells.x, touched.any(axis=1)),
            _half_extent(cells.y, touched.any(axis=0)),
        )
        return cls(cells, shown, engineering_unit(max(shown), "m"))

    def show(self, ax: Any) -> None:
        """Set the limits of the axes of a map, with equal scales of x and y.

        ax  axes of matplotlib
        """
        x, y = (half / self.unit.size for half in self.shown)
        ax.set_aspect("equal")
        ax.set_xlim(-x, x)
        ax.set_ylim(-y, y)

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Outer boundaries of the cells (left, right, bottom, top), in the unit of the axes."""
        x, y = (
            _window_boundary(centres) / self.unit.size for centres in (self.cells.x, self.cells.y)
        )
        return -x, x, -y, y

    def figure_size(self, panels: int) -> tuple[float, float]:
        """Return width and height of a figure with a number of maps and a colour bar [inch].

        panels  number of maps
        """
        columns = COLUMNS.get(panels, 3)
        rows = math.ceil(panels / columns)
        width, height = (max(PANEL * side / max(self.shown), NARROWEST) for side in self.shown)
        return columns * (width + 0.2) + 1.3, rows * (height + 0.55) + 0.2


def _window_boundary(centres: Field) -> float:
    """Return the window boundary, half a cell beyond the last of the centres (n,) [length]."""
    return float(centres[-1] + (centres[1] - centres[0]) / 2)


def _half_extent(centres: Field, touched: NDArray[np.bool_]) -> float:
    edge = _window_boundary(centres)
    reach = np.max(np.abs(centres[touched]), initial=0.0) + edge - centres[-1]
    return float(min(MARGIN * reach, edge))


def map_axes(figure: FigureBase, frame: MapFrame, count: int) -> list[Any]:
    """Create axes of matplotlib for maps in rows, with labels at the left and at the bottom only.

    frame  cells, limits and unit of length
    count  number of maps
    """
    columns = COLUMNS.get(count, 3)
    rows = math.ceil(count / columns)
    grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    panels = list(grid.flat)
    for spare in panels[count:]:
        spare.remove()
    for position, ax in enumerate(panels[:count]):
        frame.show(ax)
        if position % columns == 0:
            ax.set_ylabel(frame.unit.labelled("y"))
        if position + columns >= count:
            ax.set_xlabel(frame.unit.labelled("x"))
            ax.tick_params(labelbottom=True)
    return panels[:count]


def draw_cells(ax: Any, frame: MapFrame, values: NDArray[Any], **colours: Any) -> Any:
    """Draw the values of the cells, one coloured rectangle per cell.

    ax       axes of matplotlib
    frame    cells, limits and unit of length
    values   values of the cells (nx, ny)
    colours  arguments of `Axes.imshow`

    Returns the image of matplotlib.
    """
    return ax.imshow(
        values.T, extent=frame.extent, origin="lower", interpolation="nearest", **colours
    )


def outline(ax: Any, frame: MapFrame, inside: NDArray[np.bool_], colour: str) -> None:
    """Draw the border of a set of cells, if it has one.

    ax      axes of matplotlib
    frame   cells, limits and unit of length
    inside  mask of the cells (nx, ny)
    colour  colour of the line
    """
    if inside.any() and not inside.all():
        x, y = frame.cells.x / frame.unit.size, frame.cells.y / frame.unit.size
        ax.contour(x, y, inside.T.astype(float), levels=[0.5], colors=[colour], linewidths=0.8)


def draw_arrows(
    ax: Any, frame: MapFrame, vector: Field, inside: NDArray[np.bool_], colour: str = "white"
) -> None:
    """Draw arrows of a vector field at the centres of some cells in a set.

    The length of an arrow is proportional to the vector. The longest arrow is as long as the
    spacing of the arrows.

    ax      axes of matplotlib
    frame   cells, limits and unit of length
    vector  vector field (2, nx, ny)
    inside  mask of the set of cells (nx, ny)
    colour  colour of the arrows
    """
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
    u, v = vector[:, i, j] * apart / longest
    edge = "black" if colour == "white" else "none"
    ax.quiver(
        x[i],
        y[j],
        u,
        v,
        angles="xy",
        scale_units="xy",
        scale=1.0,
        pivot="mid",
        color=colour,
        edgecolor=edge,
        linewidth=0.6,
        width=0.012,
        headwidth=3.5,
    )
