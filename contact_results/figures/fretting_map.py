"""What the last load cycle does to the surface: slip, dissipation, Ruiz's parameters."""

from __future__ import annotations

from collections.abc import Iterator
from math import floor, log10
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from contact_results.cycles import FrettingCycle
from contact_results.figures import style
from contact_results.figures.map_panels import MapFrame, draw_cells, map_axes
from contact_results.natural_sizes import SI, Units
from contact_scene.engineering_units import EngineeringUnit, engineering_unit

if TYPE_CHECKING:
    from contact_results.surface import Cells, Result

Field = NDArray[np.float64]


def fretting_map(result: Result, cells: Cells, cycle: FrettingCycle, units: Units = SI) -> Figure:
    """Maps of one cycle, each with its own scale."""
    frame = MapFrame.around_contact(result, cells, units)
    panels = list(_panels(cycle))
    width, height = frame.figure_size(len(panels))
    columns = 2 if len(panels) == 4 else 3
    figure = style.new_figure(width + 1.1 * (columns - 1), height + 0.8)
    figure.suptitle(
        f"cycle from the end of step {cycle.cycle.start} to the end of step {cycle.cycle.end}",
        fontsize=9.0,
    )
    inside = (cycle.largest_shear > 0) | (cycle.slip_amplitude > 0)
    for ax, (title, unit, values) in zip(map_axes(figure, frame, len(panels)), panels, strict=True):
        largest = float(np.max(values)) / unit.size
        image = draw_cells(
            ax, frame, np.where(inside, values / unit.size, np.nan),
            cmap=style.MAGNITUDE_MAP, vmin=0.0, vmax=largest or 1.0,
        )  # fmt: skip
        ax.set_facecolor(style.OUTSIDE_COLOUR)
        ax.set_title(f"{title} ({unit.name})")
        figure.colorbar(image, ax=ax, shrink=0.8)
    return figure


def _panels(cycle: FrettingCycle) -> Iterator[tuple[str, EngineeringUnit, Field]]:
    """Title, unit and values of every map."""
    for title, symbol, values in (
        ("slip amplitude δ", "m", cycle.slip_amplitude),
        ("dissipated per area", "J/m²", cycle.dissipation),
        ("Ruiz $F_1$ = τ δ", "Pa m", cycle.ruiz_f1),
    ):
        if values is not None:
            yield title, engineering_unit(float(np.max(values)), symbol), values
    if cycle.ruiz_f2 is not None:
        yield "Ruiz $F_2$ = $σ_T$ τ δ", _square_unit(float(np.max(cycle.ruiz_f2))), cycle.ruiz_f2


def _square_unit(largest: float) -> EngineeringUnit:
    """Pa² m times a power of ten: a prefix would be read as squared, too."""
    exponent = 3 * floor(log10(largest) / 3) if largest > 0 else 0
    return EngineeringUnit(10.0**exponent, f"$10^{{{exponent}}}$ Pa² m" if exponent else "Pa² m")
