"""Where the bodies stick and where they slip."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from contact_results.figures import style
from contact_results.figures.map_panels import Above, MapFrame, draw_arrows, draw_cells, map_axes
from contact_results.figures.shown_steps import selected, span, tangential_load
from contact_results.natural_sizes import SI, Units

if TYPE_CHECKING:
    from contact_results.surface import Field, Increment, Result

ZONES = (
    ("no contact", style.OUTSIDE_COLOUR),
    ("slip", style.SLIP_COLOUR),
    ("stick", style.STICK_COLOUR),
)


def stick_slip_map(result: Result, cells: Above, units: Units = SI) -> Figure:
    """Zones of stick and slip at the end of the loading steps, and where the body slips to."""
    frame = MapFrame.around_contact(result, cells, units)
    steps = selected([step for step in result.steps if step.in_stick is not None])
    width, height = frame.figure_size(len(steps))
    figure = style.new_figure(width - 0.6, height + 0.3)  # a legend below, no colour bar
    for ax, step in zip(map_axes(figure, frame, len(steps)), steps, strict=True):
        draw_zones(ax, frame, result, step)
        ax.set_title(f"{span([step])}: {tangential_load(step)}")
    figure.supylabel("arrows: slip in the last increment", fontsize=style.CAPTION_SIZE)
    add_zone_legend(figure)
    return figure


def add_zone_legend(figure: Any, **where: Any) -> None:
    """What the colours are, above a figure or where axes have their legend."""
    patches = [Patch(facecolor=c, edgecolor=style.GREY, label=name) for name, c in ZONES]
    where = where or {"loc": "outside upper center", "ncols": len(ZONES)}
    figure.legend(handles=patches, **where)


def draw_zones(ax: Any, frame: MapFrame, result: Result, step: Increment) -> None:
    """Contact, stick and slip at the end of a step, with arrows of its latest slip."""
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
    """Slip within the increment (2, nx, ny), which opposes the shear [length]."""
    now = cells.vector(step, "slip")
    number = next(n for n, increment in enumerate(result.increments) if increment is step)
    before = cells.vector(result.increments[number - 1], "slip") if number else None
    return now if now is None or before is None else now - before
