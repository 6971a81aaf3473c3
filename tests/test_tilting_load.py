"""Moments on the pressure: sums carried exactly, no tension, and the tilt as their multiplier."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, rough_inverse

from semi_analytical.normal import solve_normal
from semi_analytical.tilting import PressureMoments

TOLERANCE = 1e-11
SHAPE = (4, 5)
Y, X = np.meshgrid(np.arange(5) - 2.0, np.arange(4) - 1.5)
ARMS = np.stack([Y, X])
EVERYWHERE = np.ones(SHAPE, dtype=bool)


def sums(p):
    return np.array([np.sum(p), np.sum(p * Y), np.sum(p * X)])


@st.composite
def carried(draw):
    """Sums of some pressure on some of the cells, and those cells."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    cells = rng.random(SHAPE) < draw(st.floats(0.4, 1.0))
    assume(np.count_nonzero(cells) >= 4)
    p = cells * (0.01 + rng.random(SHAPE) ** draw(st.sampled_from([1, 8])))
    return rng, cells, sums(p)


def loads(target, cells=EVERYWHERE):
    total, M_x, M_y = target
    moments = np.array([M_x, M_y])
    return PressureMoments(ARMS, cells, moments, total=total), PressureMoments(
        ARMS, cells, moments, approach=2.0
    )


@given(carried(), st.sampled_from([1e-6, 1.0, 1e6]))
def test_admissible_pressure_has_no_tension_and_carries_force_and_moments(problem, size):
    rng, cells, target = problem
    load, _ = loads(target, cells)
    assume(load.touches(np.where(cells, 0.0, np.inf)))
    p = load.admissible(size * cells * rng.random(SHAPE))
    assert np.all(p >= 0)
    assert np.all(p[~cells] == 0)
    np.testing.assert_allclose(sums(p), target, atol=1e-12 * (target[0] + size))


@given(carried(), st.booleans())
def test_pressure_under_force_and_moments_closes_the_gap_where_it_presses(problem, forced):
    rng, cells, target = problem
    load = loads(target, cells)[0 if forced else 1]
    gap = np.where(cells, rng.random(SHAPE), np.inf)
    assume(load.touches(gap))
    A = compliance(rng, X.size)
    start = np.where(cells, 1.0, 0.0)
    solution = solve_normal(as_map(A), rough_inverse(A), gap, load, start, TOLERANCE)
    p = solution.pressure
    approach, tilt_x, tilt_y = solution.motion
    g = gap + as_map(A)(p) - approach - tilt_x * Y - tilt_y * X
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
    load = PressureMoments(ARMS, EVERYWHERE, np.array([0.0, 3.0 * arm]), total=3.0)
    assert load.touches(np.zeros(SHAPE)) is carried


@pytest.mark.parametrize(("M_y", "carried"), [(1.0, True), (-1.0, False), (0.0, True)])
def test_under_a_given_approach_only_the_side_of_the_moment_matters(M_y, carried):
    load = PressureMoments(ARMS, X > 0, np.array([0.0, M_y]), approach=1.0)
    assert load.touches(np.where(X > 0, 0.0, np.inf)) is carried
