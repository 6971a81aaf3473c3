"""Error norms, observed orders and uncertainties on data whose answer is known."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from verification.convergence.error_line import by_size, error_line
from verification.convergence.observed_order import numerical_uncertainty, observed_order
from verification.norms import relative_l1, relative_l2, shear_error
from verification.observed.ring_errors import between_rings
from verification.observed.ring_errors import relative_l1 as relative_l1_over_radius
from verification.observed.ring_errors import relative_l2 as relative_l2_over_radius

LEVELS = np.array([1 / n for n in (32, 42, 56, 74, 98, 128)])


def test_error_norms_are_relative_to_the_exact_field() -> None:
    exact = np.array([[3.0, 0.0], [4.0, 0.0]])
    assert relative_l1(1.01 * exact, exact) == pytest.approx(0.01)
    assert relative_l2(1.01 * exact, exact) == pytest.approx(0.01)
    assert relative_l2(exact + np.array([[0, 5], [0, 0]]), exact) == pytest.approx(1.0)


def test_errors_between_rings_are_those_of_the_linear_traction() -> None:
    """A parabola r (1.1 - r) is above its chords by h²/6 in the mean, h²/√30 in the mean square."""

    def exact(r: np.ndarray) -> np.ndarray:
        return np.where(r <= 1.1, r * (1.1 - r), 0.0)

    side = 1 / 40
    radii = side * np.arange(45)
    increment: Any = SimpleNamespace(radii=radii, pressure=np.ones_like(radii))
    assert between_rings(increment, 1.0).max() == pytest.approx(1.1, abs=side)
    # ∫ r dr is 1.1²/2, ∫ r² (1.1 - r)² r dr is 1.1⁶/60
    l1 = relative_l1_over_radius(increment, exact(radii), exact, 1.0)
    assert l1 == pytest.approx(side**2 / 6, rel=0.02)
    l2 = relative_l2_over_radius(increment, exact(radii), exact, 1.0)
    assert l2 == pytest.approx(side**2 / np.sqrt(30) * np.sqrt(30 / 1.1**4), rel=0.02)


def test_shear_error_counts_the_transverse_component() -> None:
    exact = np.full((2, 2), 3.0)
    limit = np.full((2, 2), 10.0)
    shear = np.stack([exact + 3.0, exact * 0 + 4.0])
    assert shear_error(shear, exact, limit) == pytest.approx(0.5)
    assert shear_error(shear, np.stack([exact, 0 * exact]), limit) == pytest.approx(0.5)


def test_band_contains_the_true_line(rng: np.random.Generator) -> None:
    """At the ends of the levels and in their middle, in 95 % of the trials."""
    sizes = LEVELS[[0, 2, -1]]
    covered = []
    for _ in range(1000):
        line = error_line(LEVELS, LEVELS**1.5 * np.exp(0.1 * rng.standard_normal(6)))
        low, high = line.band(sizes)
        covered.append((low <= sizes**1.5) & (sizes**1.5 <= high))
    assert np.all(np.mean(covered, axis=0) > 0.93)
    assert np.all(np.mean(covered, axis=0) < 0.97)


def test_errors_of_one_size_count_by_their_root_mean_square() -> None:
    assert by_size([2.0, 1.0, 2.0, 1.0], [3.0, 1.0, -4.0, 1.0]) == (
        [2.0, 1.0],
        [pytest.approx(12.5**0.5), 1.0],
    )


@pytest.mark.parametrize("sizes", [LEVELS, LEVELS[[0, 2, -1]]], ids=["six levels", "three"])
def test_uncertainty_covers_the_discretisation_error(
    sizes: np.ndarray, rng: np.random.Generator
) -> None:
    """Three levels have no two ranges that could disagree: there the scatter tells."""
    covered = []
    for _ in range(2000):
        values = 1 + sizes**2 * (1 + 0.3 * rng.standard_normal(len(sizes)))
        covered.append(abs(values[-1] - 1) <= 2 * numerical_uncertainty(sizes, values, 2.0))
    assert np.mean(covered) > 0.95


def test_uncertainty_covers_an_error_that_has_no_order_on_the_coarser_levels() -> None:
    """A layer that coarse grids do not resolve: they err less than the order would have it."""
    for resolved in (0.015, 0.02):
        errors = LEVELS / (1 + (LEVELS / resolved) ** 4)
        uncertainty = numerical_uncertainty(LEVELS, 1 + errors, 1.0)
        assert abs(errors[-1]) <= 2 * uncertainty < 4 * abs(errors[-1])


def test_too_few_levels_are_refused() -> None:
    with pytest.raises(ValueError, match="at least 3"):
        observed_order(LEVELS[:2], LEVELS[:2])
    with pytest.raises(ValueError, match="at least 3"):
        numerical_uncertainty(LEVELS[:2], LEVELS[:2], 1.0)
