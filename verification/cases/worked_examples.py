"""Verification case of the verification itself: statistics and printed numbers against hand
computation.

All examples have refinement levels h = 1, 2, 4 and an error a + c h, plus a deviation (1, -6, 8) ε.
The deviation is orthogonal to the line that is fitted with weights 1/h, as 1 - 6/4 + 8/16 = 1 - 6/2
+ 8/4 = 0. Its weighted sum of squares is (1 + 9 + 4) ε².
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import hypot, log, sqrt
from typing import Any

import numpy as np

from verification.convergence.observed_order import error_line, observed_order, richardson
from verification.judging.case import Case, Derived, Level, Quantity, Required
from verification.judging.outcome import Verdict, failure_text, uncertainty_text
from verification.judging.verdicts import judge_quantity
from verification.problems.problem import Reference, ReferenceKind, closed_form

LEVELS = (1.0, 2.0, 4.0)
BESIDE = (1.0, -6.0, 8.0)
LIMIT = 5.0
# u_num = √(c² + s²) = ½ by s² = 14 ε² on 3 - 2 levels; with u_ref it is 13/10, and U twice that.
SLOPE, SCATTER, OF_REFERENCE = 0.3, 0.4, 1.2
EPSILON = SCATTER / sqrt(14)
U = 2.6
# Student's t with one degree of freedom: quantiles of 97.5 % (two-sided 95 %) and 95 %.
STUDENT, ONE_SIDED = 1 / np.tan(np.pi / 40), 1 / np.tan(np.pi / 20)
HAND = "worked by hand"
TO_ROUNDING = Required(1e-9, "the same numbers to rounding")
PRINTED = Required(0.05, "two digits are printed")


@dataclass(frozen=True)
class _Rung:
    """Hold one refinement level of an example, in place of a solver run and its result.

    label    label of the level
    spacing  discretisation parameter h
    value    value of the judged quantity
    """

    label: str
    spacing: float
    value: float


def worked_examples(level: Level = Level.QUICK) -> Case:
    """Create the verification case of statistical results that are computed by hand.

    Judged are tolerances, extrapolated limits, confidence intervals, and the numbers that reports
    print. All levels are equal.
    """
    return Case(
        name="worked_examples",
        title="Worked examples of the harness",
        problem="Values on three and four levels with round numbers for fits, scatters and "
        "intervals. Judged are a tolerance derived from refinement, the limit and its "
        "uncertainty, the intervals of an order and of a line, and the printed numbers.",
        runs=(),
        quantities=tuple(
            Quantity(
                name, meaning, "", "by hand", measure,
                closed_form(value, HAND), tolerance, runs=(),
            )
            for name, meaning, measure, value, tolerance in _EXAMPLES
        ),
        equations=(
            r"U = 2 \sqrt{c^2 + s^2 + u_\mathrm{ref}^2},\quad "
            r"s^2 = \frac{\sum_i w_i \varepsilon_i^2}{n - 2}",
        ),
        no_order="arithmetic by hand",
    )  # fmt: skip


def _judge_example() -> Verdict:
    """Judge a quantity of an example with a tolerance that is derived from three refinement levels.

    The reference differs from the finest value by twice the expanded uncertainty U. The error scale
    is 2.
    """
    rungs = [
        _Rung(f"h = {h:g}", h, LIMIT + SLOPE * h + EPSILON * r)
        for h, r in zip(LEVELS, BESIDE, strict=True)
    ]
    known: Any = {rung.label: rung for rung in rungs}
    finest = rungs[0]
    quantity = Quantity(
        "value", "a value", "", finest.label, lambda result: float(result.value),
        Reference(finest.value - 2 * U, ReferenceKind.CLOSED_FORM, HAND, OF_REFERENCE),
        Derived(tuple(rung.label for rung in reversed(rungs)), 1.0, 1e9, HAND), scale=2.0,
    )  # fmt: skip
    runs: Any = tuple(rungs)
    return judge_quantity(quantity, Case("by_hand", "", "", runs, (quantity,)), known)


def _printed_number(text: str) -> float:
    found = re.search(r"± ([\d.e-]+)", text)
    return float(found[1]) if found else float("nan")


def _extrapolate_example(part: int) -> float:
    """Return the Richardson-extrapolated limit of four example levels, or its standard uncertainty.

    The fourth level has h = 8, and its value lies on the line a + c h.

    part  0 for the limit, 1 for its uncertainty
    """
    h = np.array([*LEVELS, 8.0])
    f = LIMIT + SLOPE * h + EPSILON * np.array([*BESIDE, 0.0])
    return richardson(h, f, 1.0)[part]


def _example_errors() -> list[float]:
    """Return the errors of three example levels, whose fitted order of convergence is exactly 2.

    The errors are h² e^(x ε), where the deviation x = (1, -2, 1) is orthogonal to any line over log
    h.
    """
    return [h**2 * np.exp(EPSILON * x) for h, x in zip(LEVELS, (1, -2, 1), strict=True)]


_EXAMPLES: tuple[tuple[str, str, Callable[[], float], float, Required], ...] = (
    ("derived_tolerance", "tolerance U = 2 √(c² + s² + u_ref²), s² = 14 ε²",
     lambda: _judge_example().allowed * _judge_example().scale, U, TO_ROUNDING),
    ("printed_tolerance", "tolerance, as printed in the text of a failed verdict",
     lambda: _printed_number(failure_text(_judge_example())), U, PRINTED),
    ("printed_uncertainty", "uncertainty of the reference over the scale, as printed",
     lambda: _printed_number(uncertainty_text(_judge_example())), OF_REFERENCE / 2, PRINTED),
    ("limit", "limit of four levels on a line, with the deviation ε",
     partial(_extrapolate_example, 0), LIMIT, TO_ROUNDING),
    # The two finest levels alone have the limit a + 8 ε. Of the fit, s² = 14 ε²/2, times the
    # element of the inverse of [[Σ1/h², Σ1/h], [Σ1/h, 4]] = [[85/64, 15/8], [15/8, 4]].
    ("uncertainty_of_the_limit", "standard uncertainty of the limit: √(7 · 256/115 + 8²) ε",
     partial(_extrapolate_example, 1), EPSILON * hypot(sqrt(7 * 256 / 115), 8), TO_ROUNDING),
    ("interval_of_the_order", "half-width of the order's 95 % interval: t √(6 ε² / 2 ln²2)",
     lambda: observed_order(LEVELS, _example_errors()).half_width,
     STUDENT * EPSILON * sqrt(3) / log(2), TO_ROUNDING),
    ("margin_of_the_order", "one-sided 95 % margin of the order: t₁ √(6 ε² / 2 ln²2)",
     lambda: observed_order(LEVELS, _example_errors()).margin,
     ONE_SIDED * EPSILON * sqrt(3) / log(2), TO_ROUNDING),
    ("interval_of_the_line", "half-width of the line's 95 % band in its middle: t √(6 ε² / 3)",
     lambda: error_line(LEVELS, _example_errors()).reach, STUDENT * EPSILON * sqrt(2), TO_ROUNDING),
)  # fmt: skip
