"""Style of the figures, and reproducible image files."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from math import ceil, floor, log10
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from PIL import Image

# Okabe and Ito (2008): distinct for every common kind of colour vision; no yellow on white.
LINE_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#000000")
LINE_STYLES: tuple[Any, ...] = ("-", "--", "-.", (0, (1, 1)), (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)))
GREY = "#8A8A8A"
STICK_COLOUR = "#0072B2"
SLIP_COLOUR = "#F0C36D"
OUTSIDE_COLOUR = "#F2F2F2"
MAGNITUDE_MAP = "cividis"
SIGNED_MAP = "RdBu_r"

STYLE: Any = {
    "font.family": "DejaVu Sans",  # part of matplotlib, for equal figures on every machine
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": False,
    "legend.frameon": False,
    "lines.linewidth": 1.5,
    "xtick.direction": "out",
    "ytick.direction": "out",
    "svg.hashsalt": "slipstick",
    "path.simplify": True,
    "text.hinting": "no_hinting",  # glyphs as designed; the hints take half the time of a text
}
DOTS_PER_INCH = 150
OF_SECTIONS = 120  # dots per inch of contour plots, which compress badly
CAPTION_SIZE = 7.5
# Numbers of ticks of a logarithmic axis.
MAX_TICKS = 8
LEAST_TICKS = 2
FEW_DECADES = 2


@contextmanager
def figure_style() -> Iterator[None]:
    """Apply the style of all figures in the `with` block, without the matplotlibrc of the user.

    Characters of a title that the font lacks are drawn as boxes without a warning: pages and
    summaries have the title as well.
    """
    defaults: Any = {k: v for k, v in matplotlib.rcParamsDefault.items() if k != "backend"}
    # rcdefaults would read all style files
    with matplotlib.rc_context(defaults | STYLE), warnings.catch_warnings():
        warnings.filterwarnings("ignore", r"Glyph \d+ .* missing from font")
        yield


def new_figure(width: float, height: float, *, arranged: bool = True) -> Figure:
    """Create an empty figure that arranges its contents by default.

    width, height  size of the figure [inch]
    arranged       use the constrained layout of matplotlib
    """
    figure = Figure(figsize=(width, height), layout="constrained" if arranged else None)
    FigureCanvasAgg(figure)
    return figure


def line_style(number: int) -> dict[str, Any]:
    """Return colour and dash pattern of a curve, distinct in colour and in grey print.

    number  number of the curve in its figure, from 0
    """
    return {"color": LINE_COLOURS[number], "linestyle": LINE_STYLES[number]}


def round_ticks(low: float, high: float) -> list[float]:
    """Return round numbers in a range, for the ticks of a logarithmic axis.

    They are powers of ten; below `FEW_DECADES` also 2 and 5 times these; where fewer than two of
    them are in the range, multiples of a round step. A range of one number has this tick.

    low, high  ends of the range, both positive
    """
    decades = range(floor(log10(low)), ceil(log10(high)) + 1)
    parts = (1, 2, 5) if high < low * 10**FEW_DECADES else (1,)
    # As text a number has no round-off: 2e-05 and not 2.0000000000000002e-05.
    ticks = [float(f"{part}e{decade}") for decade in decades for part in parts]
    within = [tick for tick in ticks if low <= tick <= high]
    if len(within) < LEAST_TICKS:
        steps = MaxNLocator(MAX_TICKS, steps=(1, 2, 5, 10)).tick_values(low, high)
        within = [float(tick) for tick in steps if low < tick < high] or [low]
    return within[:: ceil(len(within) / MAX_TICKS)]


def legend_above(ax: Any, **given: Any) -> None:
    """Add a legend in one row above the axes.

    ax     axes of matplotlib
    given  further arguments of `Axes.legend`
    """
    ax.legend(
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        ncols=5,
        fontsize="small",
        handlelength=1.6,
        columnspacing=1.0,
        **given,
    )


def legend_beside(ax: Any) -> None:
    """Add a legend at the right of the axes.

    ax  axes of matplotlib
    """
    ax.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), handlelength=2.6)


def save(figure: Figure, path: Path, dots_per_inch: int = DOTS_PER_INCH) -> None:
    """Write a figure to a PNG or SVG file without date and version: the bytes are reproducible.

    dots_per_inch  resolution of a PNG
    """
    if path.suffix == ".svg":
        figure.savefig(path, metadata={"Date": None, "Creator": None})
        return
    figure.dpi = dots_per_inch
    canvas: Any = FigureCanvasAgg(figure)
    canvas.draw()  # savefig would draw the figure twice
    drawn = Image.frombuffer(
        "RGBA", canvas.get_width_height(), canvas.buffer_rgba(), "raw", "RGBA", 0, 1
    )
    # A palette of 256 colours would take a third of the bytes, but merges colours of curves.
    drawn.convert("RGB").save(path, "png", compress_level=3, dpi=(dots_per_inch, dots_per_inch))
