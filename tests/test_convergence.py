"""Tests of observed orders and limits under refinement, on artificial data with a known answer."""

from functools import partial
from math import hypot, log, pi, sqrt, tan
from types import SimpleNamespace

import numpy as np
import pytest

from verification.convergence.observed_order import (
    ObservedOrder,
    RefinedValue,
    by_size,
    error_line,
    numerical_uncertainty,
    observed_order,
    refined_value,
    richardson,
)
from verification.judging.case import Case, Derived, Quantity
from verification.judging.judgement import judge_quantity
from verification.judging.outcome import failure_text, uncertainty_text
from verification.problems.problem import Reference, ReferenceKind

SIZES = 0.25 * 2.0 ** -np.arange(6)
GRIDS = 0.25 * 2.0 ** (-np.arange(6) / 2)
EXACT = 1.0
TERM = 0.1


on_both_grids = pytest.mark.parametrize(
    "sizes", [SIZES, GRIDS], ids=["doubling", "by the root of two"]
)


def share(rng, judge, trials=600):
    """Shares of trials in which something holds, by the scatter of six errors."""
    return np.mean([judge(rng.standard_normal(6)) for _ in range(trials)], axis=0)


def refined(error: np.ndarray, expected: float, sizes: np.ndarray = SIZES) -> RefinedValue:
    return refined_value(sizes, EXACT + error, expected)


@on_both_grids
@pytest.mark.parametrize("order", [0.5, 1.0, 1.5, 2.0])
def test_order_and_limit_of_a_power_law_are_exact(order, sizes):
    fit = refined(TERM * sizes**order, order, sizes)
    assert fit.observed.order == pytest.approx(order, abs=1e-4)
    assert fit.observed.half_width < 1e-3
    assert fit.limit == pytest.approx(EXACT, abs=1e-12)
    assert fit.uncertainty < 1e-3 * TERM * sizes[-1] ** order


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
def test_the_uncertainty_of_a_limit_covers_the_next_term(order):
    error = TERM * GRIDS**order * (1 + 0.5 * GRIDS)
    fit = refined(error, order, GRIDS)
    assert abs(fit.limit - EXACT) <= fit.uncertainty


@pytest.mark.parametrize(
    ("order", "half_width", "promised", "allowance", "kept"),
    [
        (1.35, 0.02, 1.3, 0.0, True),
        (1.35, 0.02, 1.5, 0.0, False),
        (1.35, 0.2, 1.35, 0.0, None),
        (1.35, 0.2, 1.5, 0.0, None),
        (1.35, 0.2, 1.7, 0.0, False),
        (1.35, 0.3, 1.35, 0.0, None),
        (1.7, 0.02, 1.65, 0.0, True),
        (1.7, 0.02, 1.5, 0.0, False),
        (1.7, 0.2, 1.5, 0.0, True),
        (1.7, 0.2, 1.4, 0.0, False),
        (1.35, 0.02, 1.5, 0.2, True),
    ],
)
def test_an_order_is_kept_as_far_as_it_is_known(order, half_width, promised, allowance, kept):
    """A wider interval never turns what failed into a pass."""
    assert ObservedOrder(order, half_width, 0.8 * half_width).keeps(promised, allowance) is kept


@pytest.mark.parametrize(
    ("order", "margin", "reached"),
    [(1.95, 0.02, True), (3.0, 0.6, True), (1.85, 0.2, None), (1.95, 0.2, None), (1.2, 0.2, False)],
)
def test_a_claimed_order_is_reached_as_far_as_it_is_known(order, margin, reached):
    assert ObservedOrder(order, 1.2 * margin, margin).reaches(2.0) is reached


@on_both_grids
def test_a_planted_floor_is_seen(sizes):
    """Errors that stop falling at nine times the finest: no order is confirmed."""
    error = np.maximum(TERM * sizes**2, 9 * TERM * sizes[-1] ** 2)
    fit = refined(error, 2.0, sizes)
    assert fit.observed is None or not fit.observed.keeps(2.0)


def test_interval_of_the_order_covers_the_truth(rng):
    """At 95 %: one degree of freedom more than there is would make it 90."""

    def covered(scatter):
        fit = refined(TERM * SIZES**1.5 * (1 + 0.03 * scatter), 1.5).observed
        return abs(fit.order - 1.5) <= fit.half_width

    assert 0.93 <= share(rng, covered) <= 0.97


def test_a_value_that_does_not_change_has_no_order():
    fit = refined(np.zeros(6), 2.0)
    assert fit.observed is None
    assert fit.limit == pytest.approx(EXACT, abs=1e-14)


