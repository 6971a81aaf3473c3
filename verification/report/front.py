"""The charts that the front shows, each once more where it belongs."""

from __future__ import annotations

from verification.exhibits.chart import Chart
from verification.report.prices import telling_chart
from verification.report.sections import study_of
from verification.running.report_record import Report

LOOP = "fretting_hysteresis"  # against a closed form


def front_charts(report: Report) -> tuple[Chart, ...]:
    """A loop, and what accuracy costs; those that there are."""
    of_cases = (chart for case in report.cases for chart in case.charts)
    loop = next((chart for chart in of_cases if chart.name == LOOP), None)
    return tuple(chart for chart in (loop, _cost(report)) if chart is not None)


def _cost(report: Report) -> Chart | None:
    """By the clock if it was looked at."""
    record = study_of(report, "work-precision")
    return None if record is None else telling_chart(record.provenance.timed or record.conclusion)
