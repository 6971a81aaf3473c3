"""The figures a scene calls for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from contact_results.cycles import FrettingCycle
from contact_results.directory import file_names
from contact_results.figures.caption import add_caption
from contact_results.figures.load_plot import hysteresis_plot, loading_plot, moved
from contact_results.figures.map_panels import Above
from contact_results.figures.maps import (
    dissipating,
    dissipation_map,
    fretting_map,
    pressure_map,
    shear_map,
    slip_map,
    stick_slip_map,
)
from contact_results.figures.overview import DOTS_PER_INCH as OF_OVERVIEW
from contact_results.figures.overview import overview
from contact_results.figures.profile_plot import profile_plot, slip_plot
from contact_results.figures.rings_above import RingsAbove
from contact_results.figures.shown_steps import vectors
from contact_results.figures.style import DOTS_PER_INCH, figure_style, save
from contact_results.natural_sizes import SI, Units
from contact_results.surface import Cells, Rings, surface_of
from contact_scene.stated_error import StatedError

if TYPE_CHECKING:
    from contact_results.surface import Result

FEWEST_POINTS = 3  # of a curve; with fewer there is only a line
DIGITS = 9


def write_figures(
    result: Result,
    cycles: Sequence[FrettingCycle],
    directory: Path,
    errors: Mapping[str, StatedError] | None = None,
    units: Units = SI,
) -> None:
    """Draw what the scene calls for, and the last cycle if there is one; equal results give equal
    bytes on equal libraries.

    errors  of the last step, for the captions
    units   of the axes
    """
    with figure_style():
        for name, figure in _figures_called_for(result, cycles, errors, units):
            add_caption(figure, name, result, errors, units.note)
            dots = DOTS_PER_INCH if name != file_names.OVERVIEW_FIGURE else OF_OVERVIEW
            save(figure, directory / name, dots)
            # Its parts refer to one another: the next would be drawn before they have gone.
            figure.clear()


def _figures_called_for(
    result: Result,
    cycles: Sequence[FrettingCycle],
    errors: Mapping[str, StatedError] | None,
    units: Units,
) -> Iterator[tuple[str, Figure]]:
    surface = surface_of(result)
    above = seen_from_above(result)
    yield file_names.OVERVIEW_FIGURE, overview(result, above, errors, units)
    yield file_names.PROFILE_FIGURE, profile_plot(result, surface, units)
    if (slips := slip_plot(result, surface, units)) is not None:
        yield file_names.SLIP_FIGURE, slips
    if result.steps[-1].in_stick is not None:
        yield file_names.STICK_SLIP_FIGURE, stick_slip_map(result, above, units)
    if vectors(above, result.steps, "slip"):
        yield file_names.SLIP_MAP_FIGURE, slip_map(result, above, units)
    if isinstance(surface, Cells):
        yield from _maps(result, surface, cycles, units)
    if moved(result.increments) >= FEWEST_POINTS:
        yield file_names.HYSTERESIS_FIGURE, hysteresis_plot(result, units)
    if _different_approaches(result) >= FEWEST_POINTS:
        yield file_names.LOADING_FIGURE, loading_plot(result, units)


def _maps(
    result: Result, cells: Cells, cycles: Sequence[FrettingCycle], units: Units
) -> Iterator[tuple[str, Figure]]:
    yield file_names.PRESSURE_FIGURE, pressure_map(result, cells, units)
    if vectors(cells, result.steps, "shear"):
        yield file_names.SHEAR_FIGURE, shear_map(result, cells, units)
    if dissipating(result.steps, cells):
        yield file_names.DISSIPATION_FIGURE, dissipation_map(result, cells, units)
    if cycles:
        yield file_names.FRETTING_FIGURE, fretting_map(result, cells, cycles[-1], units)


def seen_from_above(result: Result) -> Above:
    """The cells of a result, or those through which a map looks at its rings."""
    surface = surface_of(result)
    if isinstance(surface, Cells):
        return surface
    assert isinstance(surface, Rings)
    return RingsAbove.around_contact(result, surface)


def _different_approaches(result: Result) -> int:
    """How many there are, apart from round-off."""
    approaches = [increment.approach for increment in result.increments]
    largest = max(map(abs, approaches))
    return len({round(approach / largest, DIGITS) for approach in approaches})
