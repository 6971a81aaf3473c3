"""Torque on the shear: forces carried exactly, discs kept, and what friction can carry."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, graded_inverse
from scipy.optimize import minimize

from semi_analytical.admissible_shear import magnitude
from semi_analytical.linearised_shear import Point
from semi_analytical.tangential import solve_tangential
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


def test_loads_a_hair_below_their_limit_are_carried_by_any_shear():
    """Their multipliers are hundreds of times the shear."""
    for seed in range(200):
        rng = np.random.default_rng(seed)
        bound = rng.random(SHAPE)
        y = 10 ** rng.uniform(0, 4) * rng.standard_normal((2, *SHAPE))
        load = load_of(forces(discs(bound, rng)))
        load = load_of((1 - 1e-5) * load.limit(bound)[0] * forces_of(load))
        np.testing.assert_allclose(forces(load.admissible(y, bound)), forces_of(load), atol=1e-8)


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


@pytest.mark.parametrize("shift", [None, np.array([0.3, -0.2])], ids=["forces", "given shift"])
def test_a_general_optimiser_finds_no_lower_energy(shift, rng):
    bound = 0.2 + rng.random(SHAPE)
    A, target = compliance(rng, 2 * X.size), rng.standard_normal((2, *SHAPE))
    total = None if shift is not None else np.array([1.5, -0.6])
    load = ShearMoments(ROTATION, 4.0, total, shift)
    motion = np.zeros(3) if shift is None else np.array([*shift, 0.0])
    at_rest = np.zeros_like(target)
    solution = solve_tangential(
        as_map(A), graded_inverse(A), bound, target, load, Point(at_rest, at_rest), motion,
        float(np.mean(np.diag(A))), 1e-11,
    )  # fmt: skip
    pull = target if shift is None else target + shift[:, None, None]

    def energy(q):
        return 0.5 * q @ A @ q - pull.ravel() @ q

    n = X.size
    limits = [
        {"type": "ineq", "fun": lambda q: bound.ravel() ** 2 - q[:n] ** 2 - q[n:] ** 2},
        {"type": "eq", "fun": lambda q: np.sum(q * ROTATION.ravel()) - 4.0},
    ]
    if total is not None:
        limits.append({"type": "eq", "fun": lambda q: q.reshape(2, n).sum(axis=1) - total})
    best = minimize(
        energy, np.zeros(2 * n), jac=lambda q: A @ q - pull.ravel(), method="SLSQP",
        constraints=limits, options={"ftol": 1e-15, "maxiter": 1000},
    )  # fmt: skip
    assert energy(solution.shear.ravel()) <= best.fun + 1e-9 * abs(best.fun)
    np.testing.assert_allclose(solution.shear.ravel(), best.x, atol=1e-5)
    slip = load.rigid(solution.motion) + target - as_map(A)(solution.shear)
    assert np.max(magnitude(slip)[~solution.in_slip]) <= 1e-8
    if shift is not None:
        np.testing.assert_array_equal(solution.shift, shift)
