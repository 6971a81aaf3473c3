"""The charts that the front shows, each once more where it belongs."""

from __future__ import annotations

from collections.abc import Iterable

from verification.exhibits.chart import Chart
from verification.report.prices import telling_chart
from verification.report.sections import study_of
from verification.running.report_record import Report

LOOP = "fretting_hysteresis"  # against a closed form
COVERAGE = "wrong_over_stated"


def front_charts(report: Report) -> tuple[Chart, ...]:
    """A loop, what accuracy costs, and whether stated errors hold; those that there are."""
    of_cases = (chart for case in report.cases for chart in case.charts)
    stated = study_of(report, "error-coverage")
    of_errors = () if stated is None else stated.conclusion.charts
    found = (_named(LOOP, of_cases), _cost(report), _named(COVERAGE, of_errors))
    return tuple(chart for chart in found if chart is not None)


def _named(name: str, charts: Iterable[Chart]) -> Chart | None:
    return next((chart for chart in charts if chart.name == name), None)


def _cost(report: Report) -> Chart | None:
    """By the clock if it was looked at."""
    record = study_of(report, "work-precision")
    return None if record is None else telling_chart(record.provenance.timed or record.conclusion)