# ---- error bands and uncertainties


LEVELS = np.array([1 / n for n in (32, 42, 56, 74, 98, 128)])


def test_errors_of_one_size_count_by_their_root_mean_square():
    assert by_size([2.0, 1.0, 2.0, 1.0], [3.0, 1.0, -4.0, 1.0]) == (
        [2.0, 1.0],
        [pytest.approx(12.5**0.5), 1.0],
    )


def test_uncertainty_covers_an_error_that_has_no_order_on_the_coarser_levels():
    """A layer that coarse grids do not resolve: they err less than the order would have it."""
    for resolved in (0.015, 0.02):
        errors = LEVELS / (1 + (LEVELS / resolved) ** 4)
        uncertainty = numerical_uncertainty(LEVELS, 1 + errors, 1.0)
        assert abs(errors[-1]) <= 2 * uncertainty < 4 * abs(errors[-1])


@pytest.mark.parametrize("fit", [observed_order, partial(numerical_uncertainty, order=1.0)])
def test_too_few_levels_are_refused(fit):
    with pytest.raises(ValueError, match="at least 3"):
        fit(LEVELS[:2], LEVELS[:2])


# Worked by hand: values a + c h + ε (1, -6, 8) at h = 1, 2, 4. The deviation is orthogonal to the
# line fitted with weights 1/h, as 1 - 6/4 + 8/16 = 1 - 6/2 + 8/4 = 0; its weighted squares sum to
# (1 + 9 + 4) ε².
THREE_LEVELS = np.array([1.0, 2.0, 4.0])
EPSILON = 0.4 / sqrt(14)
THREE_VALUES = 5.0 + 0.3 * THREE_LEVELS + EPSILON * np.array([1.0, -6.0, 8.0])


def test_a_derived_tolerance_and_its_printed_numbers_are_those_by_hand():
    """u_num = √(c² + s²) = 0.5 by s² = 14 ε² / (3 - 2); with u_ref = 1.2 it is 1.3, and U twice."""
    runs = tuple(
        SimpleNamespace(label=f"h = {h:g}", spacing=h, value=float(value))
        for h, value in zip(THREE_LEVELS, THREE_VALUES, strict=True)
    )
    reference = Reference(runs[0].value - 5.2, ReferenceKind.CLOSED_FORM, "by hand", 1.2)
    quantity = Quantity(
        "value",
        "a value",
        "",
        runs[0].label,
        lambda run: float(run.value),
        reference,
        Derived(tuple(run.label for run in reversed(runs)), 1.0, 1e9, "by hand"),
        scale=2.0,
    )
    case = Case("by_hand", "", "", runs, (quantity,))
    found = judge_quantity(quantity, case, {run.label: run for run in runs})
    assert found.allowed * found.scale == pytest.approx(2.6)
    assert "± 2.6 (2 U)" in failure_text(found)
    assert uncertainty_text(found) == "± 0.6, "


def test_the_limit_of_four_levels_and_its_uncertainty_are_those_by_hand():
    """The two finest levels alone have the limit a + 8 ε. Of the fit, s² = 14 ε²/2, times the
    element of the inverse of [[Σ1/h², Σ1/h], [Σ1/h, 4]] = [[85/64, 15/8], [15/8, 4]]."""
    limit, uncertainty = richardson(np.append(THREE_LEVELS, 8.0), np.append(THREE_VALUES, 7.4), 1.0)
    assert limit == pytest.approx(5.0)
    assert uncertainty == pytest.approx(EPSILON * hypot(sqrt(7 * 256 / 115), 8))


def test_intervals_of_three_levels_are_those_by_hand():
    """Errors h² e^(x ε) with x = (1, -2, 1), which is orthogonal to any line over log h.

    Student's t with one degree of freedom is 1/tan(π α)."""
    line = error_line(THREE_LEVELS, THREE_LEVELS**2 * np.exp(EPSILON * np.array([1.0, -2.0, 1.0])))
    two_sided, one_sided = EPSILON / tan(pi / 40), EPSILON / tan(pi / 20)
    assert line.observed.order == pytest.approx(2.0)
    assert line.observed.half_width == pytest.approx(two_sided * sqrt(3) / log(2))
    assert line.observed.margin == pytest.approx(one_sided * sqrt(3) / log(2))
    assert line.reach == pytest.approx(two_sided * sqrt(2))
    low, high = line.band(THREE_LEVELS[-1:])
    assert np.log(high / low) == pytest.approx(2 * two_sided * sqrt(5))
