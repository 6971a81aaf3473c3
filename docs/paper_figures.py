"""The paper's figures 1 to 4, drawn from the stored records.

`python docs/paper_figures.py` reads reports/full and reports/studies/coated-tractions, and
writes docs/studies/figure_*.svg.
"""

from collections.abc import Iterator
from pathlib import Path

import matplotlib

from contact_results.figures import style
from verification.exhibits.chart import Chart
from verification.report.drawing import draw
from verification.running.report_record import load_report
from verification.running.study import StudyRecord

DOCS = Path(__file__).parent
REPORTS = DOCS.parent / "reports"
LOOP = "paper_fretting_loop"
LOOP_CHARTS = ("figure_1_history", "figure_2_loop")


def main() -> None:
    """Write each figure as an SVG file beside the pages of the studies."""
    with style.figure_style():
        matplotlib.rcParams["svg.fonttype"] = "none"  # text stays text, and can be searched
        for name, chart in paper_charts():
            style.save(draw(chart), DOCS / "studies" / f"{name}.svg")


def paper_charts() -> Iterator[tuple[str, Chart]]:
    """Yield the file name and the chart of each figure."""
    report = load_report(REPORTS / "full" / "report.json.xz")
    [loop] = [case for case in report.cases if case.name == LOOP]
    yield from zip(LOOP_CHARTS, loop.charts, strict=False)  # the third chart is not in the paper
    record = REPORTS / "studies" / "coated-tractions" / "study.json"
    coated = StudyRecord.model_validate_json(record.read_text(encoding="utf-8"))
    yield from ((chart.name, chart) for chart in coated.conclusion.charts)


if __name__ == "__main__":
    main()
