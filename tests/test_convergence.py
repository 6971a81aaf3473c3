"""Order and limit of a value whose limit nobody knows, on planted data."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from verification.convergence.observed_order import (
    ORDER_OFF,
    ObservedOrder,
    RefinedValue,
    numerical_uncertainty,
    observed_order,
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
    assert fit.uncertainty < 1e-3 * TERM * sizes[-1] ** order


@pytest.mark.parametrize("sizes", [SIZES, GRIDS], ids=["doubling", "by the root of two"])
@pytest.mark.parametrize("order", [1.0, 1.5])
def test_the_next_term_does_not_hide_the_order(order: float, sizes: np.ndarray) -> None:
    fit = refined(TERM * sizes**order + TERM * sizes**2, order, sizes)
    assert known(fit).keeps(order, allowance=0.2)
    assert triplets_agree(fit.triplets)


def test_noise_keeps_no_promise() -> None:
    """Of one observed order: a wider interval never turns what failed into a pass."""
    narrow, wide, vague = (ObservedOrder(1.35, w, 0.8 * w) for w in (0.02, 0.2, 0.3))
    assert narrow.keeps(1.3)
    assert narrow.keeps(1.5) is False
    assert narrow.keeps(1.5, allowance=0.2)
    assert wide.keeps(1.35) is None
    assert wide.keeps(1.5) is None
    assert wide.keeps(1.7) is False
    assert vague.keeps(1.35) is None
    assert narrow.may_be_off_by(1.5) == ORDER_OFF


def test_an_order_that_is_known_to_be_higher_is_of_another_law() -> None:
    narrow, wide = (ObservedOrder(1.7, width, 0.8 * width) for width in (0.02, 0.2))
    assert narrow.keeps(1.65)
    assert narrow.keeps(1.5) is False
    assert wide.keeps(1.5)  # it may be 1.54, and is no lower
    assert wide.keeps(1.4) is False


@given(
    st.floats(0.0, 4.0), st.floats(0.0, 0.25), st.floats(0.5, 1.0), st.sampled_from([1.0, 1.5, 2.5])
)
def test_no_order_that_passes_would_pass_if_it_were_lower_by_three_tenths(
    order: float, half_width: float, part: float, promised: float
) -> None:
    def kept(order: float) -> bool | None:
        return ObservedOrder(order, half_width, part * half_width).keeps(promised)

    assert not (kept(order) and kept(order - 0.3))


def test_a_verdict_on_a_kept_order_is_right_19_times_of_20(rng: np.random.Generator) -> None:
    """At the verge of what is allowed, 0.1 below: passed by chance once in twenty."""
    fits = (
        observed_order(SIZES, TERM * SIZES**1.4 * np.exp(0.05 * rng.standard_normal(6)))
        for _ in range(1000)
    )
    passed = np.mean([fit.keeps(1.5) is True for fit in fits])
    assert 0.02 < passed < 0.08


@pytest.mark.parametrize("share", [0.1, 0.3])
def test_a_planted_first_order_term_is_seen(share: float) -> None:
    """A tenth of the error's factor, but first order: within 5e-4 on the finest level."""
    error = TERM * SIZES**2 + share * TERM * SIZES
    assert abs(error[-1]) < 5e-4
    assert known(refined(error, 2.0)).keeps(2.0) is False


@pytest.mark.parametrize("sizes", [SIZES, GRIDS], ids=["doubling", "by the root of two"])
def test_a_planted_floor_is_seen(sizes: np.ndarray) -> None:
    """Errors that stop falling at nine times the finest: no order is confirmed."""
    error = np.maximum(TERM * sizes**2, 9 * TERM * sizes[-1] ** 2)
    fit = refined(error, 2.0, sizes)
    assert not triplets_agree(fit.triplets)
    assert fit.observed is None or not fit.observed.keeps(2.0)


def test_planted_noise_is_seen(rng: np.random.Generator) -> None:
    """Noise of half the error: hardly ever a verdict, right or wrong."""
    judged = []
    for _ in range(200):
        fit = refined(TERM * SIZES * (1 + 0.5 * rng.standard_normal(6)), 1.0)
        narrow = fit.observed is not None and fit.observed.keeps(1.0) is not None
        judged.append(narrow and triplets_agree(fit.triplets))
    assert np.mean(judged) < 0.05


def test_interval_of_the_order_covers_the_truth(rng: np.random.Generator) -> None:
    """At 95 %: one degree of freedom more than there is would make it 90."""
    covered = []
    for _ in range(1000):
        fit = refined(TERM * SIZES**1.5 * (1 + 0.03 * rng.standard_normal(6)), 1.5)
        covered.append(abs(known(fit).order - 1.5) <= known(fit).half_width)
    assert 0.93 <= np.mean(covered) <= 0.97


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


def test_a_value_that_does_not_change_has_no_order() -> None:
    fit = refined(np.zeros(6), 2.0)
    assert fit.observed is None
    assert fit.limit == pytest.approx(EXACT, abs=1e-14)


def test_halves_that_contradict_each_other_are_part_of_the_uncertainty() -> None:
    """Three fine levels go to 1 and three coarse ones to 1.1, each exactly: the fit through all is
    left with the farther of the two."""
    values = np.where(np.arange(6) < 3, 1.1, 1.0) + 0.02 * SIZES
    coefficient, limit = np.polyfit(SIZES / SIZES[-1], values, 1, w=1 / SIZES)
    moved = max(abs(limit - 1.0), abs(limit - 1.1))
    left = np.sqrt(np.sum((values - np.polyval([coefficient, limit], SIZES / SIZES[-1])) ** 2
                          * (SIZES[-1] / SIZES) ** 2) / 4)  # fmt: skip
    assert moved > 2 * left
    assert numerical_uncertainty(SIZES, values, 1.0) == pytest.approx(
        np.hypot(coefficient, moved), rel=1e-9
    )
