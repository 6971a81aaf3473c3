"""The figures a scene calls for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from contact_results.cycles import FrettingCycle
from contact_results.directory import file_names
from contact_results.figures.load_plot import hysteresis_plot, loading_plot, moved
from contact_results.figures.map_panels import Above, RingsAbove
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
from contact_results.figures.shown_steps import vectors
from contact_results.figures.style import CAPTION_SIZE, DOTS_PER_INCH, figure_style, save
from contact_results.natural_sizes import SI, Units, without_round_off
from contact_results.number_text import number_text, uncertainty
from contact_results.surface import Cells, Rings, surface_of
from contact_scene.engineering_units import engineering_unit
from contact_scene.increment import SCALARS
from contact_scene.stated_error import StatedError

if TYPE_CHECKING:
    from contact_results.surface import Result

LINE = 0.14  # inches
PER_INCH = 16  # letters
NARROW = 5.0  # inches; a line of two numbers is as wide
# The scalars that are read off each figure.
SHOWN: Mapping[str, tuple[str, ...]] = {
    file_names.PROFILE_FIGURE: ("peak_pressure", "contact_radius"),
    file_names.PRESSURE_FIGURE: ("peak_pressure", "contact_radius"),
    file_names.SHEAR_FIGURE: ("stick_radius",),
    file_names.STICK_SLIP_FIGURE: ("contact_radius", "stick_radius"),
    file_names.SLIP_MAP_FIGURE: ("stick_radius",),
    file_names.SLIP_FIGURE: ("stick_radius",),
    file_names.DISSIPATION_FIGURE: ("dissipated_energy",),
    file_names.FRETTING_FIGURE: ("dissipated_energy",),
    file_names.HYSTERESIS_FIGURE: ("tangential_shift", "dissipated_energy"),
    file_names.OVERVIEW_FIGURE: (),
    file_names.LOADING_FIGURE: ("approach", "contact_radius"),
}
FEWEST_POINTS = 3  # of a curve; with fewer there is only a line
DIGITS = 9


def write_figures(
    result: Result,
    cycles: Sequence[FrettingCycle],
    directory: Path,
    errors: Mapping[str, StatedError] | None = None,
    units: Units = SI,
    *,
    everything: bool = False,
) -> None:
    """Draw the overview, or all that the scene calls for and the last cycle if there is one.

    Equal results give equal bytes on equal libraries.

    errors      of the last step, for the captions
    units       of the axes
    everything  draw all figures, not the overview alone
    """
    with figure_style():
        for name, figure in _figures_called_for(result, cycles, errors, units):
            add_caption(figure, name, result, errors, units.note)
            dots = DOTS_PER_INCH if name != file_names.OVERVIEW_FIGURE else OF_OVERVIEW
            save(figure, directory / name, dots)
            # Its parts refer to one another: the next would be drawn before they have gone.
            figure.clear()
            if not everything:
                break


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


def add_caption(
    figure: Figure,
    name: str,
    result: Result,
    errors: Mapping[str, StatedError] | None,
    note: str = "",
) -> None:
    """Write below a figure the numbers at the end of the history that it shows.

    errors  of the last step; None where they were left out
    note    a further line
    """
    end = result.steps[-1]
    texts = [
        _text(scalar, getattr(end, scalar), (errors or {}).get(scalar), result)
        for scalar in SHOWN[name]
        if getattr(end, scalar) is not None
    ]
    lines = []
    if texts:
        unstated = "" if errors is not None else "; errors not stated"
        between = ",\n" if figure.get_figwidth() < NARROW else ", "
        lines = f"at the end: {between.join(texts)}{unstated}".split("\n")
    lines += wrap(note, int(PER_INCH * figure.get_figwidth()))
    if lines:
        figure.set_figheight(figure.get_figheight() + LINE * (len(lines) + 1))
        figure.supxlabel("\n".join(lines), fontsize=CAPTION_SIZE, x=0.01, ha="left")


def _text(name: str, value: Any, error: StatedError | None, result: Result) -> str:
    """A number with its name, error and unit; of a vector the larger component."""
    values = np.atleast_1d(value)
    k = int(np.argmax(np.abs(values)))
    shown = without_round_off(float(values[k]), result.steps, SCALARS[name].unit)
    unit = engineering_unit(abs(shown), SCALARS[name].unit)
    axis = "xy"[k]
    of_vector = f" {axis}" if len(values) > 1 else ""
    number = number_text(shown, uncertainty(error, axis), unit.size)
    return f"{name.replace('_', ' ')}{of_vector} {number} {unit.name}"
