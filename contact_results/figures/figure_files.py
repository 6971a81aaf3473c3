"""Writer of the image files of a result: overview, profiles, maps."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from matplotlib.figure import Figure

from contact_results.directory.file_names import OVERVIEW_FIGURE
from contact_results.figures.map_panels import MapFrame
from contact_results.figures.maps import FIELDS, field_map, fretting_map, stick_slip_map
from contact_results.figures.overview import DOTS_PER_INCH as OF_OVERVIEW
from contact_results.figures.overview import overview
from contact_results.figures.profile_plot import profile_plot
from contact_results.figures.style import DOTS_PER_INCH, figure_style, save
from contact_results.result_report import ResultReport
from contact_results.surface import Cells


def write_figures(report: ResultReport, directory: Path, *, everything: bool = False) -> None:
    """Write the overview, or all figures of a result and of its last load cycle.

    Equal results give equal bytes with equal libraries.

    directory   output directory
    everything  write all figures, not only the overview
    """
    with figure_style():
        for name, figure in _draw_figures(report):
            dots = DOTS_PER_INCH if name != OVERVIEW_FIGURE else OF_OVERVIEW
            save(figure, directory / name, dots)
            if not everything:
                break
            # Reference cycles between the artists keep a figure in memory until it is cleared.
            figure.clear()


def _draw_figures(report: ResultReport) -> Iterator[tuple[str, Figure]]:
    """Yield file name and figure of each figure of a result, with the overview first.

    Figures of fields that are zero or missing are omitted. A line contact has no maps.
    """
    frame = MapFrame.around_contact(report)
    yield OVERVIEW_FIGURE, overview(report, frame)
    yield "profiles.png", profile_plot(report)
    if frame is None:
        return
    for field in FIELDS:
        if (figure := field_map(report, frame, field)) is not None:
            yield f"{field}.png", figure
    if report.steps[-1].in_stick is not None:
        yield "stick_slip.png", stick_slip_map(report, frame)
    if report.cycles and isinstance(frame.cells, Cells):
        yield "fretting.png", fretting_map(frame, report.cycles[-1])
