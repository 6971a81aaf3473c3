"""Torsion: equilibrium, Coulomb's bound, rigid rotation of the stick disc, tabulated values."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from surface_quadrature import ray_integral

from verification.closed_forms.coated_torsion import CoatedTorsion, TorsionalSurface, one_layer
from verification.closed_forms.tilted_punch import TiltedPunch
from verification.closed_forms.torsion import StuckTorsion, TorsionalPartialSlip

A, PEAK, MU, MODULUS = 0.9, 1.3, 0.25, 0.7
ratios = st.floats(0.01, 1)


def twisted(ratio):
    return TorsionalPartialSlip(A, PEAK, MU, MODULUS, ratio * A)


def moment_of(state, edge):
    """Moment 2π∫q r² dr, each side of the stick edge mapped by a cosine."""
    total = 0.0
    for low, high in [(0.0, edge), (edge, A)]:

        def integrand(t, low=low, high=high):
            r = low + (high - low) * (1 - np.cos(t)) / 2
            return 2 * np.pi * r**2 * state.shear(r) * (high - low) * np.sin(t) / 2

        total += quad(integrand, 0, np.pi, epsabs=1e-13)[0]
    return total


# stick radius / a, twist * G / (µ p0), moment / sliding moment; one elastic body, 9-digit values
@pytest.mark.parametrize(
    ("ratio", "twist", "moment"),
    [(0.5, 0.472729810, 0.897338429), (0.8, 0.166335204, 0.527167509)],
)
def test_torsion_table(ratio, twist, moment):
    state = twisted(ratio)
    assert state.twist * MODULUS / (MU * PEAK) == pytest.approx(twist, abs=6e-10)
    assert state.moment / state.sliding_moment == pytest.approx(moment, abs=6e-10)


@pytest.mark.parametrize("ratio", [0.05, 0.5, 0.8, 0.99])
def test_torsional_shear_carries_the_moment(ratio):
    state = twisted(ratio)
    assert moment_of(state, ratio * A) == pytest.approx(state.moment, rel=1e-9)


@given(ratio=ratios)
def test_torsional_shear_obeys_coulomb(ratio):
    state = twisted(ratio)
    r = A * np.linspace(0, 1, 60)
    bound = MU * PEAK * np.sqrt(1 - (r / A) ** 2)
    assert np.all(state.shear(r) <= bound * (1 + 1e-14))
    assert np.all(state.shear(r) >= -1e-12 * MU * PEAK)
    np.testing.assert_array_equal(state.shear(r)[r > ratio * A], bound[r > ratio * A])


@pytest.mark.parametrize("ratio", [0.5, 0.8])
def test_stick_disc_turns_rigidly(ratio):
    state, c = twisted(ratio), ratio * A

    def across(x, y):
        r = np.hypot(x, y)
        return state.shear(r) * x / r

    for x in (0.3 * c, 0.8 * c):
        # the field is divergence-free, hence the nu = 0 kernel serves every nu
        displacement = ray_integral(
            across, (x, 0.0), [(c, c), (A, A)], lambda phi: 0 * phi + 1 / (2 * np.pi * MODULUS)
        )
        # the logarithm at the axis limits the quadrature, not the formula
        assert displacement == pytest.approx(state.twist * x, rel=1e-4)


def test_stuck_torsion():
    state = StuckTorsion(A, MODULUS, 0.3)
    moment, _ = quad(
        lambda t: 2 * np.pi * (A * np.sin(t)) ** 2 * state.shear(A * np.sin(t)) * A * np.cos(t),
        0,
        np.pi / 2,
    )
    assert moment == pytest.approx(0.3, rel=1e-12)
    assert state.shear(1.1 * A) == 0
    assert state.twist == pytest.approx(3 * 0.3 / (16 * A**3 * MODULUS))


# ---- Tilted punch and coated torsion: equilibrium, rigid motion of what sticks, limits.


E, W = 1.9, 1.3


def punch(e_x=0.1, e_y=-0.15):
    return TiltedPunch(A, E, W, (e_x, e_y))


def test_pressure_of_a_tilted_punch_carries_force_and_moments():
    state = punch()
    # r = a sin t: the root at the rim cancels.
    t = (np.arange(64) + 0.5) * np.pi / 128
    phi = (np.arange(64) + 0.5) * np.pi / 32
    x = A * np.sin(t)[:, None] * np.cos(phi)
    y = A * np.sin(t)[:, None] * np.sin(phi)
    weight = A**2 * (np.sin(t) * np.cos(t))[:, None] * (np.pi / 128) * (np.pi / 32)
    p = state.pressure(x, y) * weight
    assert np.sum(p) == pytest.approx(W, rel=1e-3)
    e_x, e_y = state.eccentricity
    np.testing.assert_allclose([np.sum(p * x), np.sum(p * y)], [W * e_x, W * e_y], rtol=2e-3)


def limit(r):
    return MU * PEAK * np.sqrt(np.maximum(1 - (r / A) ** 2, 0.0))


def coated(thickness=0.4, coating=2.0, base=0.5):
    return TorsionalSurface(lambda k: one_layer(k, thickness, coating, base), coating, thickness)


def twisted_film(ratio=0.6, **layer):
    return CoatedTorsion(coated(**layer), A, limit, ratio * A)


@pytest.mark.parametrize("ratio", [0.15, 0.5, 0.8, 0.99])
def test_a_layer_of_the_same_material_is_none(ratio):
    state = twisted_film(ratio, coating=MODULUS, base=MODULUS)
    plain = TorsionalPartialSlip(A, PEAK, MU, MODULUS, ratio * A)
    assert state.twist == pytest.approx(plain.twist, rel=1e-12)
    assert state.torque == pytest.approx(plain.moment, rel=1e-12)
    assert state.sliding_torque == pytest.approx(plain.sliding_moment, rel=1e-12)


@given(
    ratio=st.floats(0.11, 0.99),
    thickness=st.floats(0.1, 3.0),
    contrast=st.sampled_from([0.05, 0.3, 3.0, 20.0]),
)
def test_the_stick_disc_of_coated_bodies_turns_rigidly(ratio, thickness, contrast):
    state = twisted_film(ratio, thickness=thickness, coating=1.0, base=contrast)
    r = ratio * A * np.array([0.1, 0.6, 1.0])
    np.testing.assert_allclose(state.displacement(r), state.twist * r, rtol=1e-10)
    assert 0 < state.torque < state.sliding_torque
