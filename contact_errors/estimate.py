"""Errors of all numbers of a result from those of its companions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from contact_errors.rules import Rule
from contact_errors.values import Values
from contact_scene.stated_error import EXACT, Amount, ErrorStatus, Part, StatedError

Numbers: TypeAlias = NDArray[np.float64]

# Differences beyond this part of the largest value say that the levels contradict one another.
CONTRADICTION = 0.5
# Residuals of the tolerance leave errors of about this many times as much.
PER_TOLERANCE = 10.0
# A component below this part of its vector is round-off of a zero.
ROUND_OFF = 1e-9


def differences(values: Sequence[Values], companion: Sequence[Values]) -> tuple[Values, ...]:
    """|value - the companion's| for all that both have."""
    return tuple(
        {name: np.abs(value - there[name]) for name, value in here.items() if name in there}
        for here, there in zip(values, companion, strict=True)
    )


def largest_so_far(values: Sequence[Values]) -> tuple[Values, ...]:
    """Of each number the largest size in the history up to every step; the components of a vector
    that are not round-off of a zero have one in common."""
    seen: dict[str, Numbers] = {}
    found = []
    for step in values:
        for name, value in step.items():
            size = np.abs(value)
            size[size > ROUND_OFF * np.max(size)] = np.max(size)
            seen[name] = np.maximum(seen.get(name, 0.0), size)
        found.append(dict(seen))
    return tuple(found)


def by_cells(rule: Rule, difference: Numbers, ratio: float, scatter: Numbers) -> Numbers:
    """Error of a number by the cells.

    ratio    spacing of the companion over that of the run
    scatter  the envelope, in the unit of the number
    """
    richardson = difference / (ratio**rule.order - 1)
    mean = (rule.weight * scatter**2 + richardson**2) / (rule.weight + 1)
    return np.maximum(rule.factor * np.sqrt(mean), rule.least * scatter)


def by_increments(rule: Rule, difference: Numbers, scatter: Numbers) -> Numbers:
    """Error of a number by the increments."""
    return rule.path_factor * np.hypot(difference, rule.path_scatter * scatter)


def charged(rule: Rule, charge: Numbers, difference: Numbers | None) -> Numbers:
    """Error of a number by the increments, which tell themselves what they leave open of it.

    charge      what they tell
    difference  by other increments; None where they gave no result
    """
    if difference is None:
        return charge
    return np.minimum(charge, np.hypot(rule.path_factor * difference, rule.charge * charge))


def unsolved(tolerance: float, largest: Numbers, size: float) -> Numbers:
    """What residuals of the tolerance leave.

    size  of the contact, in the unit of the number
    """
    return np.asarray(PER_TOLERANCE * tolerance * np.maximum(largest, size))


def contradicts(difference: Numbers, largest: Numbers, negligible: float | Numbers) -> bool:
    """Whether two levels are too far apart to say anything of a third."""
    return bool(np.any(difference > CONTRADICTION * largest + negligible))


def stated(parts: Mapping[Part, Numbers], converged: bool) -> StatedError:
    """Parts added up."""
    status = ErrorStatus.ESTIMATED if converged else ErrorStatus.NOT_CONVERGED
    total = np.sum(list(parts.values()), axis=0)
    amounts = {part: _amount(size) for part, size in parts.items()}
    return StatedError(error=_amount(total), parts=amounts, status=status)


UNKNOWN = StatedError(error=None, parts={}, status=ErrorStatus.NOT_CONVERGED)


def unknown(values: Values, exact: frozenset[str]) -> dict[str, StatedError]:
    """Where nothing can be said of any number but those that the load prescribes."""
    return {name: EXACT if name in exact else UNKNOWN for name in values}


def _amount(size: Numbers) -> Amount:
    if len(size) == 1:
        return float(size[0])
    return float(size[0]), float(size[1])
