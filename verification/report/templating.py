"""The environment of all templates: where they are, and what every page shows alike."""

from __future__ import annotations

import jinja2
from markupsafe import Markup

from verification.exhibits.chart import Chart
from verification.judging.status_words import SYMBOLS, WORDS
from verification.report.columns import alignment, heading
from verification.report.svg import inline_svg

LONG_CELL = 18  # characters; a longer text is broken into lines


def environment() -> jinja2.Environment:
    """With what `records.html` needs."""
    made = jinja2.Environment(
        loader=jinja2.PackageLoader("verification.report"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    made.filters["svg"] = _figure
    made.globals.update(
        symbols=SYMBOLS, words=WORDS, alignment=alignment, heading=heading, LONG_CELL=LONG_CELL
    )
    return made


def _figure(chart: Chart, prefix: str = "") -> Markup:
    return Markup(inline_svg(chart, prefix))  # nosec B704: our drawing, its texts are escaped
