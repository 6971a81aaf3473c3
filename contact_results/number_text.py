"""Texts of numbers: a suitable unit, and the digits that the stated error permits."""

from __future__ import annotations

from math import floor, log10
from typing import NamedTuple

from contact_scene.quantities.stated_error import (
    ErrorStatus,
    StatedError,
)

DIGITS = 5
ERROR_DIGITS = 2
MAX_DECIMALS = 12


class Uncertainty(NamedTuple):
    """Stated error of one number; size None if the error is unknown."""

    size: float | None
    converged: bool


def uncertainty(stated: StatedError | None, axis: str = "x") -> Uncertainty | None:
    """Return the stated error of a scalar or of a vector component; None if absent or exact."""
    if stated is None or stated.status is ErrorStatus.EXACT:
        return None
    size = stated.error
    if isinstance(size, tuple):
        size = size["xy".index(axis)]
    return Uncertainty(size, stated.status is ErrorStatus.ESTIMATED)


def number_text(value: float | None, error: Uncertainty | None, unit: float) -> str:
    """Return the text of a number in a unit, with its error; `?` marks an unconverged error."""
    if value is None:
        return "–"
    if error is None:
        return f"{value / unit:.{DIGITS}g}"
    doubt = "" if error.converged else " ?"
    if error.size is None:
        return f"{value / unit:.{DIGITS}g}{doubt}"
    number, size = value / unit, error.size / unit
    # Two digits of the error, and the number to the same decimals (JCGM 100:2008, 7.2.6).
    decimals = ERROR_DIGITS - 1 - floor(log10(size)) if size else DIGITS
    if round(number, decimals) == 0:
        return f"0 ± {size:.{ERROR_DIGITS}g}{doubt}"
    if decimals > MAX_DECIMALS:
        return f"{number:.{MAX_DECIMALS}f} ± {size:.0e}{doubt}"
    decimals = max(0, decimals)
    return f"{number:.{decimals}f} ± {size:.{decimals}f}{doubt}"


def measured_like(name: str) -> str:
    """Return the name of the group of quantities that share a unit in a table: all radii."""
    return "radius" if name.endswith("_radius") else name
