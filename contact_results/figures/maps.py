"""Maps of the surface: pressure, shear, stick and slip zones, slip, dissipation, load cycles."""

from __future__ import annotations

from collections.abc import Iterator
from math import floor, log10
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from contact_results.cycles import FrettingCycle
from contact_results.figures import style
from contact_results.figures.map_panels import (
    Above,
    MapFrame,
    draw_arrows,
    draw_cells,
    map_axes,
    outline,
)
from contact_results.figures.shown_steps import select_steps, step_title
from contact_results.result_report import ResultReport
from contact_scene.array_types import Field
from contact_scene.reading.engineering_units import (
    EngineeringUnit,
    engineering_unit,
)

if TYPE_CHECKING:
    from contact_results.surface import Increment


# Label, SI unit, and True for vectors, of each field with a map.
FIELDS = {
    "pressure": ("pressure p", "Pa", False),
    "shear": ("shear |q|", "Pa", True),
    "slip": ("slip since the start |s|", "m", True),
    "dissipation": ("energy dissipated per area since the start", "J/m²", False),
}
ZONES = (
    ("no contact", style.OUTSIDE_COLOUR),
    ("slip", style.SLIP_COLOUR),
    ("stick", style.STICK_COLOUR),
)


def draw_panel(ax: Any, frame: MapFrame, title: str, values: Field, largest: float) -> Any:
    """Draw one map of the surface, and return its image of matplotlib for the colour bar.

    ax       axes of matplotlib
    frame    cells, limits and unit of length
    title    title of the map
    values   values of the cells (nx, ny); NaN shows the background
    largest  value at the upper end of the colour scale
    """
    ax.set_facecolor(style.OUTSIDE_COLOUR)
    ax.set_title(title)
    return draw_cells(ax, frame, values, cmap=style.MAGNITUDE_MAP, vmin=0.0, vmax=largest)


def field_map(report: ResultReport, frame: MapFrame, name: str) -> Figure | None:
    """Draw maps of a surface field at the ends of load steps, with the border of the stick zone.

    A vector is drawn by its magnitude in colours, and by arrows.

    name  name of the field, see `FIELDS`

    Returns None if the field is missing or zero at the ends of all load steps.
    """
    cells = frame.cells
    label, symbol, is_vector = FIELDS[name]
    read = cells.vector if is_vector else cells.scalar
    given = [(step, read(step, name)) for step in report.steps]
    shown = select_steps(
        [(step, field) for step, field in given if field is not None and field.any()]
    )
    if not shown:
        return None
    sizes = [np.hypot(*field) if is_vector else field for _, field in shown]
    largest = float(np.max(sizes))
    unit = engineering_unit(largest, symbol)
    figure = style.new_figure(*frame.figure_size(len(shown)))
    axes = map_axes(figure, frame, len(shown))
    for ax, (step, field), size in zip(axes, shown, sizes, strict=True):
        touching, sticking = cells.scalar(step, "in_contact"), cells.scalar(step, "in_stick")
        assert touching is not None
        inside = touching | (size > 0 if name == "dissipation" else False)
        values = np.where(inside, size / unit.size, np.nan)
        image = draw_panel(ax, frame, step_title(step), values, largest / unit.size)
        if is_vector:
            draw_arrows(ax, frame, field, touching)
        if sticking is not None:
            outline(ax, frame, sticking, "white")
    figure.colorbar(image, ax=axes, label=unit.labelled(label), shrink=0.9)
    figure.supylabel("white line: border of stick", fontsize=style.CAPTION_SIZE)
    return figure


