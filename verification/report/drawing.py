"""Charts drawn with matplotlib from their data alone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from verification.cases.chart import Chart, Curve, Look, Panel
from verification.report.numbers import plain
from verification.run_output.figures import style

WIDTH = 6.6
HEIGHT_PER_UNIT = 1.5
LEAST_HEIGHT = 3.3
INK = "#1a1a1a"
REFERENCE_COLOUR = "#b4b4b4"
FEW_DECADES = 300.0
MARKERS = ("o", "s", "^", "D", "v", "P")


def draw(chart: Chart) -> Figure:
    """The figure of a chart; call within `style.figure_style`."""
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
        if not panel.y_places:
            ax.set_yscale("log")
            ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
            ax.yaxis.set_minor_formatter(NullFormatter())
        ax.xaxis.set_major_locator(LogLocator(subs=_labelled_parts(panel)))
        ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: plain(value)))
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.grid(True, color=REFERENCE_COLOUR, linewidth=0.4)
    elif any(min(c.y, default=0) < 0 < max(c.y, default=0) for c in panel.curves):
        ax.axhline(0.0, color=INK, linewidth=0.5)
    for curve in panel.curves:
        ax.plot(curve.x, curve.y, label=curve.label or None, **_look(curve))
    for x, y, text in panel.notes:
        ax.annotate(text, (x, y), xytext=(0, 6 if y >= 0 else -14), textcoords="offset points",
                    ha="center", color=INK)  # fmt: skip
    ax.margins(x=0.02, y=0.12)
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
    _legend(ax, panel.curves)


def _labelled_parts(panel: Panel) -> tuple[float, ...]:
    """The numbers of a decade that have a label: fewer, the more decades there are."""
    x = [value for curve in panel.curves for value in curve.x if value > 0]
    wide = max(x, default=1.0) > FEW_DECADES * min(x, default=1.0)
    return (1.0,) if wide else (1.0, 2.0, 5.0)


def _look(curve: Curve) -> dict[str, Any]:
    colour = style.LINE_COLOURS[curve.series % len(style.LINE_COLOURS)]
    match curve.look:
        case Look.REFERENCE:
            return {"color": REFERENCE_COLOUR, "linewidth": 4.0, "solid_capstyle": "round"}
        case Look.BOUND:
            return {"color": INK, "linewidth": 0.7, "linestyle": (0, (2, 2))}
        case Look.SLOPE:
            return {"color": colour, "linewidth": 0.9, "linestyle": (0, (4, 3))}
        case Look.MARKS:
            return {"color": INK, "linestyle": "none", "marker": "o", "markersize": 4}
        case Look.TILES:
            marker = MARKERS[curve.series % len(MARKERS)]
            return {"color": colour, "linestyle": "none", "marker": marker, "markersize": 7}
        case Look.POINTS:
            marker = MARKERS[curve.series % len(MARKERS)]
            return {"color": colour, "linewidth": 1.0, "marker": marker, "markersize": 3.6}
        case Look.COMPUTED:
            dashes = style.LINE_STYLES[curve.series % len(style.LINE_STYLES)]
            return {"color": colour, "linewidth": 1.3, "linestyle": dashes}


def _legend(ax: Any, curves: Sequence[Curve]) -> None:
    labelled = [curve for curve in curves if curve.label]
    if len(labelled) > 1 or any(curve.look is Look.TILES for curve in labelled):
        ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), handlelength=2.4, labelcolor=INK)
