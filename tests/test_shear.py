"""Tests of the solver of shear alone on small dense problems: stick and slip."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, graded_inverse, pushed

from contact_scene.solver_errors import NotConverged
from contact_solver.admissible_shear import (
    admissible_shear,
    magnitude,
)
from contact_solver.binned_preconditioner import BinnedPreconditioner
from contact_solver.conjugate_gradients import Point
from contact_solver.shear import ShearProblem, solve_shear

TOLERANCE = 1e-11
FEW = 12
AT_REST = Point(np.zeros((2, FEW)), np.zeros((2, FEW)))


def random_surface(seed, size):
    """Compliance, friction limit and target of a random surface."""
    rng = np.random.default_rng(seed)
    bound = rng.random(FEW) * (rng.random(FEW) < 0.8)
    bound[:2] = 0.5
    target = size * rng.standard_normal((2, FEW))
    return compliance(rng, 2 * bound.size), bound, target


def problems():
    return st.builds(random_surface, st.integers(0, 2**32 - 1), st.sampled_from([0.0, 0.3, 3.0]))


def graded(A, own=1.0):
    return lambda zones: BinnedPreconditioner(zones, graded_inverse(A), own)


def shear_solved(problem, load, tolerance=TOLERANCE):
    A, bound, target = problem
    own = float(np.mean(np.diag(A)))
    problem = ShearProblem(as_map(A), graded(A, own), bound, target, load, own)
    return solve_shear(problem, AT_REST, np.zeros(2), tolerance)


def assert_sticks_or_slips(problem, solution):
    """Coulomb's law in every cell: no slip inside the disc, slip along the shear on its edge."""
    A, bound, target = problem
    q = solution.shear
    slip = solution.motion[:, None] + target - as_map(A)(q)
    assert np.all(magnitude(q) <= bound * (1 + 1e-12))
    missing = bound * magnitude(slip) - q[0] * slip[0] - q[1] * slip[1]
    assert np.sum(missing) <= 1e-8 * np.sum(bound) * np.max(magnitude(slip)[bound > 0] + 1)
    inside = (bound > 0) & ~solution.in_slip
    assert np.all(magnitude(slip)[inside] <= 1e-8)


ANGLES = st.floats(0, 2 * np.pi)


@given(problems(), st.sampled_from([0.0, 1e-6, 0.3, 0.9, 0.999, 0.9999]), ANGLES)
@example(random_surface(336, 0.3), 0.999, 3.085098754601997)
@example(random_surface(1348, 0.3), 0.999, 4.599260885499501)
def test_shear_under_a_force_sticks_or_slips_and_carries_it(problem, part, angle):
    total = part * np.sum(problem[1]) * np.array([np.cos(angle), np.sin(angle)])
    solution = shear_solved(problem, pushed(total))
    assert_sticks_or_slips(problem, solution)
    np.testing.assert_allclose(
        np.sum(solution.shear, axis=1), total, atol=1e-12 * np.sum(problem[1])
    )


@given(problems(), st.sampled_from([0.0, 1e-3, 1.0, 1e3]), ANGLES)
def test_shear_under_a_shift_sticks_or_slips(problem, size, angle):
    shift = size * np.array([np.cos(angle), np.sin(angle)])
    solution = shear_solved(problem, pushed(shift=shift))
    np.testing.assert_array_equal(solution.motion, shift)
    assert_sticks_or_slips(problem, solution)


@pytest.mark.parametrize("value", [np.nan, np.inf])
@pytest.mark.parametrize("call", [1, 2, 3])
def test_a_displacement_that_is_no_number_ends_as_not_converged(value, call, rng):
    A, bound = compliance(rng, 24), 0.2 + rng.random(FEW)
    calls = []

    def displace(q):
        calls.append(q)
        u = as_map(A)(q)
        if len(calls) == call:
            u[0, 0] = value
        return u

    load = pushed(np.array([0.5, 0.1]) * np.sum(bound))
    problem = ShearProblem(displace, graded(A), bound, np.zeros((2, FEW)), load, 1.0)
    with np.errstate(all="ignore"), pytest.raises(NotConverged):
        solve_shear(problem, AT_REST, np.zeros(2), TOLERANCE)


@pytest.mark.parametrize("part", [1e-30, 1e-15, 1e-9, 1e-3])
def test_a_tiny_sum_is_carried_to_its_own_precision(part, rng):
    bound = rng.random(81)
    total = part * np.sum(bound) * np.array([0.6, -0.8])
    q = admissible_shear(pushed(total), part * rng.standard_normal((2, 81)), bound)
    assert np.max(np.abs(np.sum(q, axis=1) - total)) < 1e-13 * part * np.sum(bound)
