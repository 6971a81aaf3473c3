"""The pressure solver against an active-set method that shares nothing with it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, graded_inverse, rough_inverse

from contact_scene.solver_errors import NotConverged
from semi_analytical.normal import normal_problem
from semi_analytical.normal.normal_load import (
    FixedApproach,
    PressureSum,
)
from semi_analytical.normal.normal_problem import solve_normal
from semi_analytical.tangential.admissible_shear import (
    FixedShift,
    ShearSum,
    magnitude,
)
from semi_analytical.tangential.linearised_shear import Point
from semi_analytical.tangential.tangential_problem import solve_tangential

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


# ---- The shear solver against the conditions of stick and slip, and against a general optimis


SHEAR_SHAPE = (3, 4)
AT_REST = Point(np.zeros((2, *SHEAR_SHAPE)), np.zeros((2, *SHEAR_SHAPE)))


@st.composite
def problems(draw):
    """Compliance, friction limit and target of a random surface."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    bound = rng.random(SHEAR_SHAPE) * (rng.random(SHEAR_SHAPE) < 0.8)
    bound.flat[:2] = 0.5
    target = draw(st.sampled_from([0.0, 0.3, 3.0])) * rng.standard_normal((2, *SHEAR_SHAPE))
    return compliance(rng, 2 * bound.size), bound, target


def shear_solved(problem, load, tolerance=TOLERANCE):
    A, bound, target = problem
    return solve_tangential(
        as_map(A),
        graded_inverse(A),
        bound,
        target,
        load,
        AT_REST,
        np.zeros(2),
        float(np.mean(np.diag(A))),
        tolerance,
    )


def assert_sticks_or_slips(problem, solution):
    """Coulomb's law in every cell: no slip inside the disc, slip along the shear on its edge."""
    A, bound, target = problem
    q = solution.shear
    slip = solution.shift[:, None, None] + target - as_map(A)(q)
    assert np.all(magnitude(q) <= bound * (1 + 1e-12))
    missing = bound * magnitude(slip) - q[0] * slip[0] - q[1] * slip[1]
    assert np.sum(missing) <= 1e-8 * np.sum(bound) * np.max(magnitude(slip)[bound > 0] + 1)
    inside = (bound > 0) & ~solution.in_slip
    assert np.all(magnitude(slip)[inside] <= 1e-8)


ANGLES = st.floats(0, 2 * np.pi)


@given(problems(), st.sampled_from([0.0, 1e-6, 0.3, 0.9, 0.999]), ANGLES)
def test_shear_under_a_force_sticks_or_slips_and_carries_it(problem, part, angle):
    total = part * np.sum(problem[1]) * np.array([np.cos(angle), np.sin(angle)])
    solution = shear_solved(problem, ShearSum(total))
    assert_sticks_or_slips(problem, solution)
    np.testing.assert_allclose(
        np.sum(solution.shear, axis=(1, 2)), total, atol=1e-12 * np.sum(problem[1])
    )


@given(problems(), st.sampled_from([0.0, 1e-3, 1.0, 1e3]), ANGLES)
def test_shear_under_a_shift_sticks_or_slips(problem, size, angle):
    shift = size * np.array([np.cos(angle), np.sin(angle)])
    solution = shear_solved(problem, FixedShift(shift))
    np.testing.assert_array_equal(solution.shift, shift)
    assert_sticks_or_slips(problem, solution)


@pytest.mark.parametrize("value", [np.nan, np.inf])
@pytest.mark.parametrize("call", [1, 2, 3])
def test_a_displacement_that_is_no_number_ends_as_not_converged(value, call, rng):
    A, bound = compliance(rng, 24), 0.2 + rng.random(SHEAR_SHAPE)
    calls = []

    def displace(q):
        calls.append(q)
        u = as_map(A)(q)
        if len(calls) == call:
            u[0, 0, 0] = value
        return u

    load, target = ShearSum(np.array([0.5, 0.1]) * np.sum(bound)), np.zeros((2, *SHEAR_SHAPE))
    with np.errstate(all="ignore"), pytest.raises(NotConverged):
        solve_tangential(
            displace, graded_inverse(A), bound, target, load, AT_REST, np.zeros(2), 1.0, TOLERANCE
        )
