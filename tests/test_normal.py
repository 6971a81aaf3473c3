"""The pressure solver against an active-set method that shares nothing with it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, rough_inverse
from scipy.linalg import cholesky, solve_triangular
from scipy.optimize import brentq, nnls

from contact_scene.solver_errors import NotConverged
from semi_analytical import normal
from semi_analytical.normal import solve_normal
from semi_analytical.normal_load import FixedApproach, PressureSum

TOLERANCE = 1e-11
SHAPE = (4, 5)


def at_approach(A, h, delta):
    """Least squares without negative values (Lawson and Hanson 1974): ½ p·A p - (δ - h)·p."""
    finite = np.isfinite(h)
    p = np.zeros(len(h))
    L = cholesky(A[np.ix_(finite, finite)], lower=True)
    p[finite] = nnls(L.T, solve_triangular(L, delta - h[finite], lower=True))[0]
    return p


def under_load(A, h, total):
    """The approach at which the sum of the pressures is right."""
    highest = np.min(h) + total * np.max(np.abs(A)) * len(h)
    delta = brentq(
        lambda d: np.sum(at_approach(A, h, d)) - total, np.min(h), highest, xtol=1e-15, rtol=1e-14
    )
    return at_approach(A, h, delta), delta


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


@given(contacts(), st.floats(0.01, 10))
def test_pressure_under_a_load_is_that_of_the_active_set_method(contact, total):
    A, h = contact
    solution = solved(A, h, PressureSum(total))
    p, delta = under_load(A, h, total)
    np.testing.assert_allclose(solution.pressure.ravel(), p, atol=1e-7 * np.max(p))
    assert solution.approach == pytest.approx(delta, rel=1e-8)


@given(contacts(), st.floats(0.01, 10))
def test_pressure_at_an_approach_is_that_of_the_active_set_method(contact, delta):
    A, h = contact
    solution = solved(A, h, FixedApproach(delta))
    p = at_approach(A, h, delta)
    np.testing.assert_allclose(solution.pressure.ravel(), p, atol=1e-7 * np.max(p))


@given(contacts(), st.floats(0.01, 10), st.integers(0, 2**32 - 1))
def test_solution_obeys_the_conditions_of_contact(contact, total, seed):
    A, h = contact
    start = np.random.default_rng(seed).random(SHAPE) + 1e-3
    solution = solved(A, h, PressureSum(total), start)
    p, delta = solution.pressure.ravel(), solution.approach
    finite = np.isfinite(h)
    gap = (A @ p + h - delta)[finite]
    assert np.all(p >= 0)
    assert np.all(p[~finite] == 0)
    assert np.min(gap) >= -TOLERANCE * delta
    assert np.sum(np.abs(gap) * p[finite]) <= TOLERANCE * delta * np.sum(p)
    assert np.sum(p) == pytest.approx(total, rel=1e-13)
    u = A @ p
    np.testing.assert_allclose(
        solution.displacement.ravel(), u, rtol=0, atol=1e-10 * np.max(np.abs(u))
    )


def test_load_and_approach_control_meet(rng):
    A, h = compliance(rng, 20), rng.random(20)
    forced = solved(A, h, PressureSum(3.0))
    moved = solved(A, h, FixedApproach(forced.approach))
    np.testing.assert_allclose(moved.pressure, forced.pressure, atol=1e-9)


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


@pytest.mark.parametrize("limit", ["MOST_STEPS", "MOST_ITERATIONS"])
def test_a_stop_above_the_tolerance_is_an_error(rng, monkeypatch, limit):
    monkeypatch.setattr(normal, limit, 1)
    with pytest.raises(NotConverged, match="the pressure") as caught:
        solved(compliance(rng, 20), rng.random(20), PressureSum(3.0))
    assert caught.value.residual > caught.value.tolerance == TOLERANCE
