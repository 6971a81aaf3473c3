"""The page: one HTML file that needs nothing else, neither network nor scripts."""

from __future__ import annotations

from functools import cache

import jinja2
from markupsafe import Markup

from verification.cases.chart import Chart
from verification.cases.outcome import Status, Verdict
from verification.report.numbers import clearance_text, order_text, plain, value_text
from verification.report.record import Report
from verification.report.svg import inline_svg

SYMBOLS = {Status.PASS: "✓", Status.FAIL: "✗", Status.INCONCLUSIVE: "?"}
WORDS = {Status.PASS: "pass", Status.FAIL: "FAIL", Status.INCONCLUSIVE: "inconclusive"}


def render_page(report: Report) -> str:
    """The report as HTML; equal records give equal text."""
    return _environment().get_template("page.html").render(report=report)


@cache
def _environment() -> jinja2.Environment:
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("verification.report"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters.update(
        value=value_text, plain=plain, clearance=clearance_text, order=order_text, svg=_figure
    )
    environment.globals.update(
        symbols=SYMBOLS, words=WORDS, Status=Status, bar=_bar, figures=_headline_figures
    )
    return environment


def _figure(chart: Chart) -> Markup:
    return Markup(inline_svg(chart))  # our own drawing, escaped where it holds text


def _bar(verdict: Verdict) -> float:
    """Length of the bar of a verdict in per cent; full from the allowed error on."""
    part = verdict.clearance
    return 100.0 if part is None else round(min(100.0, 100 * part), 1)


def _headline_figures(report: Report) -> list[Chart]:
    """The paper's figures, which have a section of their own."""
    return [c for case in report.cases for c in case.charts if c.name.startswith("paper_figure")]
