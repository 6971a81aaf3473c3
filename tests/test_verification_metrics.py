"""Error norms, observed orders and uncertainties on data whose answer is known."""

import numpy as np
import pytest

from verification.convergence import numerical_uncertainty, observed_order
from verification.metrics import relative_l1, relative_l2, shear_error

LEVELS = np.array([1 / n for n in (32, 42, 56, 74, 98, 128)])


def scatter(rng: np.random.Generator, size: float) -> np.ndarray:
    return 1 + size * rng.standard_normal(len(LEVELS))


def test_error_norms_are_relative_to_the_exact_field() -> None:
    exact = np.array([[3.0, 0.0], [4.0, 0.0]])
    assert relative_l1(1.01 * exact, exact) == pytest.approx(0.01)
    assert relative_l2(1.01 * exact, exact) == pytest.approx(0.01)
    assert relative_l2(exact + np.array([[0, 5], [0, 0]]), exact) == pytest.approx(1.0)


def test_shear_error_counts_the_transverse_component() -> None:
    exact = np.full((2, 2), 3.0)
    limit = np.full((2, 2), 10.0)
    shear = np.stack([exact + 3.0, exact * 0 + 4.0])
    assert shear_error(shear, exact, limit) == pytest.approx(0.5)
    assert shear_error(shear, np.stack([exact, 0 * exact]), limit) == pytest.approx(0.5)


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
def test_observed_order_of_a_power_law_is_exact(order: float) -> None:
    observed = observed_order(LEVELS, 7 * LEVELS**order)
    assert observed.order == pytest.approx(order)
    assert observed.half_width < 1e-10


def test_interval_of_the_order_covers_the_truth(rng: np.random.Generator) -> None:
    trials = [observed_order(LEVELS, LEVELS**1.5 * np.exp(0.1 * rng.standard_normal(6)))
              for _ in range(2000)]  # fmt: skip
    covered = np.mean([abs(trial.order - 1.5) <= trial.half_width for trial in trials])
    assert 0.93 <= covered <= 0.97


@pytest.mark.parametrize(
    ("name", "error"),
    {
        "first-order term": 1e-2 * LEVELS + LEVELS**2,
        "error floor of 0.05 %": 5e-4 + LEVELS**2,
        "bias of 0.3 %": 3e-3 + LEVELS**2,
    }.items(),
)
def test_order_gate_sees_what_a_one_per_cent_gate_passes(name: str, error: np.ndarray) -> None:
    assert np.all(error[-1] < 1e-2), name
    assert abs(observed_order(LEVELS, error).order - 2) > 0.25


def test_uncertainty_covers_the_discretisation_error(rng: np.random.Generator) -> None:
    errors = LEVELS**2
    covered = []
    for _ in range(500):
        values = 1 + errors * scatter(rng, 0.3)
        covered.append(abs(values[-1] - 1) <= 2 * numerical_uncertainty(LEVELS, values, 2.0))
    assert np.mean(covered) > 0.95


def test_uncertainty_does_not_grow_with_a_bias() -> None:
    values = 1 + LEVELS**2
    biased = numerical_uncertainty(LEVELS, 1.003 * values, 2.0)
    assert biased == pytest.approx(1.003 * numerical_uncertainty(LEVELS, values, 2.0))
    assert abs(1.003 * values[-1] - 1) > 2 * biased


def test_uncertainty_is_in_the_unit_of_the_value() -> None:
    values = 1 + LEVELS**2
    assert numerical_uncertainty(1e3 * LEVELS, 1e9 * values, 2.0) == pytest.approx(
        1e9 * numerical_uncertainty(LEVELS, values, 2.0)
    )


def test_too_few_levels_are_refused() -> None:
    with pytest.raises(ValueError, match="at least 3"):
        observed_order(LEVELS[:2], LEVELS[:2])
    with pytest.raises(ValueError, match="at least 3"):
        numerical_uncertainty(LEVELS[:2], LEVELS[:2], 1.0)
