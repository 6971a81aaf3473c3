"""Drawing of the charts of a verification report with matplotlib, and as compact SVG elements.

The SVG elements use the colours of the page, have searchable text, and ids that are unique in the
page.
"""

from __future__ import annotations

import io
import re
from html import escape
from math import ceil, log10
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from contact_results.directory.atomic_file import atomic_file
from contact_results.figures import style
from verification.exhibits.chart import Chart, Curve, Look, Panel, plain

WIDTH = 6.6
HEIGHT_PER_UNIT = 1.5
LEAST_HEIGHT = 3.3
INK = "#1a1a1a"
REFERENCE_COLOUR = "#b4b4b4"
GRID_COLOUR = "#d9d9d9"
BAND_OPACITY = 0.22
# empty marks of equal errors lie in each other
LEAST_MARK = 3.6
MARK_GROWTH = 1.1
MARK_SIZES = 4
BOUND_DASHES = (0, (5, 3))  # thinner than those of any series
LONGEST_BESIDE = 30  # letters of a legend's text beside the plot
LONGEST_OF_TWO = 45  # and of two side by side below it
LEGEND_LINE = 0.19  # inches
MARKERS = ("o", "s", "^", "D", "v", "P")
DECADE = 10.0
# Arguments of matplotlib for looks that have the same colour in every series, and for the others.
FIXED_LOOKS: dict[Look, dict[str, Any]] = {
    Look.REFERENCE: {"color": REFERENCE_COLOUR, "linewidth": 4.0, "solid_capstyle": "round"},
    Look.BOUND: {"color": INK, "linewidth": 0.7, "linestyle": BOUND_DASHES},
    Look.MARKS: {"color": INK, "linestyle": "none", "marker": "o", "markersize": 4},
}
LOOKS: dict[Look, dict[str, Any]] = {
    Look.FITTED: {"linewidth": 1.0},
    Look.BAND: {"alpha": BAND_OPACITY, "linewidth": 0},
    Look.SLOPE: {"linewidth": 0.9, "linestyle": (0, (4, 3))},
    Look.TILES: {"linestyle": "none", "markersize": 7},
    Look.POINTS: {"linewidth": 1.0, "markersize": 3.6},
    Look.LEVELS: {"linestyle": "none", "markersize": LEAST_MARK, "fillstyle": "none"},
    Look.COMPUTED: {"linewidth": 1.3},
}
MANY_PLACES = 12  # along y: the legend then stands at the top, where reading begins


def draw(chart: Chart) -> Figure:
    """Draw a chart of a report with matplotlib and return its figure.

    This function must be called within `style.figure_style`.
    """
    heights = [row[0].height for row in chart.rows]
    columns = max(len(row) for row in chart.rows)
    maps = all(panel.y_places for row in chart.rows for panel in row)
    least = 0.0 if maps else LEAST_HEIGHT
    figure = style.new_figure(WIDTH, max(least, HEIGHT_PER_UNIT * sum(heights)))
    figure.patch.set_visible(False)
    axes = figure.subplots(
        len(chart.rows), columns, sharex="col", squeeze=False, height_ratios=heights
    )
    for row, panels in enumerate(chart.rows):
        for column, panel in enumerate(panels):
            _draw_panel(axes[row][column], panel)
    return figure


def _draw_panel(ax: Any, panel: Panel) -> None:
    ax.patch.set_visible(False)
    if panel.logarithmic:
        ax.set_xscale("log")
        ax.set_yscale("log")
    elif any(min(c.y, default=0) < 0 < max(c.y, default=0) for c in panel.curves):
        ax.axhline(0.0, color=INK, linewidth=0.5)
    for curve in panel.curves:
        if curve.look is Look.BAND:
            ax.fill(curve.x, curve.y, **look_of(curve))
        else:
            ax.plot(curve.x, curve.y, label=curve.label or None, **look_of(curve))
    if not panel.curves:  # an empty panel has no scale
        ax.set_yticks([])
    for x, y, text in panel.notes:
        ax.annotate(
            text,
            (x, y),
            xytext=(0, 6 if y >= 0 else -14),
            textcoords="offset points",
            ha="center",
            color=INK,
        )
    ax.margins(x=0.05 if panel.y_places else 0.02, y=0.12)
    if panel.logarithmic:
        _label_decades(ax, panel.least_range)
    if panel.x_places:
        ax.set_xticks(range(len(panel.x_places)), panel.x_places)
        ax.set_xlim(-0.5, len(panel.x_places) - 0.5)
    if panel.y_places:
        ax.set_yticks(range(len(panel.y_places)), panel.y_places)
        ax.set_ylim(-0.5, len(panel.y_places) - 0.25)
    ax.set_xlabel(panel.x_label, color=INK)
    ax.set_ylabel(panel.y_label, color=INK)
    ax.set_title(panel.title, color=INK, loc="left")
    ax.tick_params(which="both", colors=INK)
    for spine in ax.spines.values():
        spine.set_edgecolor(INK)
    _draw_legend(ax, panel)


