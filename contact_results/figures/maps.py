"""Maps of the surface seen from above: pressure, shear, zones, slip, dissipation, load cycles."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import floor, log10
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure, FigureBase
from matplotlib.patches import Patch
from numpy.typing import NDArray

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
from contact_results.figures.shown_steps import (
    SAME,
    normal_load,
    runs_of_equal,
    selected,
    span,
    tangential_load,
    vectors,
)
from contact_results.natural_sizes import SI, Units
from contact_scene.engineering_units import EngineeringUnit, engineering_unit, quantity

if TYPE_CHECKING:
    from contact_results.surface import Cells, Increment, Result

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]

ZONES = (
    ("no contact", style.OUTSIDE_COLOUR),
    ("slip", style.SLIP_COLOUR),
    ("stick", style.STICK_COLOUR),
)


@dataclass(frozen=True, eq=False)
class Panel:
    """One map.

    values    colours of the cells (nx, ny), NaN for the background
    arrows    vector field (2, nx, ny) and the cells that have arrows
    outlined  cells with a line around them
    """

    title: str
    values: Field
    arrows: tuple[Field, Mask] | None = None
    outlined: Mask | None = None


def draw_panel(
    ax: Any, frame: MapFrame, panel: Panel, largest: float, *, signed: bool = False
) -> Any:
    """Draw one map and return its image; `signed` colours are even about zero."""
    image = draw_cells(
        ax, frame, panel.values, cmap=style.SIGNED_MAP if signed else style.MAGNITUDE_MAP,
        vmin=-largest if signed else 0.0, vmax=largest,
    )  # fmt: skip
    ax.set_facecolor(style.OUTSIDE_COLOUR)
    ax.set_title(panel.title)
    if panel.arrows is not None:
        draw_arrows(ax, frame, *panel.arrows)
    if panel.outlined is not None:
        outline(ax, frame, panel.outlined, "black" if signed else "white")
    return image


def draw_maps(
    figure: FigureBase,
    frame: MapFrame,
    panels: Sequence[Panel],
    label: str,
    largest: float,
    *,
    signed: bool = False,
) -> None:
    """Draw maps with one colour bar."""
    axes = map_axes(figure, frame, len(panels))
    for ax, panel in zip(axes, panels, strict=True):
        image = draw_panel(ax, frame, panel, largest, signed=signed)
    figure.colorbar(image, ax=axes, label=label, shrink=0.9)


def pressure_map(result: Result, cells: Cells, units: Units = SI) -> Figure:
    """Draw the pressure at the end of the load steps; equal neighbours share a panel."""
    frame = MapFrame.around_contact(result, cells, units)
    groups = runs_of_equal(selected(result.steps), lambda step: step.pressure)
    peak = max(step.peak_pressure for step in result.steps)
    unit = units.of("pressure", peak, "Pa")
    panels = [
        Panel(
            f"{span(group)}: {normal_load(group[0])}",
            np.where(group[0].in_contact, group[0].pressure / unit.size, np.nan),
        )
        for group in groups
    ]
    figure = style.new_figure(*frame.figure_size(len(panels)))
    draw_maps(figure, frame, panels, unit.labelled("pressure p"), peak / unit.size)
    return figure


def shear_map(result: Result, cells: Cells, units: Units = SI) -> Figure:
    """Draw the shear at the end of load steps, one row of panels for each of its components.

    The components have scales of their own: the one across the load is a few per cent of the one
    along it, and left out where it is round-off.
    """
    frame = MapFrame.around_contact(result, cells, units)
    shears = selected(vectors(cells, result.steps, "shear"))
    largest = np.max([np.max(np.abs(shear), axis=(1, 2)) for _, shear in shears], axis=0).tolist()
    components = [k for k in (0, 1) if largest[k] > SAME * max(largest)]
    width, height = frame.figure_size(len(shears), len(components))
    figure = style.new_figure(width, height + 0.3)  # and a line of text at the bottom
    rows = figure.subfigures(len(components), 1, squeeze=False)[:, 0]
    for k, row in zip(components, rows, strict=True):
        unit = units.of("shear", largest[k], "Pa")
        panels = [
            Panel(_pushed(step), shear[k] / unit.size, outlined=step.in_stick)
            for step, shear in shears
        ]
        label = unit.labelled(f"shear $q_{'xy'[k]}$")
        draw_maps(row, frame, panels, label, largest[k] / unit.size, signed=True)
    rows[-1].supxlabel("black line: border of the stick zone", fontsize="medium")
    return figure


def slip_map(result: Result, cells: Above, units: Units = SI) -> Figure:
    """Draw the slip of the body on the indenter since the start of the history: its magnitude in
    colours, arrows along it, and the border of the stick zone."""
    frame = MapFrame.around_contact(result, cells, units)
    slips = selected(vectors(cells, result.steps, "slip"))
    largest = max(float(np.max(np.hypot(*slip))) for _, slip in slips)
    unit = units.of("slip", largest, "m")
    panels = []
    for step, slip in slips:
        touching, sticking = cells.scalar(step, "in_contact"), cells.scalar(step, "in_stick")
        assert touching is not None
        size = np.where(touching, np.hypot(*slip) / unit.size, np.nan)
        panels.append(Panel(_pushed(step), size, (slip, touching), sticking))
    width, height = frame.figure_size(len(slips))
    figure = style.new_figure(width, height + 0.2)
    draw_maps(figure, frame, panels, unit.labelled("slip since the start"), largest / unit.size)
    figure.supylabel("arrows: slip of the body; white: stick", fontsize=style.CAPTION_SIZE)
    return figure


def dissipating(steps: Sequence[Increment], cells: Cells) -> list[tuple[Increment, Field]]:
    """Return the load steps that dissipate energy, with the energy per area of each (nx, ny)."""
    given = ((step, cells.scalar(step, "dissipation")) for step in steps)
    known = [(step, field) for step, field in given if field is not None]
    within = [*known[:1], *((now, d1 - d0) for (_, d0), (now, d1) in pairwise(known))]
    return [(step, lost) for step, lost in within if np.any(lost)]


def dissipation_map(result: Result, cells: Cells, units: Units = SI) -> Figure:
    """Draw the energy per area that friction dissipates within each load step."""
    frame = MapFrame.around_contact(result, cells, units)
    steps = selected(dissipating(result.steps, cells))
    peak = max(float(np.max(lost)) for _, lost in steps)
    unit = engineering_unit(peak, "J/m²")
    panels = [
        Panel(
            f"{span([step])}: {quantity(float(np.sum(lost)) * cells.cell_area, 'J', 3)}",
            np.where(step.in_contact | (lost > 0), lost / unit.size, np.nan),
        )
        for step, lost in steps
    ]
    figure = style.new_figure(*frame.figure_size(len(panels)))
    label = f"energy dissipated per area ({unit.name})"
    draw_maps(figure, frame, panels, label, peak / unit.size)
    return figure


def fretting_map(result: Result, cells: Cells, cycle: FrettingCycle, units: Units = SI) -> Figure:
    """Draw slip, dissipation and Ruiz's parameters of one load cycle, each with its own scale."""
    frame = MapFrame.around_contact(result, cells, units)
    fields = list(_fields_of(cycle))
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
        panel = Panel(f"{title} ({unit.name})", np.where(inside, values / unit.size, np.nan))
        image = draw_panel(ax, frame, panel, float(np.max(values)) / unit.size or 1.0)
        figure.colorbar(image, ax=ax, shrink=0.8)
    return figure


