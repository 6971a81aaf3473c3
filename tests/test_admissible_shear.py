"""The projection on admissible shears: feasible, nearest, and it gives the sum exactly."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from semi_analytical.tangential.admissible_shear import (
    FixedShift,
    ShearSum,
    magnitude,
    project,
    project_on_discs,
)

ROUND_OFF = 1e-12


def round_off(problem):
    """Of a projected shear: its own, and what was lost where a long vector was cut to the disc."""
    y, bound, _ = problem
    return ROUND_OFF * np.max(bound) + 1e-14 * np.max(np.abs(y))


@st.composite
def problems(draw):
    """Any shear, a friction limit with zeros in it, and a sum that it can carry."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    shape = draw(st.tuples(st.integers(2, 7), st.integers(2, 7)))
    bound = rng.random(shape) * (rng.random(shape) < draw(st.floats(0.3, 1.0)))
    assume(np.count_nonzero(bound) >= 2)
    y = draw(st.sampled_from([1e-6, 1.0, 1e3])) * rng.standard_normal((2, *shape))
    part = draw(st.sampled_from([0.0, 1e-9, 0.3, 0.9, 0.999, 1 - 1e-6]))
    angle = draw(st.floats(0, 2 * np.pi))
    total = part * np.sum(bound) * np.array([np.cos(angle), np.sin(angle)])
    return y, bound, total


def assert_feasible(q, problem):
    _, bound, total = problem
    assert np.all(magnitude(q) <= bound * (1 + ROUND_OFF))
    assert np.max(np.abs(np.sum(q, axis=(1, 2)) - total)) <= bound.size * round_off(problem)


@given(problems())
def test_projection_is_feasible_and_a_shift_cut_off_at_the_discs(problem):
    """q = P(y + λ) with one vector λ for all cells, the optimality conditions of the projection."""
    y, bound, total = problem
    q, multiplier = project(y, bound, total)
    assert_feasible(q, problem)
    expected = project_on_discs(y + multiplier[:, None, None], bound)
    np.testing.assert_allclose(q, expected, rtol=0, atol=10 * round_off(problem))


@pytest.mark.parametrize("part", [1e-30, 1e-15, 1e-9, 1e-3])
def test_a_tiny_sum_is_carried_to_its_own_precision(part, rng):
    bound = rng.random((9, 9))
    total = part * np.sum(bound) * np.array([0.6, -0.8])
    q, _ = project(part * rng.standard_normal((2, 9, 9)), bound, total)
    assert np.max(np.abs(np.sum(q, axis=(1, 2)) - total)) < 1e-13 * part * np.sum(bound)


@given(problems())
def test_without_a_sum_every_cell_is_projected_alone(problem):
    y, bound, _ = problem
    q = project_on_discs(y, bound)
    inside = magnitude(y) <= bound
    np.testing.assert_array_equal(q[:, inside], y[:, inside])
    outside = ~inside & (bound > 0)
    np.testing.assert_allclose(magnitude(q)[outside], bound[outside], rtol=1e-14)
    np.testing.assert_allclose(q[0] * y[1], q[1] * y[0], atol=1e-12 * np.max(np.abs(y)))
    assert np.all(q[:, bound == 0] == 0)


def test_a_force_and_the_shift_that_it_leads_to_have_the_same_shear(rng):
    y, bound = rng.standard_normal((2, 5, 4)), rng.random((5, 4))
    total, gamma, unknown = np.sum(bound) * np.array([0.4, -0.5]), 3.0, np.zeros(2)
    q, shift = ShearSum(total).nearest(y, bound, gamma, unknown)
    led, same = FixedShift(shift).nearest(y, bound, gamma, unknown)
    np.testing.assert_allclose(led, q, rtol=0, atol=100 * ROUND_OFF)
    np.testing.assert_array_equal(same, shift)


def test_a_force_is_exhausted_by_the_sum_of_the_limits_and_then_all_slips_along_it(rng):
    bound, motion, along = rng.random((5, 4)), np.array([1.0, 2.0]), np.array([0.6, -0.8])
    carried = np.sum(bound)
    assert not ShearSum(0.9 * carried * along).exhausts(bound)
    assert ShearSum(carried * along).exhausts(bound)
    assert ShearSum(1.1 * carried * along).exhausts(bound)
    q, kept = ShearSum(carried * along).full_slip(bound, motion)
    np.testing.assert_allclose(q, bound * along[:, None, None], rtol=ROUND_OFF)
    np.testing.assert_array_equal(kept, motion)