def _label_decades(ax: Any, least: float) -> None:
    """Print round numbers on the logarithmic axes of a panel.

    The y axis spans a decade at least, so that equal errors do not look different.

    ax     axes of matplotlib
    least  smallest ratio of the ends of the x axis
    """
    for axis, set_ends, ratio in ((ax.xaxis, ax.set_xlim, least), (ax.yaxis, ax.set_ylim, DECADE)):
        low, high = axis.get_view_interval()
        if high < ratio * low:
            middle, part = np.sqrt(low * high), np.sqrt(ratio)
            low, high = middle / part, middle * part
            set_ends(low, high)
        # Ticks of a short axis differ in digits that a number of three digits lacks. Its labels
        # need twice the width.
        digits = max(3, 2 + ceil(-log10(high / low - 1)))
        ticks = style.round_ticks(low, high)[:: 1 if digits == 3 else 2]
        axis.set_ticks(ticks, [plain(tick, digits) for tick in ticks])
        axis.set_minor_formatter(NullFormatter())
    ax.grid(True, color=GRID_COLOUR, linewidth=0.6)


def look_of(curve: Curve) -> dict[str, Any]:
    """Return the matplotlib arguments of a chart curve: colour, marker and line style.

    When the colours repeat, the markers are shifted by one, so that 36 series look different.
    """
    if curve.look in FIXED_LOOKS:
        return FIXED_LOOKS[curve.look]
    round_, place = divmod(curve.series, len(style.LINE_COLOURS))
    shape = (place + round_) % len(MARKERS)
    look = {"color": style.LINE_COLOURS[place], **LOOKS[curve.look]}
    if "markersize" in look:
        look["marker"] = MARKERS[shape]
    if curve.look is Look.LEVELS:
        look["markersize"] += MARK_GROWTH * (place % MARK_SIZES)
    if curve.look is Look.COMPUTED:
        look["linestyle"] = style.LINE_STYLES[shape]
    return look


def _draw_legend(ax: Any, panel: Panel) -> None:
    labelled = [curve for curve in panel.curves if curve.label]
    longest = max((len(curve.label) for curve in labelled), default=0)
    if len(labelled) == 2 and panel.y_places:  # the names take the width that it would need
        ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, labelcolor=INK)
    elif (
        len(labelled) > 1
        and longest > LONGEST_BESIDE
        and len(ax.figure.axes) == 1
        and not panel.y_places
    ):
        _legend_below(ax, longest)
    elif len(labelled) > 1 or any(curve.look is Look.TILES for curve in labelled):
        top = len(panel.y_places) > MANY_PLACES
        where, height = ("upper left", 1.0) if top else ("center left", 0.5)
        ax.legend(loc=where, bbox_to_anchor=(1.01, height), handlelength=2.4, labelcolor=INK)


def _legend_below(ax: Any, longest: int) -> None:
    """Draw the legend of a panel below the chart, in two columns if the longest text fits.

    ax       axes of matplotlib
    longest  number of letters of the longest text
    """
    columns = 1 if longest > LONGEST_OF_TWO else 2
    handles, labels = ax.get_legend_handles_labels()
    lines = -(-len(labels) // columns)
    ax.figure.set_figheight(ax.figure.get_figheight() + LEGEND_LINE * lines)
    ax.figure.legend(
        handles, labels, loc="outside lower left", ncols=columns, handlelength=2.4, labelcolor=INK
    )


def write_picture(chart: Chart, path: Path) -> None:
    """Draw a chart of a report on white, and write it as a PNG file."""
    with style.figure_style(), atomic_file(path) as temporary:
        figure = draw(chart)
        figure.patch.set_visible(True)
        style.save(figure, temporary)


# Colours of a diagram become variables of the page, which has a light and a dark value of each.
VARIABLES = {
    INK: "--ink",
    REFERENCE_COLOUR: "--reference",
    GRID_COLOUR: "--line",
    **{colour: f"--series-{n}" for n, colour in enumerate(style.LINE_COLOURS, 1)},
}
NO_METADATA = {"Date": None, "Creator": None, "Format": None, "Type": None}
NUMBER = re.compile(r"-?\d+\.\d{3,}")
LENGTHS = re.compile(r' (?:d|x|y|width|height|points|transform|viewBox)="[^"]*"')
# Elements to which matplotlib's own references point have ids without an underscore.
UNUSED = re.compile(
    r"<metadata>.*?</metadata>|<!--.*?-->|<style.*?</style>| id=\"\w[\w.]*_\d+\"", re.DOTALL
)


def inline_svg(chart: Chart, prefix: str = "") -> str:
    """Draw a chart of a report and return its SVG element for an HTML page; equal charts give equal
    text.

    prefix  prefix of the ids, for a chart that a page shows twice
    """
    name = re.sub(r"[^A-Za-z0-9_.-]", "_", prefix + chart.name)
    with style.figure_style():
        # Text stays text: it can be searched, read out, and takes the page's colour.
        matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": name})
        buffer = io.StringIO()
        draw(chart).savefig(buffer, format="svg", metadata=NO_METADATA)
    # The page sets the font family.
    svg = re.sub(r"\s+|font-family:[^;\"]*;?", " ", UNUSED.sub("", buffer.getvalue()))
    svg = LENGTHS.sub(lambda m: NUMBER.sub(lambda n: f"{float(n[0]):.2f}", m[0]), svg)
    for colour, variable in VARIABLES.items():
        svg = re.sub(re.escape(colour), f"var({variable})", svg, flags=re.IGNORECASE)
    opening, rest = svg[svg.index("<svg") :].strip().split(">", 1)
    opening = re.sub(r'\s(width|height)="[^"]*"', "", opening)
    title = f'<title id="{name}-name">{escape(chart.title)}</title>'
    return f'{opening} role="img" aria-labelledby="{name}-name">{title}{rest}'
