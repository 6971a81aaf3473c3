"""The pressure solver against an active-set method that shares nothing with it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, rough_inverse

from contact_scene.solver_errors import NotConverged
from semi_analytical.normal import normal_problem
from semi_analytical.normal.normal_load import (
    FixedApproach,
    PressureSum,
)
from semi_analytical.normal.normal_problem import solve_normal

TOLERANCE = 1e-11
SHAPE = (4, 5)


def solved(A, h, load, start=None, tolerance=TOLERANCE):
    start = np.ones(SHAPE) if start is None else start
    return solve_normal(as_map(A), rough_inverse(A), h.reshape(SHAPE), load, start, tolerance)


@st.composite
def contacts(draw):
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    h = draw(st.sampled_from([0.1, 1.0, 10.0])) * rng.random(np.prod(SHAPE))
    h[rng.random(h.size) < draw(st.sampled_from([0.0, 0.4]))] = np.inf
    h[0] = 0.0
    return compliance(rng, h.size), h


@given(contacts(), st.floats(0.01, 10), st.booleans(), st.integers(0, 2**32 - 1))
def test_solution_obeys_the_conditions_of_contact(contact, size, forced, seed):
    """No tension, no overlap, no gap under pressure: the conditions have one solution."""
    A, h = contact
    start = np.random.default_rng(seed).random(SHAPE) + 1e-3
    solution = solved(A, h, PressureSum(size) if forced else FixedApproach(size), start)
    p, delta = solution.pressure.ravel(), solution.approach
    finite = np.isfinite(h)
    gap = (A @ p + h - delta)[finite]
    assert np.all(p >= 0)
    assert np.all(p[~finite] == 0)
    assert np.min(gap) >= -TOLERANCE * delta
    assert np.sum(np.abs(gap) * p[finite]) <= TOLERANCE * delta * np.sum(p)
    assert (np.sum(p) if forced else delta) == pytest.approx(size, rel=1e-13)
    assert solution.iterations < 200  # 43 at most in 200 draws
    u = A @ p
    np.testing.assert_allclose(
        solution.displacement.ravel(), u, rtol=0, atol=1e-10 * np.max(np.abs(u))
    )


def test_a_solution_is_left_as_it_is(rng):
    A, h = compliance(rng, 20), rng.random(20)
    first = solved(A, h, PressureSum(3.0))
    again = solved(A, h, PressureSum(3.0), first.pressure, 2 * TOLERANCE)
    assert again.iterations == 0


def test_an_operator_that_is_not_positive_is_reported(rng):
    A = -compliance(rng, 20)
    with pytest.raises(NotConverged) as caught:
        solved(A, rng.random(20), PressureSum(3.0))
    assert not caught.value.residual <= TOLERANCE
    assert caught.value.tolerance == TOLERANCE


@pytest.mark.parametrize("limit", ["MAX_STEPS", "MAX_ITERATIONS"])
def test_a_stop_above_the_tolerance_is_an_error(rng, monkeypatch, limit):
    monkeypatch.setattr(normal_problem, limit, 1)
    with pytest.raises(NotConverged, match="the pressure") as caught:
        solved(compliance(rng, 20), rng.random(20), PressureSum(3.0))
    assert caught.value.residual > caught.value.tolerance == TOLERANCE
