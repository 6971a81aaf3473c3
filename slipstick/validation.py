"""Validation uncertainty of the differences between a measured table and a run.

By ASME V&V 20-2009, section 1, the difference E of a computed and a measured number is compared
with its standard uncertainty

    u² = u_num² + u_input² + u_D²

by the numerical error, by uncertain inputs, and of the data. A difference of up to 2 u shows no
error of the model. Stated errors and the closure error of a loop count as two standard deviations.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import hypot

from slipstick.against import ComparedNumber, Comparison, root_mean_square

COVERAGE = 2.0  # standard deviations of a stated uncertainty: 95 % of normally scattered errors


def with_uncertainties(
    compared: Comparison, changed: Sequence[tuple[Comparison, Comparison]], deviation: float
) -> Comparison:
    """Return a comparison whose numbers have the validation uncertainties of their differences.

    compared   comparison of a table with the run
    changed    comparisons with the runs of one deviation less and more of each uncertain input
    deviation  standard deviation of the measured numbers, relative to each
    """
    numbers = []
    for position, each in enumerate(compared.numbers):
        changes = [
            _change(less.numbers[position], more.numbers[position]) for less, more in changed
        ]
        uncertainty = None
        if each.error is not None:
            by_data = hypot(each.of_table or 0.0, COVERAGE * deviation * each.measured)
            by_inputs = COVERAGE * hypot(*changes)
            uncertainty = hypot(each.error, by_inputs, by_data)
        numbers.append(replace(each, uncertainty=uncertainty))
    return replace(compared, numbers=tuple(numbers))


def _change(less: ComparedNumber, more: ComparedNumber) -> float:
    one, other = less.differences, more.differences
    if one is None or other is None or len(one) != len(other):
        return (more.computed - less.computed) / 2
    return root_mean_square(other - one) / 2
