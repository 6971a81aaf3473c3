"""The figures that a result on a section calls for."""

from __future__ import annotations

from pathlib import Path

from fem_reference import Result
from verification.run_output import file_names
from verification.run_output.figures.hysteresis_plot import hysteresis_plot, moved
from verification.run_output.figures.loading_plot import loading_plot
from verification.run_output.figures.style import figure_style, save
from verification.run_output.section.radial_plot import slip_plot, traction_plot

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
