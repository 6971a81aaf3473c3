"""What a study leaves in its directory: page, record, figures and tables."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.stop_signals import stop_signals_held
from contact_results.figures import style
from verification.exhibits.chart import Chart
from verification.report.drawing import draw
from verification.report.files import remove_set_aside, set_aside
from verification.report.study_page import render_study
from verification.running.record import StudyRecord, dump_study
from verification.running.stored_studies import RECORD

PAGE = "index.html"
SET_ASIDE = (RECORD, PAGE)
FIGURES = "figures"
CASES = "cases"
FIGURE_TYPES = ("png", "svg")


def set_aside_study(directory: Path) -> None:
    """Move the page and the record of an earlier study into `earlier`, before the hours of work
    that make the new ones; its figures and tables stay until they are replaced."""
    set_aside(directory, SET_ASIDE)


def write_study(record: StudyRecord, rows: Mapping[str, str], directory: Path) -> None:
    """Write everything, each file whole or not at all; the record comes last. What was set aside
    goes.

    rows  text by name of the file
    """
    with stop_signals_held():
        for chart in record.charts:
            _write_figure(chart, directory / FIGURES)
        texts = {**rows, PAGE: render_study(record), RECORD: dump_study(record)}
        for name, text in texts.items():
            with atomic_file(directory / name) as temporary:
                temporary.write_text(text, encoding="utf-8", newline="\n")
        remove_set_aside(directory, SET_ASIDE)


def _write_figure(chart: Chart, directory: Path) -> None:
    with style.figure_style():
        figure = draw(chart)
        figure.patch.set_visible(True)  # a file has no page behind it
        for kind in FIGURE_TYPES:
            with atomic_file(directory / f"{chart.name}.{kind}") as temporary:
                style.save(figure, temporary)
