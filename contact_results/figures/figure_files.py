"""The figures a scene calls for."""

from collections.abc import Callable, Sequence
from pathlib import Path

from matplotlib.figure import Figure

from contact_results.cycles import FrettingCycle
from contact_results.directory import file_names
from contact_results.figures.dissipation_map import dissipating, dissipation_map
from contact_results.figures.fretting_map import fretting_map
from contact_results.figures.hysteresis_plot import hysteresis_plot, moved
from contact_results.figures.loading_plot import loading_plot
from contact_results.figures.pressure_map import pressure_map
from contact_results.figures.profile_plot import profile_plot
from contact_results.figures.shear_map import shear_map
from contact_results.figures.shown_steps import sheared
from contact_results.figures.stick_slip_map import stick_slip_map
from contact_results.figures.style import figure_style, save
from semi_analytical import Result

FEWEST_POINTS = 3  # of a curve; with fewer there is only a line


def write_figures(result: Result, cycles: Sequence[FrettingCycle], directory: Path) -> None:
    """Draw what the scene calls for, and the last cycle if there is one; equal results give equal
    bytes on equal libraries."""
    with figure_style():
        for name, draw in _figures_called_for(result).items():
            save(draw(result), directory / name)
        if cycles:
            save(fretting_map(result, cycles[-1]), directory / file_names.FRETTING_FIGURE)


def _figures_called_for(result: Result) -> dict[str, Callable[[Result], Figure]]:
    figures: dict[str, Callable[[Result], Figure]] = {
        file_names.PRESSURE_FIGURE: pressure_map,
        file_names.PROFILE_FIGURE: profile_plot,
    }
    if sheared(result.steps):
        figures[file_names.SHEAR_FIGURE] = shear_map
        figures[file_names.STICK_SLIP_FIGURE] = stick_slip_map
    if dissipating(result.steps):
        figures[file_names.DISSIPATION_FIGURE] = dissipation_map
    if len(moved(result.increments)) >= FEWEST_POINTS:
        figures[file_names.HYSTERESIS_FIGURE] = hysteresis_plot
    if len({increment.approach for increment in result.increments}) >= FEWEST_POINTS:
        figures[file_names.LOADING_FIGURE] = loading_plot
    return figures
