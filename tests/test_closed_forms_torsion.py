"""Torsion: equilibrium, Coulomb's bound, rigid rotation of the stick disc, tabulated values."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from surface_quadrature import ray_integral

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
