"""Charts of a report as compact SVG elements of an HTML page.

The elements use the colours of the page, have searchable text, and ids that are unique in the page.
"""

from __future__ import annotations

import hashlib
import io
import re
from html import escape
from urllib.parse import quote

import matplotlib

from contact_results.figures import style
from verification.exhibits.chart import Chart, Picture
from verification.report.drawing import GRID_COLOUR, INK, REFERENCE_COLOUR, draw

# Colours of a diagram become variables of the page, which has a light and a dark value of each.
VARIABLES = {
    INK: "--ink",
    REFERENCE_COLOUR: "--reference",
    GRID_COLOUR: "--line",
    **{colour: f"--series-{n}" for n, colour in enumerate(style.LINE_COLOURS, 1)},
}
ROOT = '<svg xmlns="http://www.w3.org/2000/svg" font-family="DejaVu Sans,Verdana,sans-serif"'
KEPT_AS_IT_IS = " =:/;,+()!*@$?[]"  # of an address within quotes
NO_METADATA = {"Date": None, "Creator": None, "Format": None, "Type": None}
NUMBER = re.compile(r"-?\d+\.\d+")
DIGITS = 6  # of the digest that stands for the name of a diagram
DECIMALS = 1  # of a point, 1/72 inch
FINE_DECIMALS, SMALL = 2, 10.0  # for the shapes of marks
REFERENCE = re.compile(r'(?:xlink:href="#|url\(#)([^")]*)')


def inline_svg(chart: Chart, prefix: str = "") -> str:
    """Draw a chart of a report and return its SVG element for an HTML page; equal charts give equal
    text.

    prefix  prefix of the ids, for a chart that a page shows twice
    """
    with style.figure_style():
        # Text stays text: it can be searched, read out, and takes the page's colour.
        matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": chart.name})
        buffer = io.StringIO()
        draw(chart).savefig(buffer, format="svg", metadata=NO_METADATA)
    svg = buffer.getvalue()
    name = re.sub(r"[^A-Za-z0-9_.-]", "_", prefix + chart.name)
    svg = compact(svg[svg.index("<svg") :].strip(), name)
    for colour, variable in VARIABLES.items():
        svg = re.sub(re.escape(colour), f"var({variable})", svg, flags=re.IGNORECASE)
    opening, rest = svg.split(">", 1)
    opening = re.sub(r'\s(width|height)="[^"]*"', "", opening)
    title = f'<title id="{name}-name">{escape(chart.title)}</title>'
    return f'{opening} role="img" aria-labelledby="{name}-name">{title}{rest}'


def image_address(picture: Picture) -> str:
    """Return a data address that contains a picture as an SVG image.

    A page shows the picture as an image, so that nothing in the picture can run, refer to the page
    or load data.
    """
    svg = compact(picture.svg, picture.name)
    if not svg.startswith("<svg "):  # no drawing: a browser shows the text of the image
        return "data:,"
    return f"data:image/svg+xml,{quote(ROOT + svg.removeprefix('<svg'), safe=KEPT_AS_IT_IS)}"


def compact(svg: str, name: str) -> str:
    """Remove the parts of the SVG text of matplotlib that an HTML page does not need.

    name  name that is unique in the page, so that diagrams cannot refer to each other's elements
    """
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r"<!--.*?-->|<style.*?</style>", "", svg, flags=re.DOTALL)
    svg = _with_own_ids(svg, name)
    svg = re.sub(r' style="([^"]*)"', _short_style, svg)
    svg = re.sub(r' transform="rotate\(-?0 [^"]*\)"', "", svg)
    svg = re.sub(r' (d|x|y|width|height|points|transform|viewBox)="([^"]*)"', _short_numbers, svg)
    svg = re.sub(r' (?:xmlns(?::xlink)?|version)="[^"]*"', "", svg.replace("xlink:href", "href"))
    return re.sub(r"> <", "><", re.sub(r"\s*\n\s*", " ", svg))


def _with_own_ids(svg: str, name: str) -> str:
    """Rename those ids in the SVG text of a diagram that are referred to, and remove the other ids.

    The new ids contain a digest of `name`, so that several diagrams on a page do not share ids.
    """
    wanted = set(REFERENCE.findall(svg))
    kept = [i for i in re.findall(r'\bid="([^"]*)"', svg) if i in wanted]
    short = hashlib.sha256(name.encode()).hexdigest()[:DIGITS]
    new = {old: f"f{short}.{number}" for number, old in enumerate(dict.fromkeys(kept))}
    svg = re.sub(r' id="([^"]*)"', lambda m: f' id="{new[m[1]]}"' if m[1] in new else "", svg)
    return re.sub(r'(xlink:href="#|url\(#)([^")]*)', lambda m: m[1] + new[m[2]], svg)


def _short_style(match: re.Match[str]) -> str:
    """Return the style attribute of an SVG element without spaces and without the font family.

    The page sets the font family.

    match  match of the attribute in the SVG text
    """
    parts = [part.strip().replace(": ", ":") for part in match[1].split(";")]
    return f' style="{";".join(p for p in parts if p and not p.startswith("font-family"))}"'


def _short_numbers(match: re.Match[str]) -> str:
    text = NUMBER.sub(lambda number: _short_number(float(number[0])), match[2])
    text = re.sub(r"\s+", " ", text).strip()
    return f' {match[1]}="{re.sub(r" ?([MLQCz]) ?", lambda m: m[1], text)}"'


def _short_number(value: float) -> str:
    decimals = FINE_DECIMALS if abs(value) < SMALL else DECIMALS
    return f"{value:.{decimals}f}".rstrip("0").rstrip(".")