def fretting_map(frame: MapFrame, cycle: FrettingCycle) -> Figure:
    """Draw maps of slip amplitude, dissipated energy and Ruiz's parameters of one load cycle.

    Each map has a separate colour scale.
    """
    fields = list(_cycle_fields(cycle))
    width, height = frame.figure_size(len(fields))
    columns = 2 if len(fields) == 4 else 3
    figure = style.new_figure(width + 1.1 * (columns - 1), height + 0.8)
    figure.suptitle(
        f"cycle from the end of step {cycle.cycle.start} to the end of step {cycle.cycle.end}",
        fontsize=9.0,
    )
    inside = (cycle.largest_shear > 0) | (cycle.slip_amplitude > 0)
    axes = map_axes(figure, frame, len(fields))
    for ax, (title, unit, values) in zip(axes, fields, strict=True):
        largest = float(np.max(values)) / unit.size or 1.0
        seen = np.where(inside, values / unit.size, np.nan)
        image = draw_panel(ax, frame, f"{title} ({unit.name})", seen, largest)
        figure.colorbar(image, ax=ax, shrink=0.8)
    return figure


def _cycle_fields(cycle: FrettingCycle) -> Iterator[tuple[str, EngineeringUnit, Field]]:
    """Yield title, unit and surface field of each map of a load cycle: slip, energy, F1, F2."""
    for title, symbol, values in (
        ("slip amplitude δ", "m", cycle.slip_amplitude),
        ("dissipated per area", "J/m²", cycle.dissipation),
        ("Ruiz F₁ = τ δ", "Pa m", cycle.ruiz_f1),
    ):
        if values is not None:
            yield title, engineering_unit(float(np.max(values)), symbol), values
    if cycle.ruiz_f2 is not None:
        largest = float(np.max(cycle.ruiz_f2))
        # A power of ten, because a prefix of Pa would be squared.
        exponent = 3 * floor(log10(largest) / 3) if largest > 0 else 0
        name = f"$10^{{{exponent}}}$ Pa² m" if exponent else "Pa² m"
        yield "Ruiz F₂ = σₜ τ δ", EngineeringUnit(10.0**exponent, name), cycle.ruiz_f2


def stick_slip_map(report: ResultReport, frame: MapFrame) -> Figure:
    """Draw the stick and slip zones at the ends of load steps, with arrows of the slip.

    The arrows show the slip in the last increment of each load step.
    """
    steps = select_steps([step for step in report.steps if step.in_stick is not None])
    width, height = frame.figure_size(len(steps))
    figure = style.new_figure(width - 0.6, height + 0.3)  # a legend instead of a colour bar
    for ax, step in zip(map_axes(figure, frame, len(steps)), steps, strict=True):
        draw_zones(ax, frame, report, step)
        ax.set_title(step_title(step))
    figure.supylabel("arrows: slip in the last increment", fontsize=style.CAPTION_SIZE)
    figure.legend(handles=zone_patches(), loc="outside upper center", ncols=len(ZONES))
    return figure


def zone_patches() -> list[Patch]:
    """Return colour patches with the names of the zones, for a legend: no contact, slip, stick."""
    return [Patch(facecolor=c, edgecolor=style.GREY, label=name) for name, c in ZONES]


def draw_zones(ax: Any, frame: MapFrame, report: ResultReport, step: Increment) -> None:
    """Draw the stick and slip zones at the end of a load step, with arrows of its latest slip.

    ax     axes of matplotlib
    frame  cells, limits and unit of length
    step   last increment of the load step
    """
    touching = frame.cells.scalar(step, "in_contact")
    sticking = frame.cells.scalar(step, "in_stick")
    assert touching is not None
    assert sticking is not None
    colours = ListedColormap([colour for _, colour in ZONES])
    # Index of the zone in ZONES; stick implies contact.
    zone = touching.astype(int) + (touching & sticking).astype(int)
    draw_cells(ax, frame, zone, cmap=colours, vmin=0, vmax=len(ZONES) - 1)
    slip = latest_slip(report, frame.cells, step)
    if slip is not None:
        draw_arrows(ax, frame, slip, touching & ~sticking, "black")


def latest_slip(report: ResultReport, cells: Above, step: Increment) -> Field | None:
    """Compute the slip within one increment (2, nx, ny) [length].

    This slip opposes the shear. Returns None if the increment has no slip.

    cells  surface grid of the maps
    step   increment of the result
    """
    now = cells.vector(step, "slip")
    number = next(n for n, increment in enumerate(report.increments) if increment is step)
    before = cells.vector(report.increments[number - 1], "slip") if number else None
    return now if now is None or before is None else now - before
