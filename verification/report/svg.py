"""Figures as SVG inside a page: its colours, its text, no clash of names."""

from __future__ import annotations

import io
import re
from html import escape

import matplotlib

from verification.cases.chart import Chart
from verification.report.drawing import INK, REFERENCE_COLOUR, draw
from verification.run_output.figures import style

# Colours of a figure become variables of the page, which has a light and a dark value of each.
VARIABLES = {
    INK: "--ink",
    REFERENCE_COLOUR: "--reference",
    **{colour: f"--series-{n}" for n, colour in enumerate(style.LINE_COLOURS, 1)},
}
NO_METADATA = {"Date": None, "Creator": None, "Format": None, "Type": None}


def inline_svg(chart: Chart) -> str:
    """The chart as an SVG element; equal charts give equal text."""
    with style.figure_style():
        # Text stays text: it can be searched, read out, and takes the page's colour.
        matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": chart.name})
        buffer = io.StringIO()
        draw(chart).savefig(buffer, format="svg", metadata=NO_METADATA)
    svg = buffer.getvalue()
    svg = svg[svg.index("<svg") :].strip()
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = _with_own_names(svg, chart.name)
    for colour, variable in VARIABLES.items():
        svg = re.sub(re.escape(colour), f"var({variable})", svg, flags=re.IGNORECASE)
    return _labelled(svg, chart)


def _with_own_names(svg: str, name: str) -> str:
    """Prefix every id, so that two figures of a page cannot refer to each other's parts."""
    svg = re.sub(r'\bid="', f'id="{name}-', svg)
    svg = re.sub(r'(xlink:href|href)="#', rf'\1="#{name}-', svg)
    return svg.replace("url(#", f"url(#{name}-")


def _labelled(svg: str, chart: Chart) -> str:
    """A name for those who do not see the figure, and no fixed size."""
    opening, rest = svg.split(">", 1)
    opening = re.sub(r'\s(width|height)="[^"]*"', "", opening)
    title_id = f"{chart.name}-name"
    return (
        f'{opening} role="img" aria-labelledby="{title_id}">'
        f'<title id="{title_id}">{escape(chart.title)}. {escape(chart.caption)}</title>{rest}'
    )