def _fields_of(cycle: FrettingCycle) -> Iterator[tuple[str, EngineeringUnit, Field]]:
    """Title, unit and values of every map."""
    for title, symbol, values in (
        ("slip amplitude δ", "m", cycle.slip_amplitude),
        ("dissipated per area", "J/m²", cycle.dissipation),
        ("Ruiz $F_1$ = τ δ", "Pa m", cycle.ruiz_f1),
    ):
        if values is not None:
            yield title, engineering_unit(float(np.max(values)), symbol), values
    if cycle.ruiz_f2 is not None:
        largest = float(np.max(cycle.ruiz_f2))
        # A power of ten: a prefix would be read as squared, too.
        exponent = 3 * floor(log10(largest) / 3) if largest > 0 else 0
        name = f"$10^{{{exponent}}}$ Pa² m" if exponent else "Pa² m"
        yield "Ruiz $F_2$ = $σ_T$ τ δ", EngineeringUnit(10.0**exponent, name), cycle.ruiz_f2


def stick_slip_map(result: Result, cells: Above, units: Units = SI) -> Figure:
    """Draw the zones of stick and slip at the end of the load steps, and the latest slip."""
    frame = MapFrame.around_contact(result, cells, units)
    steps = selected([step for step in result.steps if step.in_stick is not None])
    width, height = frame.figure_size(len(steps))
    figure = style.new_figure(width - 0.6, height + 0.3)  # a legend below, no colour bar
    for ax, step in zip(map_axes(figure, frame, len(steps)), steps, strict=True):
        draw_zones(ax, frame, result, step)
        ax.set_title(_pushed(step))
    figure.supylabel("arrows: slip in the last increment", fontsize=style.CAPTION_SIZE)
    add_zone_legend(figure)
    return figure


def add_zone_legend(figure: Any, **where: Any) -> None:
    """Add the names of the zones' colours above a figure, or where axes have their legend."""
    patches = [Patch(facecolor=c, edgecolor=style.GREY, label=name) for name, c in ZONES]
    where = where or {"loc": "outside upper center", "ncols": len(ZONES)}
    figure.legend(handles=patches, **where)


def draw_zones(ax: Any, frame: MapFrame, result: Result, step: Increment) -> None:
    """Draw contact, stick and slip at the end of a step, with arrows of its latest slip."""
    touching = frame.cells.scalar(step, "in_contact")
    sticking = frame.cells.scalar(step, "in_stick")
    assert touching is not None
    assert sticking is not None
    colours = ListedColormap([colour for _, colour in ZONES])
    # The zone's number in ZONES: stick implies contact.
    zone = touching.astype(int) + (touching & sticking).astype(int)
    draw_cells(ax, frame, zone, cmap=colours, vmin=0, vmax=len(ZONES) - 1)
    slip = latest_slip(result, frame.cells, step)
    if slip is not None:
        draw_arrows(ax, frame, slip, touching & ~sticking, "black")


def latest_slip(result: Result, cells: Above, step: Increment) -> Field | None:
    """Compute the slip within the increment (2, nx, ny), which opposes the shear [length]."""
    now = cells.vector(step, "slip")
    number = next(n for n, increment in enumerate(result.increments) if increment is step)
    before = cells.vector(result.increments[number - 1], "slip") if number else None
    return now if now is None or before is None else now - before


def _pushed(step: Increment) -> str:
    return f"{span([step])}: {tangential_load(step)}"
