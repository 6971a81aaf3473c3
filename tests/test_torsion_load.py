"""Torque on the shear: forces carried exactly, discs kept, and what friction can carry."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from semi_analytical.admissible_shear import magnitude
from semi_analytical.torsion import ShearMoments

SHAPE = (4, 5)
Y, X = np.meshgrid(np.arange(5) - 2.0, np.arange(4) - 1.5)
ROTATION = np.stack([-Y, X])


def forces(q):
    return np.array([*np.sum(q, axis=(1, 2)), np.sum(q * ROTATION)])


def load_of(target):
    return ShearMoments(ROTATION, float(target[2]), total=target[:2])


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
    slips = magnitude(sum(v * u for v, u in zip(velocity, load.units, strict=True))) > 1e-6
    # A cell at the pole of the motion moves so little that its shear hardly changes the power.
    unsure = 1e-5 * np.sum(bound) + 1e-3 * np.sum(bound[~slips])
    np.testing.assert_allclose(forces(q), times * forces_of(load), atol=unsure)
    assert np.all(magnitude(q) <= bound * (1 + 1e-12))
    np.testing.assert_allclose(magnitude(q)[slips], bound[slips])
    # The power of friction in that motion bounds the work of every admissible shear.
    speed = sum(v * unit for v, unit in zip(velocity, load.units, strict=True))
    other = discs(bound, rng)
    assert np.sum(other * speed) <= times * (1 + 1e-9)
    assert load_of(0.999 * times * forces_of(load)).exhausts(bound) is False
    assert load_of(1.001 * times * forces_of(load)).exhausts(bound) is True


def test_the_limit_of_torque_alone_is_friction_times_arm():
    bound = np.ones(SHAPE)
    times, _ = load_of(np.array([0.0, 0.0, 2.0])).limit(bound)
    assert 2 * times == pytest.approx(np.sum(np.hypot(X, Y)), rel=1e-12)
    held = ShearMoments(ROTATION, 2.0, shift=np.array([1.0, 2.0]))
    assert held.limit(bound)[0] == pytest.approx(times, rel=1e-12)


def test_the_limit_of_force_alone_is_friction():
    bound = np.ones(SHAPE)
    times, _ = load_of(np.array([0.6, 0.8, 0.0])).limit(bound)
    assert times == pytest.approx(np.sum(bound), rel=1e-12)
