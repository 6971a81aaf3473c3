"""Tests of pressure under moments: no tension, and force and moments carried exactly."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, rough_inverse

from contact_scene.solver_errors import NotConverged
from contact_solver.pressure import PressureProblem, solve_pressure
from contact_solver.rigid_motion import RigidMotion, RigidMotions
from semi_analytical.increments.normal_target import NormalTarget

Y, X = (one.ravel() for one in np.meshgrid(np.arange(5) - 2.0, np.arange(4) - 1.5))
POINTS = X.size
TOLERANCE = 1e-11
EVERYWHERE = np.ones(POINTS, dtype=bool)


def sums(p):
    return np.array([np.sum(p), np.sum(p * Y), np.sum(p * X)])


@st.composite
def carried(draw):
    """Sums of some pressure on some of the cells, and those cells."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    cells = rng.random(POINTS) < draw(st.floats(0.4, 1.0))
    assume(np.count_nonzero(cells) >= 4)
    p = cells * (0.01 + rng.random(POINTS) ** draw(st.sampled_from([1, 8])))
    return rng, cells, sums(p)


def motions(target, *, forced=True):
    """Approach and tilts under moments, and under a normal force or at an approach of 2."""
    total, *moments = target
    approach = RigidMotion(np.ones((1, 1)), total if forced else None, 2.0)
    tilts = (RigidMotion(arm[None], moment) for arm, moment in zip((Y, X), moments, strict=True))
    return RigidMotions(1, (approach, *tilts))


def problem_of(target, cells=EVERYWHERE, *, forced=True, matrix=None, gap=0.0):
    matrix = np.eye(POINTS) if matrix is None else matrix
    gap = np.where(cells, gap, np.inf)
    load = motions(target, forced=forced)
    return PressureProblem(as_map(matrix), lambda contact: rough_inverse(matrix), gap, load)


class Model:
    """Arms of cells, as the contact model has them."""

    arms = np.stack([Y, X])


def touches(target, cells, *, forced=True):
    total, *moments = target
    load = NormalTarget(*((total, None) if forced else (None, 2.0)), moment=tuple(moments))
    return load.touches(Model, np.where(cells, 0.0, np.inf))


@given(carried(), st.sampled_from([1e-6, 1.0, 1e6]))
def test_admissible_pressure_has_no_tension_and_carries_force_and_moments(problem, size):
    rng, cells, target = problem
    assume(touches(target, cells))
    p = problem_of(target, cells).admissible(size * cells * rng.random(POINTS))
    assert np.all(p >= 0)
    assert np.all(p[~cells] == 0)
    np.testing.assert_allclose(sums(p), target, atol=1e-12 * (target[0] + size))


@given(carried())
def test_what_other_points_carry_is_taken_off_force_and_moments(problem):
    rng, cells, target = problem
    elsewhere = ~cells * rng.random(POINTS)
    rest = motions(target).less(elsewhere[None]).held.prescribed_forces
    np.testing.assert_allclose(rest + sums(elsewhere), target, atol=1e-12)
    led = motions(target, forced=False).less(elsewhere[None])
    np.testing.assert_array_equal(led.held.prescribed_forces, rest[1:])
    np.testing.assert_array_equal(led.values, [2.0, 0.0, 0.0])


@given(carried(), st.booleans())
def test_a_plane_gap_is_closed_by_its_own_motion(problem, forced):
    rng, _, target = problem
    motion = np.array([2.0, *rng.normal(size=2)])
    of = problem_of(target, forced=forced)
    found = of.motion(rng.random(POINTS), of.closure(motion))
    np.testing.assert_allclose(found, motion, atol=1e-9)


@given(carried(), st.booleans())
def test_pressure_under_force_and_moments_closes_the_gap_where_it_presses(problem, forced):
    rng, cells, target = problem
    gap = np.where(cells, rng.random(POINTS), np.inf)
    assume(touches(target, cells, forced=forced))
    A = compliance(rng, POINTS)
    of = problem_of(target, cells, forced=forced, matrix=A, gap=gap)
    solution = solve_pressure(of, np.where(cells, 1.0, 0.0), TOLERANCE)
    p = solution.pressure
    approach, tilt_x, tilt_y = solution.motion
    g = gap + A @ p - approach - tilt_x * Y - tilt_y * X
    scale = max(abs(approach), abs(tilt_x), abs(tilt_y), 1.0)
    assert np.all(p >= 0)
    assert np.min(g) >= -1e-9 * scale
    assert np.max(np.abs(g[p > 0])) <= 1e-6 * scale
    np.testing.assert_allclose(sums(p)[1:], target[1:], atol=1e-10 * np.sum(p))
    if forced:
        assert np.sum(p) == pytest.approx(target[0], rel=1e-12)
    else:
        assert approach == 2.0


@pytest.mark.parametrize(
    ("arm", "carried"), [(1.4, True), (1.49, True), (1.51, False), (9.0, False)]
)
def test_a_force_beyond_the_outermost_cells_is_not_carried(arm, carried):
    target = np.array([3.0, 0.0, 3.0 * arm])
    assert touches(target, EVERYWHERE) is carried
    if carried:
        found = sums(problem_of(target).admissible(np.ones(POINTS)))
        np.testing.assert_allclose(found, target, atol=1e-12)
    else:
        with pytest.raises(NotConverged, match="the pressure under its moments"):
            problem_of(target).admissible(np.ones(POINTS))


@pytest.mark.parametrize(("M_y", "carried"), [(1.0, True), (-1.0, False), (0.0, True)])
def test_under_a_given_approach_only_the_side_of_the_moment_matters(M_y, carried):
    assert touches(np.array([0.0, 0.0, M_y]), X > 0, forced=False) is carried
