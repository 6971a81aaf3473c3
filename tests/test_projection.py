"""Tests of projections of shear onto prescribed forces and torques within friction limits."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from random_compliance import pushed

from contact_solver.admissible_shear import admissible_shear, magnitude, project_trial
from contact_solver.gross_slip import exhausts_friction, full_slip, limit_load

Y, X = (one.ravel() for one in np.meshgrid(np.arange(5) - 2.0, np.arange(4) - 1.5))
POINTS = X.size
ROTATION = np.stack([-Y, X])


def forces(q):
    return np.array([*np.sum(q, axis=1), np.sum(q * ROTATION)])


def load_of(target):
    return pushed(target[:2], turn=ROTATION, torque=float(target[2]))


def discs(bound, rng):
    """A shear within the discs."""
    angle = 2 * np.pi * rng.random(POINTS)
    return rng.random(POINTS) * bound * np.stack([np.cos(angle), np.sin(angle)])


@st.composite
def problems(draw):
    """Any shear, a friction limit with zeros in it, and forces that it can carry."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    bound = rng.random(POINTS) * (rng.random(POINTS) < 0.8)
    assume(np.count_nonzero(bound) >= 4)
    y = draw(st.sampled_from([1e-3, 1.0, 1e3])) * rng.standard_normal((2, POINTS))
    load = load_of(forces(discs(bound, rng)))
    part = draw(st.sampled_from([0.0, 0.5, 0.99, 0.9999])) * limit_load(load, bound)[0]
    return rng, y, bound, load_of(part * forces_of(load))


def forces_of(load):
    return load.prescribed_forces


@given(problems())
def test_projection_is_feasible(problem):
    _, y, bound, load = problem
    q = admissible_shear(load, y, bound)
    assert np.all(magnitude(q) <= bound * (1 + 1e-12))
    blur = 1e-11 * (np.max(bound) + 1e-3 * np.max(np.abs(y)))
    np.testing.assert_allclose(forces(q), forces_of(load), atol=X.size * blur)


@pytest.mark.parametrize("below", [1e-3, 1e-5])
def test_a_force_near_its_limit_is_found_from_a_far_guess(below):
    """All points slip at the guess: a Newton step exceeds the correction by far."""
    bound, force = np.ones(POINTS), POINTS * (1 - below)
    y = np.stack([np.linspace(0, 1, POINTS), np.zeros(POINTS)])
    q, _ = project_trial(pushed((force, 0.0)), y, bound, 1.0, np.array([1e3, 0.0]))
    assert np.sum(q[0]) == pytest.approx(force, rel=1e-12)


@given(problems())
def test_nothing_admissible_is_nearer(problem):
    """The variational inequality (y - q)·(z - q) <= 0 for every admissible z."""
    rng, y, bound, load = problem
    q = admissible_shear(load, y, bound)
    z = admissible_shear(load, rng.standard_normal(y.shape) * np.max(np.abs(y)), bound)
    scale = np.max(np.abs(y - q)) * np.sum(bound)
    assert np.sum((y - q) * (z - q)) <= 1e-9 * scale


@given(problems())
def test_at_its_limit_a_load_is_carried_by_full_slip_alone(problem):
    rng, _, bound, load = problem
    load = load_of(forces(discs(bound, rng)))
    times, velocity = limit_load(load, bound)
    q, _ = full_slip(load_of(times * forces_of(load)), bound, np.zeros(3))
    speed = load.displacement(velocity)
    moves = magnitude(speed)
    # Smoothing at the pole of the motion, 1e-8 of the largest speed, reduces the shear by less than
    # 1e-8 of itself in these cells. Shear in other cells hardly changes the power.
    slips = moves > 1e-4 * np.max(moves)
    unsure = 1e-5 * np.sum(bound) + 1e-3 * np.sum(bound[~slips])
    np.testing.assert_allclose(forces(q), times * forces_of(load), atol=unsure)
    assert np.all(magnitude(q) <= bound * (1 + 1e-12))
    np.testing.assert_allclose(magnitude(q)[slips], bound[slips])
    # The power of friction in that motion bounds the work of every admissible shear.
    other = discs(bound, rng)
    assert np.sum(other * speed) <= times * (1 + 1e-9)
    assert exhausts_friction(load_of(0.999 * times * forces_of(load)), bound) is False
    assert exhausts_friction(load_of(1.001 * times * forces_of(load)), bound) is True


def test_the_limit_of_torque_alone_is_friction_times_arm():
    bound = np.ones(POINTS)
    times, _ = limit_load(load_of(np.array([0.0, 0.0, 2.0])), bound)
    assert 2 * times == pytest.approx(np.sum(np.hypot(X, Y)), rel=1e-12)
    led = pushed(shift=(1.0, 2.0), turn=ROTATION, torque=2.0)
    assert limit_load(led.held, bound)[0] == pytest.approx(times, rel=1e-12)
