"""The paper's figures 1 and 2, drawn from the stored report.

`python docs/paper_figures.py` reads reports/full and writes docs/studies/figure_*.svg. Figures 3
and 4 are of a completed study (docs/studies/coated_tractions.md).
"""

from collections.abc import Iterator
from pathlib import Path

import matplotlib

from contact_results.figures import style
from verification.exhibits.chart import Chart
from verification.report.drawing import draw
from verification.running.report_record import load_report

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


if __name__ == "__main__":
    main()
