"""Figures as SVG inside a page: its colours, its text, no clash of names."""

from __future__ import annotations

import io
import re
from html import escape
from urllib.parse import quote

import matplotlib

from contact_results.figures import style
from verification.exhibits.chart import Chart
from verification.exhibits.picture import Picture
from verification.report.compact_svg import compact
from verification.report.drawing import GRID_COLOUR, INK, REFERENCE_COLOUR, draw

# Colours of a figure become variables of the page, which has a light and a dark value of each.
VARIABLES = {
    INK: "--ink",
    REFERENCE_COLOUR: "--reference",
    GRID_COLOUR: "--line",
    **{colour: f"--series-{n}" for n, colour in enumerate(style.LINE_COLOURS, 1)},
}
ROOT = '<svg xmlns="http://www.w3.org/2000/svg" font-family="DejaVu Sans,Verdana,sans-serif"'
KEPT_AS_IT_IS = " =:/;,+()!*@$?[]"  # of an address within quotes
NO_METADATA = {"Date": None, "Creator": None, "Format": None, "Type": None}


def inline_svg(chart: Chart, prefix: str = "") -> str:
    """The chart as an SVG element; equal charts give equal text.

    prefix  of its ids, where a page shows a chart twice
    """
    with style.figure_style():
        # Text stays text: it can be searched, read out, and takes the page's colour.
        matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": chart.name})
        buffer = io.StringIO()
        draw(chart).savefig(buffer, format="svg", metadata=NO_METADATA)
    svg = buffer.getvalue()
    svg = svg[svg.index("<svg") :].strip()
    name = _id(prefix + chart.name)
    svg = compact(svg, name)
    for colour, variable in VARIABLES.items():
        svg = re.sub(re.escape(colour), f"var({variable})", svg, flags=re.IGNORECASE)
    return _labelled(svg, chart, name)


def image_address(picture: Picture) -> str:
    """The picture as an address that holds all of it: an image is not a part of the page, so
    nothing in it can run, refer to the page or ask for anything."""
    svg = compact(picture.svg, picture.name)
    if not svg.startswith("<svg "):  # no drawing: an image that a browser shows the text for
        return "data:,"
    return f"data:image/svg+xml,{quote(ROOT + svg.removeprefix('<svg'), safe=KEPT_AS_IT_IS)}"


def _id(name: str) -> str:
    """A name that can stand in an attribute and in a reference to it."""
    return re.sub(r"[^A-Za-z0-9_.-]", "_", name)


def _labelled(svg: str, chart: Chart, name: str) -> str:
    """Add the title for screen readers and remove the fixed size."""
    opening, rest = svg.split(">", 1)
    opening = re.sub(r'\s(width|height)="[^"]*"', "", opening)
    return (
        f'{opening} role="img" aria-labelledby="{name}-name">'
        f'<title id="{name}-name">{escape(chart.title)}</title>{rest}'
    )
