"""The shear solver against the conditions of stick and slip, and against a general optimiser."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, graded_inverse

from contact_scene.solver_errors import NotConverged
from semi_analytical.tangential.admissible_shear import (
    FixedShift,
    ShearSum,
    magnitude,
)
from semi_analytical.tangential.linearised_shear import Point
from semi_analytical.tangential.tangential_problem import solve_tangential

TOLERANCE = 1e-11
SHAPE = (3, 4)
AT_REST = Point(np.zeros((2, *SHAPE)), np.zeros((2, *SHAPE)))


@st.composite
def problems(draw):
    """Compliance, friction limit and target of a random surface."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    bound = rng.random(SHAPE) * (rng.random(SHAPE) < 0.8)
    bound.flat[:2] = 0.5
    target = draw(st.sampled_from([0.0, 0.3, 3.0])) * rng.standard_normal((2, *SHAPE))
    return compliance(rng, 2 * bound.size), bound, target


def solved(problem, load, tolerance=TOLERANCE):
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
    solution = solved(problem, ShearSum(total))
    assert_sticks_or_slips(problem, solution)
    np.testing.assert_allclose(
        np.sum(solution.shear, axis=(1, 2)), total, atol=1e-12 * np.sum(problem[1])
    )


@given(problems(), st.sampled_from([0.0, 1e-3, 1.0, 1e3]), ANGLES)
def test_shear_under_a_shift_sticks_or_slips(problem, size, angle):
    shift = size * np.array([np.cos(angle), np.sin(angle)])
    solution = solved(problem, FixedShift(shift))
    np.testing.assert_array_equal(solution.shift, shift)
    assert_sticks_or_slips(problem, solution)


@pytest.mark.parametrize("value", [np.nan, np.inf])
@pytest.mark.parametrize("call", [1, 2, 3])
def test_a_displacement_that_is_no_number_ends_as_not_converged(value, call, rng):
    A, bound = compliance(rng, 24), 0.2 + rng.random(SHAPE)
    calls = []

    def displace(q):
        calls.append(q)
        u = as_map(A)(q)
        if len(calls) == call:
            u[0, 0, 0] = value
        return u

    load, target = ShearSum(np.array([0.5, 0.1]) * np.sum(bound)), np.zeros((2, *SHAPE))
    with np.errstate(all="ignore"), pytest.raises(NotConverged):
        solve_tangential(
            displace, graded_inverse(A), bound, target, load, AT_REST, np.zeros(2), 1.0, TOLERANCE
        )
