"""Order and limit of a value whose limit nobody knows, on planted data."""

import numpy as np
import pytest

from verification.convergence.observed_order import (
    ORDER_OFF,
    ObservedOrder,
    RefinedValue,
    refined_value,
    triplets_agree,
)

SIZES = 0.25 * 2.0 ** -np.arange(6)
GRIDS = 0.25 * 2.0 ** (-np.arange(6) / 2)
EXACT = 1.0
TERM = 0.1


def refined(error: np.ndarray, expected: float, sizes: np.ndarray = SIZES) -> RefinedValue:
    return refined_value(sizes, EXACT + error, expected)


def known(fit: RefinedValue) -> ObservedOrder:
    assert fit.observed is not None
    return fit.observed


@pytest.mark.parametrize("sizes", [SIZES, GRIDS], ids=["doubling", "by the root of two"])
@pytest.mark.parametrize("order", [0.5, 1.0, 1.5, 2.0])
def test_order_and_limit_of_a_power_law_are_exact(order: float, sizes: np.ndarray) -> None:
    fit = refined(TERM * sizes**order, order, sizes)
    assert known(fit).order == pytest.approx(order, abs=1e-4)
    assert known(fit).half_width < 1e-3
    assert fit.triplets == pytest.approx((order, order), abs=1e-6)
    assert fit.limit == pytest.approx(EXACT, abs=1e-12)


def test_levels_may_come_in_any_order() -> None:
    error = TERM * SIZES + TERM * SIZES**2
    assert refined(error[::-1], 1.0, SIZES[::-1]) == refined(error, 1.0)


@pytest.mark.parametrize("sizes", [SIZES, GRIDS], ids=["doubling", "by the root of two"])
@pytest.mark.parametrize("order", [1.0, 1.5])
def test_the_next_term_does_not_hide_the_order(order: float, sizes: np.ndarray) -> None:
    fit = refined(TERM * sizes**order + TERM * sizes**2, order, sizes)
    assert known(fit).agrees_with(order, allowance=0.2)
    assert triplets_agree(fit.triplets)


def test_order_outside_its_interval_is_another_one() -> None:
    narrow, wide, vague = (ObservedOrder(1.35, width) for width in (0.02, 0.2, 0.3))
    assert narrow.agrees_with(1.3)
    assert narrow.agrees_with(1.5) is False
    assert narrow.agrees_with(1.5, allowance=0.2)
    assert wide.agrees_with(1.5)
    assert wide.agrees_with(1.6) is False
    assert vague.agrees_with(1.35) is None
    assert narrow.may_be_off_by() == ORDER_OFF


@pytest.mark.parametrize("share", [0.1, 0.3])
def test_a_planted_first_order_term_is_seen(share: float) -> None:
    """A tenth of the error's factor, but first order: within 5e-4 on the finest level."""
    error = TERM * SIZES**2 + share * TERM * SIZES
    assert abs(error[-1]) < 5e-4
    assert known(refined(error, 2.0)).agrees_with(2.0) is False


@pytest.mark.parametrize("sizes", [SIZES, GRIDS], ids=["doubling", "by the root of two"])
def test_a_planted_floor_is_seen(sizes: np.ndarray) -> None:
    """Errors that stop falling at nine times the finest: no order is confirmed."""
    error = np.maximum(TERM * sizes**2, 9 * TERM * sizes[-1] ** 2)
    fit = refined(error, 2.0, sizes)
    assert not triplets_agree(fit.triplets)
    assert fit.observed is None or not fit.observed.agrees_with(2.0)


def test_planted_noise_is_seen(rng: np.random.Generator) -> None:
    """Noise of half the error: hardly ever a verdict, right or wrong."""
    judged = []
    for _ in range(200):
        fit = refined(TERM * SIZES * (1 + 0.5 * rng.standard_normal(6)), 1.0)
        narrow = fit.observed is not None and fit.observed.agrees_with(1.0) is not None
        judged.append(narrow and triplets_agree(fit.triplets))
    assert np.mean(judged) < 0.05


def test_interval_of_the_order_covers_the_truth(rng: np.random.Generator) -> None:
    covered = []
    for _ in range(200):
        fit = refined(TERM * SIZES**1.5 * (1 + 0.03 * rng.standard_normal(6)), 1.5)
        covered.append(abs(known(fit).order - 1.5) <= known(fit).half_width)
    assert 0.9 <= np.mean(covered) <= 0.99


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
def test_the_limit_beats_the_finest_level_and_its_uncertainty_covers_the_rest(
    order: float, rng: np.random.Generator
) -> None:
    better, covered = [], []
    for _ in range(200):
        noise = 1 + 0.05 * rng.standard_normal(6)
        error = TERM * SIZES**order * noise + 0.5 * TERM * SIZES ** (order + 1)
        fit = refined(error, order)
        better.append(abs(fit.limit - EXACT) < abs(error[-1]))
        covered.append(abs(fit.limit - EXACT) <= 2 * fit.uncertainty)
    assert np.mean(better) > 0.97
    assert np.mean(covered) > 0.95


def test_a_limit_that_rests_on_the_wrong_order_says_so() -> None:
    fit = refined(TERM * SIZES, 2.0)
    assert abs(fit.limit - EXACT) <= 2 * fit.uncertainty


def test_a_value_that_does_not_change_has_no_order() -> None:
    fit = refined(np.zeros(6), 2.0)
    assert fit.observed is None
    assert fit.limit == pytest.approx(EXACT, abs=1e-14)


def test_three_levels_are_too_few() -> None:
    with pytest.raises(ValueError, match="at least 4"):
        refined_value(SIZES[:3], SIZES[:3], 1.0)
