"""What a study leaves in its directory: page, record, figures and tables."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path

import jinja2
from markupsafe import Markup

from verification.cases.chart import Chart
from verification.report.columns import alignment
from verification.report.drawing import draw
from verification.report.files import remove_set_aside, set_aside
from verification.report.page import SYMBOLS, WORDS
from verification.report.svg import inline_svg
from verification.run_output.atomic_file import atomic_file
from verification.run_output.figures import style
from verification.run_output.stop_signals import stop_signals_held
from verification.studies.running.record import StudyRecord, dump_study

PAGE = "index.html"
RECORD = "study.json"
SET_ASIDE = (RECORD, PAGE)
FIGURES = "figures"
CASES = "cases"
FIGURE_TYPES = ("png", "svg")


def set_aside_study(directory: Path) -> None:
    """Move the page and the record of an earlier study into `earlier`, before the hours of work
    that make the new ones; its figures and tables stay until they are replaced."""
    set_aside(directory, SET_ASIDE)


def write_study(record: StudyRecord, exports: Mapping[str, str], directory: Path) -> None:
    """Write everything, each file whole or not at all; the record comes last. What was set aside
    goes."""
    with stop_signals_held():
        for chart in record.charts:
            _write_figure(chart, directory / FIGURES)
        texts = {**exports, PAGE: render_study(record), RECORD: dump_study(record)}
        for name, text in texts.items():
            with atomic_file(directory / name) as temporary:
                temporary.write_text(text, encoding="utf-8", newline="\n")
        remove_set_aside(directory, SET_ASIDE)


def render_study(record: StudyRecord) -> str:
    """The page as HTML; equal records give equal text."""
    return _environment().get_template("study.html").render(study=record)


def stored_studies(
    directory: Path, left_out: Callable[[str], None] | None = None
) -> tuple[StudyRecord, ...]:
    """The records of all studies that have left theirs in a folder of this directory, by name.

    left_out  is told of a record that is broken or of another version; without it that raises
              ValueError, naming the file
    """
    records = []
    for path in sorted(directory.glob(f"*/{RECORD}")):
        try:
            records.append(StudyRecord.model_validate_json(path.read_bytes()))
        except ValueError as error:
            problem = f"{path} is no record of a study that can be read"
            if left_out is None:
                raise ValueError(problem) from error
            left_out(problem)
    return tuple(sorted(records, key=lambda record: record.name))


def _write_figure(chart: Chart, directory: Path) -> None:
    with style.figure_style():
        figure = draw(chart)
        figure.patch.set_visible(True)  # a file has no page behind it
        for kind in FIGURE_TYPES:
            with atomic_file(directory / f"{chart.name}.{kind}") as temporary:
                style.save(figure, temporary)


@cache
def _environment() -> jinja2.Environment:
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("verification.report"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["svg"] = lambda chart: Markup(inline_svg(chart))
    environment.globals.update(symbols=SYMBOLS, words=WORDS, alignment=alignment)
    return environment
