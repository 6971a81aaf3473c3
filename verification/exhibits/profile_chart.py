"""Charts of computed and exact traction profiles along the row of cells nearest to y = 0.

A second panel below shows their difference.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.grid import SurfaceGrid
from verification.exhibits.chart import Chart, Look, Panel, curve

Field = NDArray[np.float64]
SHOWN = 1.15  # contact radii to each side of the axis


@dataclass(frozen=True)
class Section:
    """Row of cells of a surface grid nearest to y = 0, along which a profile chart shows fields.

    The row extends to 1.15 contact radii on both sides of the axis.

    grid    surface grid
    radius  contact radius [length]
    """

    grid: SurfaceGrid
    radius: float

    @property
    def _section_row(self) -> int:
        return self.grid.cells[1] // 2

    @property
    def _plotted_cells(self) -> NDArray[np.bool_]:
        return np.asarray(np.abs(self.grid.x) <= SHOWN * self.radius)

    @property
    def x(self) -> Field:
        """x coordinates of the cell centres along the row [length]."""
        return np.asarray(self.grid.x[self._plotted_cells])

    @property
    def y(self) -> float:
        """y coordinate of the row of cells [length]: half a cell for an even number of cells, else
        0."""
        return float(self.grid.y[self._section_row])

    @property
    def r(self) -> Field:
        """Distances of the cell centres of the row from the axis of the contact, √(x² + y²)
        [length]."""
        return np.asarray(np.hypot(self.x, self.y))

    def of(self, field: Field) -> Field:
        """Return the values of a surface field (nx, ny) at the cells of the row."""
        return np.asarray(field[self._plotted_cells, self._section_row])


@dataclass(frozen=True)
class Profile:
    """Computed and exact values of one dimensionless quantity at the cells of a section, for a
    chart.

    label     text of the legend
    computed  computed values (cells of the row,)
    exact     values of the closed form at the same cells
    """

    label: str
    computed: Field
    exact: Field


@dataclass(frozen=True)
class ProfileLabels:
    """Texts of a profile chart: identifier, title, caption and axis labels."""

    name: str
    title: str
    caption: str
    y_label: str
    x_label: str = "x / a"

    @property
    def difference_label(self) -> str:
        """Label of the y axis of the panel of differences: the label of the profile with Δ in
        front."""
        return f"Δ{self.y_label}"


def profile_chart(
    labels: ProfileLabels, section: Section, profiles: Sequence[Profile], scale: float | None = None
) -> Chart:
    """Create a chart of computed and exact profiles, with computed minus exact values in a panel
    below.

    section   row of cells at which the profiles are known
    profiles  computed and exact values of each quantity
    scale     length by which x is divided; None for the contact radius of the section
    """
    x = section.x / (section.radius if scale is None else scale)
    exact = [
        curve("closed form" if n == 0 else "", x, p.exact, Look.REFERENCE, 0)
        for n, p in enumerate(profiles)
    ]
    computed = [curve(p.label, x, p.computed, Look.COMPUTED, n) for n, p in enumerate(profiles)]
    difference = [
        curve("", x, p.computed - p.exact, Look.COMPUTED, n) for n, p in enumerate(profiles)
    ]
    above = Panel(x_label="", y_label=labels.y_label, curves=(*exact, *computed), height=2.6)
    below = Panel(x_label=labels.x_label, y_label=labels.difference_label, curves=tuple(difference))
    return Chart(
        name=labels.name, title=labels.title, caption=labels.caption, rows=((above,), (below,))
    )
