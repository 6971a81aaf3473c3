"""The numbers that a figure is about, with their errors, in a line below it."""

from __future__ import annotations

from collections.abc import Mapping
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from contact_results.directory import file_names
from contact_results.figures import style
from contact_results.natural_sizes import without_round_off
from contact_results.number_text import number_text, uncertainty
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
        figure.supxlabel("\n".join(lines), fontsize=style.CAPTION_SIZE, x=0.01, ha="left")


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
