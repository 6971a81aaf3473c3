"""Return of a trial shear to Coulomb's cone, and pressure by overlap: laws at a single point."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from contact_scene import CoulombFriction
from fem_reference.contact.penalty.coulomb_return import coulomb_return
from fem_reference.contact.penalty.law import Penalty, penalty_pressure, penalty_stiffness
from fem_reference.contact.penalty.spring_contact import PenaltyLaw

# Sums of squares of these neither overflow nor vanish.
SIZES = st.floats(-1e6, 1e6).filter(lambda x: x == 0 or abs(x) > 1e-6)
POINTS = 5


def shears(components: int):
    return arrays(np.float64, (components, POINTS), elements=SIZES)


EITHER = st.integers(1, 2).flatmap(shears)
LIMITS = arrays(np.float64, POINTS, elements=st.just(0.0) | st.floats(1e-6, 1e6))


@given(EITHER, LIMITS)
def test_shear_is_in_the_cone(trial, limit) -> None:
    returned = coulomb_return(trial, limit)
    size = np.sqrt(np.sum(returned.shear**2, axis=0))
    assert np.all(size <= limit * (1 + 1e-15))
    assert size[returned.in_slip] == pytest.approx(limit[returned.in_slip], rel=1e-14)


@given(EITHER, LIMITS)
def test_stick_keeps_the_trial_shear(trial, limit) -> None:
    returned = coulomb_return(trial, limit)
    stuck = ~returned.in_slip
    assert np.array_equal(returned.shear[:, stuck], trial[:, stuck])
    assert np.all(np.sqrt(np.sum(trial**2, axis=0))[returned.in_slip] > limit[returned.in_slip])


@given(EITHER, LIMITS)
def test_slip_scales_the_trial_shear_back(trial, limit) -> None:
    """In closed form q = µp t/|t|: the direction is that of the trial shear."""
    returned = coulomb_return(trial, limit)
    for point in np.flatnonzero(returned.in_slip):
        expected = limit[point] * trial[:, point] / np.linalg.norm(trial[:, point])
        assert returned.shear[:, point] == pytest.approx(expected, rel=1e-12, abs=1e-9)


@given(EITHER, LIMITS)
def test_one_component_is_the_other_on_a_line(trial, limit) -> None:
    """The scalar law is the vector law along one direction."""
    scalar = coulomb_return(trial[:1], limit)
    vector = coulomb_return(np.vstack([trial[:1], np.zeros((1, POINTS))]), limit)
    assert np.array_equal(vector.shear[:1], scalar.shear)
    assert np.array_equal(vector.in_slip, scalar.in_slip)


@given(shears(2), LIMITS, st.floats(0, 2 * np.pi))
def test_return_turns_with_the_trial_shear(trial, limit, angle) -> None:
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    turned = coulomb_return(turn @ trial, limit).shear
    assert turned == pytest.approx(turn @ coulomb_return(trial, limit).shear, rel=1e-9, abs=1e-6)


@given(EITHER, LIMITS, st.data())
def test_return_is_the_nearest_point(trial, limit, data) -> None:
    """Of the disc, hence the work of slip is the largest (maximum dissipation)."""
    returned = coulomb_return(trial, limit)
    other = data.draw(arrays(np.float64, trial.shape, elements=SIZES))
    size = np.sqrt(np.sum(other**2, axis=0))
    other = np.where(size > limit, other * (limit / np.where(size > 0, size, 1.0)), other)
    slip = trial - returned.shear
    scale = np.sum(trial**2, axis=0) + limit**2
    assert np.all(np.sum(slip * (returned.shear - other), axis=0) >= -1e-12 * scale)


@given(EITHER, EITHER, LIMITS)
def test_return_never_drives_apart(one, other, limit) -> None:
    """|q(a) − q(b)| ≤ |a − b|: a projection on a convex set."""
    assume(one.shape == other.shape)
    near, far = coulomb_return(one, limit).shear, coulomb_return(other, limit).shear
    apart = np.sqrt(np.sum((near - far) ** 2, axis=0))
    scale = np.sqrt(np.sum(one**2 + other**2, axis=0))
    assert np.all(apart <= np.sqrt(np.sum((one - other) ** 2, axis=0)) + 1e-9 * scale)


@given(EITHER, LIMITS)
def test_slip_never_returns_energy(trial, limit) -> None:
    returned = coulomb_return(trial, limit)
    work = np.sum(returned.shear * (trial - returned.shear), axis=0)
    assert np.all(work >= -1e-12 * np.sum(trial**2, axis=0))


@pytest.mark.parametrize("components", [1, 2])
def test_tangent_is_the_derivative(components: int, rng) -> None:
    """By central differences away from the kink between stick and slip."""
    trial = rng.standard_normal((components, 200))
    limit = rng.uniform(0.1, 2.0, 200)
    size = np.sqrt(np.sum(trial**2, axis=0))
    away = np.abs(size - limit) > 1e-3
    trial, limit, h = trial[:, away], limit[away], 1e-6
    returned = coulomb_return(trial, limit)
    assert 10 < np.count_nonzero(returned.in_slip) < len(limit) - 10
    for component in range(components):
        step = np.zeros_like(trial)
        step[component] = h
        ahead, behind = (coulomb_return(trial + x, limit).shear for x in (step, -step))
        assert returned.by_trial[:, component] == pytest.approx(
            (ahead - behind) / (2 * h), abs=1e-6
        )
    ahead, behind = (coulomb_return(trial, limit + x).shear for x in (h, -h))
    assert returned.by_limit == pytest.approx((ahead - behind) / (2 * h), abs=1e-6)


@pytest.mark.parametrize("components", [0, 1, 2])
def test_tangent_of_the_whole_law_is_its_derivative(components: int, rng) -> None:
    n, c = 300, components + 1
    multiplier = 0.3 * rng.standard_normal((c, n))
    law = PenaltyLaw(
        2.0,
        CoulombFriction(coefficient=0.4),
        multiplier,
        0.2 * rng.standard_normal((components, n)),
    )
    overlap = rng.standard_normal((c, n))
    p = law.response(overlap).traction[0]
    size = np.sqrt(np.sum(law.trial_shear(overlap[1:]) ** 2, axis=0))
    near = np.abs(multiplier[0] + law.stiffness * overlap[0]) < 1e-3
    if components:
        near |= np.abs(size - law.friction.largest * p) < 1e-3
    assert np.count_nonzero(near) < n / 10
    tangent, h = law.response(overlap).tangent, 1e-6
    for component in range(c):
        step = np.zeros_like(overlap)
        step[component] = h
        ahead, behind = (law.response(overlap + x).traction for x in (step, -step))
        difference = (ahead - behind) / (2 * h)
        assert tangent[:, component, ~near] == pytest.approx(difference[:, ~near], abs=1e-6)


@given(arrays(np.float64, POINTS, elements=SIZES), st.floats(0.0, 1e3))
def test_pressure_only_pushes(gap, multiplier) -> None:
    p = penalty_pressure(gap, 3.0, multiplier)
    assert np.all(p >= 0)
    assert np.all(p[gap >= multiplier / 3.0 + 1e-9 * multiplier] == 0)
    overlapping = gap < 0
    assert p[overlapping] == pytest.approx(multiplier - 3.0 * gap[overlapping])


def test_penalty_follows_material_and_mesh() -> None:
    assert penalty_stiffness(Penalty(10.0), 200e9, 1e-6) == pytest.approx(2e18)


@pytest.mark.parametrize("wrong", [{"factor": 0.0}, {"factor": np.inf}, {"augmentations": -1}])
def test_meaningless_penalty_is_refused(wrong) -> None:
    with pytest.raises(ValueError, match=r"penalty|augmentations"):
        Penalty(**wrong)
