"""Tests of projections of shear and pressure onto prescribed forces, torques and friction
limits."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, rough_inverse

from semi_analytical.normal.normal_problem import solve_normal
from semi_analytical.normal.tilting import PressureMoments
from semi_analytical.tangential.admissible_shear import TangentialLoad, magnitude

SHAPE = (4, 5)
Y, X = np.meshgrid(np.arange(5) - 2.0, np.arange(4) - 1.5)
ROTATION = np.stack([-Y, X])


def forces(q):
    return np.array([*np.sum(q, axis=(1, 2)), np.sum(q * ROTATION)])


def load_of(target):
    return TangentialLoad(target[:2], torque=float(target[2]), rotation=ROTATION)


def discs(bound, rng):
    """A shear within the discs."""
    angle = 2 * np.pi * rng.random(SHAPE)
    return rng.random(SHAPE) * bound * np.stack([np.cos(angle), np.sin(angle)])


@st.composite
def problems(draw):
    """Any shear, a friction limit with zeros in it, and forces that it can carry."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    bound = rng.random(SHAPE) * (rng.random(SHAPE) < 0.8)
    assume(np.count_nonzero(bound) >= 4)
    y = draw(st.sampled_from([1e-3, 1.0, 1e3])) * rng.standard_normal((2, *SHAPE))
    load = load_of(forces(discs(bound, rng)))
    part = draw(st.sampled_from([0.0, 0.5, 0.99, 0.9999])) * load.limit(bound)[0]
    return rng, y, bound, load_of(part * forces_of(load))


def forces_of(load):
    return np.array([*load.total, load.torque])


@given(problems())
def test_projection_is_feasible(problem):
    _, y, bound, load = problem
    q = load.admissible(y, bound)
    assert np.all(magnitude(q) <= bound * (1 + 1e-12))
    blur = 1e-11 * (np.max(bound) + 1e-3 * np.max(np.abs(y)))
    np.testing.assert_allclose(forces(q), forces_of(load), atol=X.size * blur)


@given(problems())
def test_nothing_admissible_is_nearer(problem):
    """The variational inequality (y - q)·(z - q) <= 0 for every admissible z."""
    rng, y, bound, load = problem
    q = load.admissible(y, bound)
    z = load.admissible(rng.standard_normal(y.shape) * np.max(np.abs(y)), bound)
    scale = np.max(np.abs(y - q)) * np.sum(bound)
    assert np.sum((y - q) * (z - q)) <= 1e-9 * scale


@given(problems())
def test_at_its_limit_a_load_is_carried_by_full_slip_alone(problem):
    rng, _, bound, load = problem
    load = load_of(forces(discs(bound, rng)))
    times, velocity = load.limit(bound)
    q, _ = load.full_slip(bound, np.zeros(3))
    moves = magnitude(
        sum(v * u for v, u in zip(velocity, load.free_motions(ROTATION.shape), strict=True))
    )
    # Smoothing at the pole of the motion, 1e-8 of the largest speed, reduces the shear by less than
    # 1e-8 of itself in these cells. Shear in other cells hardly changes the power.
    slips = moves > 1e-4 * np.max(moves)
    unsure = 1e-5 * np.sum(bound) + 1e-3 * np.sum(bound[~slips])
    np.testing.assert_allclose(forces(q), times * forces_of(load), atol=unsure)
    assert np.all(magnitude(q) <= bound * (1 + 1e-12))
    np.testing.assert_allclose(magnitude(q)[slips], bound[slips])
    # The power of friction in that motion bounds the work of every admissible shear.
    speed = sum(
        v * unit for v, unit in zip(velocity, load.free_motions(ROTATION.shape), strict=True)
    )
    other = discs(bound, rng)
    assert np.sum(other * speed) <= times * (1 + 1e-9)
    assert load_of(0.999 * times * forces_of(load)).exhausts(bound) is False
    assert load_of(1.001 * times * forces_of(load)).exhausts(bound) is True


def test_the_limit_of_torque_alone_is_friction_times_arm():
    bound = np.ones(SHAPE)
    times, _ = load_of(np.array([0.0, 0.0, 2.0])).limit(bound)
    assert 2 * times == pytest.approx(np.sum(np.hypot(X, Y)), rel=1e-12)
    held = TangentialLoad(shift=np.array([1.0, 2.0]), torque=2.0, rotation=ROTATION)
    assert held.limit(bound)[0] == pytest.approx(times, rel=1e-12)


def test_the_limit_of_force_alone_is_friction():
    bound = np.ones(SHAPE)
    times, _ = load_of(np.array([0.6, 0.8, 0.0])).limit(bound)
    assert times == pytest.approx(np.sum(bound), rel=1e-12)


# ---- Moments on the pressure: sums carried exactly, no tension, and the tilt as their multi


TOLERANCE = 1e-11
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


@given(carried())
def test_what_other_cells_carry_is_taken_off_force_and_moments(problem):
    rng, cells, target = problem
    elsewhere = ~cells * rng.random(SHAPE)
    by_force, by_approach = (load.less(elsewhere) for load in loads(target))
    assert by_force.total + np.sum(elsewhere) == pytest.approx(target[0])
    assert by_approach.total is None
    for rest in (by_force, by_approach):
        assert not np.any(rest.cells & (elsewhere > 0))
        np.testing.assert_allclose(rest.moments + sums(elsewhere)[1:], target[1:], atol=1e-12)


@given(carried())
def test_a_plane_gap_is_closed_by_its_own_motion(problem):
    rng, _, target = problem
    motion = np.array([2.0, *rng.normal(size=2)])
    by_force, by_approach = (
        load.motion(rng.random(SHAPE), load.closure(motion)) for load in loads(target)
    )
    np.testing.assert_allclose(by_force, motion, atol=1e-9)
    np.testing.assert_allclose(by_approach, motion, atol=1e-9)


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
