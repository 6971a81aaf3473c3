"""The shear solver against the conditions of stick and slip, and against a general optimiser."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, graded_inverse
from scipy.optimize import minimize

from contact_scene.solver_errors import NotConverged
from semi_analytical.admissible_shear import FixedShift, ShearSum, magnitude
from semi_analytical.linearised_shear import Point
from semi_analytical.tangential import solve_tangential

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


@pytest.mark.parametrize("force", [True, False], ids=["force", "shift"])
def test_a_general_optimiser_finds_no_lower_energy(force, rng):
    bound = 0.2 + rng.random(SHAPE)
    A, target = compliance(rng, 2 * bound.size), rng.standard_normal((2, *SHAPE))
    total, shift = np.array([0.4, -0.3]) * np.sum(bound), np.array([0.7, 0.2])
    solution = solved((A, bound, target), ShearSum(total) if force else FixedShift(shift))
    pull = target.ravel() if force else (target + shift[:, None, None]).ravel()

    def energy(q):
        return 0.5 * q @ A @ q - pull @ q

    limits = [{"type": "ineq", "fun": lambda q: bound.ravel() ** 2 - q[:12] ** 2 - q[12:] ** 2}]
    if force:
        limits.append({"type": "eq", "fun": lambda q: q.reshape(2, 12).sum(axis=1) - total})
    best = minimize(
        energy,
        np.zeros(24),
        jac=lambda q: A @ q - pull,
        method="SLSQP",
        constraints=limits,
        options={"ftol": 1e-15, "maxiter": 1000},
    )
    q = solution.shear.ravel()
    assert energy(q) <= best.fun + 1e-9 * abs(best.fun)
    np.testing.assert_allclose(q, best.x, atol=1e-5)


def test_force_and_shift_control_meet(rng):
    problem = compliance(rng, 24), 0.2 + rng.random(SHAPE), rng.standard_normal((2, *SHAPE))
    total = np.array([0.5, 0.1]) * np.sum(problem[1])
    forced = solved(problem, ShearSum(total))
    moved = solved(problem, FixedShift(forced.shift))
    np.testing.assert_allclose(moved.shear, forced.shear, atol=1e-8)


def test_an_ample_limit_leaves_the_linear_problem(rng):
    A, target = compliance(rng, 24), rng.standard_normal((2, *SHAPE))
    solution = solved((A, np.full(SHAPE, 1e3), target), FixedShift(np.array([1.0, -2.0])))
    expected = np.linalg.solve(A, (target + np.array([1.0, -2.0])[:, None, None]).ravel())
    np.testing.assert_allclose(solution.shear.ravel(), expected, atol=1e-6)
    assert not np.any(solution.in_slip)


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
