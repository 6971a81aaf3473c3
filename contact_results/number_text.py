"""Texts of numbers: a suitable unit, and the digits that the stated error permits."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from math import floor, log10
from typing import NamedTuple

from contact_scene.quantities.stated_error import (
    ErrorStatus,
    StatedError,
)

DIGITS = 5
ERROR_DIGITS = 2
MAX_DECIMALS = 12
MAX_STEPS = 4  # listed with a reason


class Uncertainty(NamedTuple):
    """Stated error of one number.

    size       error in the SI unit of the number; None if the error is unknown
    converged  False if the error estimate is unreliable
    """

    size: float | None
    converged: bool


def uncertainty(stated: StatedError | None, axis: str = "x") -> Uncertainty | None:
    """Return the stated error of a scalar, or of one component of a vector.

    stated  stated error of the scalar or the vector; None if there is none
    axis    component of a vector, "x" or "y"; ignored for a scalar

    Returns None if there is no stated error, or if the number is exact.
    """
    if stated is None or stated.status is ErrorStatus.EXACT:
        return None
    size = stated.error
    if isinstance(size, tuple):
        size = size["xy".index(axis)]
    return Uncertainty(size, stated.status is ErrorStatus.ESTIMATED)


def number_text(value: float | None, error: Uncertainty | None, unit: float) -> str:
    """Return the text of a number in a unit, with its stated error.

    The error has two digits, and the number the same decimals. A question mark follows an error
    that has not converged.

    value  number in its SI unit; None gives a dash
    error  stated error in the SI unit; None gives the number alone
    unit   SI value of the unit of the text, such as 1e-3 for mm
    """
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


def doubt_texts(errors: Sequence[Mapping[str, StatedError]], names: Collection[str]) -> list[str]:
    """Return one line for each reason why stated errors have not converged.

    A line lists the numbers and the load steps. The reason of a number is that of its last load
    step with a question mark.

    errors  stated errors of every load step, by name
    names   names of the shown numbers
    """
    steps: dict[str, list[int]] = {}
    reasons: dict[str, str] = {}
    for number, of_step in enumerate(errors, start=1):
        for name in names:
            error = of_step.get(name)
            if error is not None and error.reason:
                steps.setdefault(name, []).append(number)
                reasons[name] = error.reason
    groups: dict[tuple[str, str], list[str]] = {}
    for name, reason in reasons.items():
        shown = ", ".join(map(str, steps[name][-MAX_STEPS:]))
        more = "…, " if len(steps[name]) > MAX_STEPS else ""
        groups.setdefault((f"{more}{shown}", reason), []).append(name.replace("_", " "))
    return [f"? {', '.join(of)} (step {shown}): {reason}" for (shown, reason), of in groups.items()]


def unit_group(name: str) -> str:
    """Return the name of the group of quantities that share a unit in a table.

    All names that end in `_radius` or `half_width` form a group. Other names form a group each.
    """
    return next((of for of in ("radius", "half_width") if name.endswith(of)), name)
