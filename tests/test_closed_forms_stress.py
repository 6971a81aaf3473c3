"""Tests of closed forms of the stress below a contact: equilibrium, boundary values, point
forces."""

import numpy as np
import pytest
from scipy.integrate import quad

from verification.closed_forms.flat_punch import TiltedPunch
from verification.closed_forms.huber_stress import (
    hamilton_stress,
    stress_by_hertz_pressure,
    stress_by_hertz_shear,
    trailing_edge_tension,
)
from verification.closed_forms.torsion import (
    StuckTorsion,
)


def test_hamiltons_stress_is_that_of_sliding_at_the_surface() -> None:
    x = np.array([-0.5, 0.5, 1.3])
    near = hamilton_stress(x, 0.0, 1e-6, 1.0, 0.0, 1.0, 0.3)[0]
    np.testing.assert_allclose(near, stress_by_hertz_shear(x, 1.0, 1.0, 0.3), atol=1e-5)


POISSON_RATIOS = [0.0, 0.3, 0.5]


@pytest.mark.parametrize("nu", POISSON_RATIOS)
@pytest.mark.parametrize("mu", [0.0, 0.1, 0.7])
def test_a_sliding_contact_is_most_in_tension_at_its_trailing_edge(nu: float, mu: float) -> None:
    x = np.linspace(-3, 3, 6001)
    stress = stress_by_hertz_pressure(x, 1.0, 2.0, nu) + stress_by_hertz_shear(x, 1.0, 2 * mu, nu)
    assert np.max(stress) == pytest.approx(trailing_edge_tension(2.0, mu, nu), rel=1e-9, abs=1e-12)
    if mu > 0:
        assert x[np.argmax(stress)] == pytest.approx(-1.0, abs=1e-9)


TWIST_A = 0.9
TWIST_PEAK = 1.3
MU = 0.25
MODULUS = 0.7


def test_stuck_torsion():
    state = StuckTorsion(TWIST_A, MODULUS, 0.3)
    moment, _ = quad(
        lambda t: (
            2
            * np.pi
            * (TWIST_A * np.sin(t)) ** 2
            * state.shear(TWIST_A * np.sin(t))
            * TWIST_A
            * np.cos(t)
        ),
        0,
        np.pi / 2,
    )
    assert moment == pytest.approx(0.3, rel=1e-12)
    assert state.shear(1.1 * TWIST_A) == 0
    assert state.twist == pytest.approx(3 * 0.3 / (16 * TWIST_A**3 * MODULUS))


E = 1.9
W = 1.3


def punch(e_x=0.1, e_y=-0.15):
    return TiltedPunch(TWIST_A, E, W, (e_x, e_y))


def test_pressure_of_a_tilted_punch_carries_force_and_moments():
    state = punch()
    # r = a sin t: the root at the rim cancels.
    t = (np.arange(64) + 0.5) * np.pi / 128
    phi = (np.arange(64) + 0.5) * np.pi / 32
    x = TWIST_A * np.sin(t)[:, None] * np.cos(phi)
    y = TWIST_A * np.sin(t)[:, None] * np.sin(phi)
    weight = TWIST_A**2 * (np.sin(t) * np.cos(t))[:, None] * (np.pi / 128) * (np.pi / 32)
    p = state.pressure(x, y) * weight
    assert np.sum(p) == pytest.approx(W, rel=1e-3)
    e_x, e_y = state.eccentricity
    np.testing.assert_allclose([np.sum(p * x), np.sum(p * y)], [W * e_x, W * e_y], rtol=2e-3)
