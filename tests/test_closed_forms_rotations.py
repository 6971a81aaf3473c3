"""Tilted punch and coated torsion: equilibrium, rigid motion of what sticks, limits."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from verification.closed_forms.coated_torsion import CoatedTorsion, TorsionalSurface, one_layer
from verification.closed_forms.tilted_punch import TiltedPunch
from verification.closed_forms.torsion import TorsionalPartialSlip

A, E, W = 0.7, 1.9, 1.3
PEAK, MU, G = 1.3, 0.25, 0.7


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


def twisted(ratio=0.6, **layer):
    return CoatedTorsion(coated(**layer), A, limit, ratio * A)


@pytest.mark.parametrize("ratio", [0.15, 0.5, 0.8, 0.99])
def test_a_layer_of_the_same_material_is_none(ratio):
    state = twisted(ratio, coating=G, base=G)
    plain = TorsionalPartialSlip(A, PEAK, MU, G, ratio * A)
    assert state.twist == pytest.approx(plain.twist, rel=1e-12)
    assert state.torque == pytest.approx(plain.moment, rel=1e-12)
    assert state.sliding_torque == pytest.approx(plain.sliding_moment, rel=1e-12)


@given(
    ratio=st.floats(0.11, 0.99),
    thickness=st.floats(0.1, 3.0),
    contrast=st.sampled_from([0.05, 0.3, 3.0, 20.0]),
)
def test_the_stick_disc_of_coated_bodies_turns_rigidly(ratio, thickness, contrast):
    state = twisted(ratio, thickness=thickness, coating=1.0, base=contrast)
    r = ratio * A * np.array([0.1, 0.6, 1.0])
    np.testing.assert_allclose(state.displacement(r), state.twist * r, rtol=1e-10)
    assert 0 < state.torque < state.sliding_torque
