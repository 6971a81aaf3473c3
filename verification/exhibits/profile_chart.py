"""Profiles along y = 0 with the closed form in grey, and a strip of their difference below."""

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
    """The row of cells next to y = 0, out to a little beyond the contact.

    x, y  positions of the cell centres [length]; y is half a cell for even counts of cells
    """

    grid: SurfaceGrid
    radius: float

    @property
    def _row(self) -> int:
        return self.grid.cells[1] // 2

    @property
    def _shown(self) -> NDArray[np.bool_]:
        return np.asarray(np.abs(self.grid.x) <= SHOWN * self.radius)

    @property
    def x(self) -> Field:
        """Positions along the row [length]."""
        return np.asarray(self.grid.x[self._shown])

    @property
    def y(self) -> float:
        """Distance of the row from the axis [length]."""
        return float(self.grid.y[self._row])

    @property
    def r(self) -> Field:
        """Distances from the axis [length]."""
        return np.asarray(np.hypot(self.x, self.y))

    def of(self, field: Field) -> Field:
        """Return the values of a field (nx, ny) on the row."""
        return np.asarray(field[self._shown, self._row])


@dataclass(frozen=True)
class Profile:
    """A computed profile and the exact one at the same points, both made dimensionless."""

    label: str
    computed: Field
    exact: Field


@dataclass(frozen=True)
class ProfileLabels:
    """Title and axis labels of a profile chart."""

    name: str
    title: str
    caption: str
    y_label: str
    x_label: str = "x / a"

    @property
    def difference_label(self) -> str:
        """Label of the difference strip: the same quantity over the same scale."""
        return f"Δ{self.y_label}"


def profile_chart(
    labels: ProfileLabels, section: Section, profiles: Sequence[Profile], scale: float | None = None
) -> Chart:
    """Profiles above, computed minus exact below.

    scale  length that x is divided by; None: the section's radius
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
