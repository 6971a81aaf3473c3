"""The figures that a result on a section calls for."""

from __future__ import annotations

from pathlib import Path

from contact_results.directory import file_names
from contact_results.figures.hysteresis_plot import hysteresis_plot, moved
from contact_results.figures.loading_plot import loading_plot
from contact_results.figures.style import figure_style, save
from contact_results.section.radial_plot import slip_plot, traction_plot
from fem_reference import Result

FEWEST_POINTS = 3  # of a curve; with fewer there is only a line
DIGITS = 9


def write_section_figures(result: Result, directory: Path) -> None:
    """Draw tractions and slip over the radius, and the loops that there are; equal results give
    equal bytes on equal libraries."""
    with figure_style():
        save(traction_plot(result), directory / file_names.PROFILE_FIGURE)
        slips = slip_plot(result)
        if slips is not None:
            save(slips, directory / file_names.SLIP_FIGURE)
        if len(moved(result.increments)) >= FEWEST_POINTS:
            save(hysteresis_plot(result), directory / file_names.HYSTERESIS_FIGURE)
        if _different_approaches(result) >= FEWEST_POINTS:
            save(loading_plot(result), directory / file_names.LOADING_FIGURE)


def _different_approaches(result: Result) -> int:
    """How many there are, apart from round-off."""
    approaches = [increment.approach for increment in result.increments]
    largest = max(map(abs, approaches))
    return len({round(approach / largest, DIGITS) for approach in approaches})
