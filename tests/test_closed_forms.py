"""Tests of closed forms by integrals, laws and other closed forms.

Verification cases compare the displacement of their tractions with that of the solvers.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from verification.closed_forms.cattaneo_mindlin import GrownContact, PartialSlip
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.closed_forms.hertz import PointContact, contact_modulus, tangential_modulus
from verification.closed_forms.huber_stress import (
    hamilton_stress,
    stress_by_hertz_pressure,
    stress_by_hertz_shear,
    trailing_edge_tension,
)
from verification.closed_forms.torsion import StuckTorsion


def disc_integral(function, radius, edges=()):
    """Integral of a radial function over a disc, split at square-root edges."""
    edges = [0.0, *sorted(e for e in edges if 0 < e < radius), radius]
    total = 0.0
    for low, high in pairwise(edges):
        # the cosine map makes square-root ends smooth
        def integrand(t, low=low, high=high):
            r = low + (high - low) * (1 - np.cos(t)) / 2
            return 2 * np.pi * r * function(r) * (high - low) * np.sin(t) / 2

        total += quad(integrand, 0, np.pi, epsabs=1e-14, epsrel=1e-12)[0]
    return total


# ---- Cattaneo and Mindlin


LOAD = 0.8
BALL_RADIUS = 3.0
MU = 0.25
BODY = (2.1, 0.0)
E_ALIKE = contact_modulus(BODY)
G_STAR = tangential_modulus(BODY)
HERTZ = PointContact.under_load(LOAD, BALL_RADIUS, E_ALIKE)
LIMIT = MU * LOAD
A = HERTZ.contact_radius
VIRGIN = PartialSlip(LOAD, A, MU, G_STAR, 0.0)


def cattaneo(ratio):
    return replace(VIRGIN, tangential_force=ratio * LIMIT)


@pytest.mark.parametrize("ratio", [0.05, 0.3, 0.6, 0.9, 0.999, 1.0, -0.9])
def test_shear_integrates_to_tangential_force(ratio):
    state = cattaneo(ratio)
    force = disc_integral(state.shear, A, [state.stick_radius])
    assert force == pytest.approx(ratio * LIMIT, rel=1e-10)


@given(ratio=st.floats(-1, 1))
def test_shear_obeys_coulomb_and_opposes_slip(ratio):
    state = cattaneo(ratio)
    r = A * np.linspace(0, 1, 101)
    bound = MU * HERTZ.pressure(r)
    shear, slip = state.shear(r), state.slip(r)
    rounding = 1e-13 * MU * HERTZ.peak_pressure
    assert np.all(np.abs(shear) <= bound + rounding)
    slipping = r > state.stick_radius
    np.testing.assert_allclose(np.abs(shear[slipping]), bound[slipping], atol=rounding)
    assert np.all(slip[~slipping] == 0)
    assert np.all(slip * shear <= 0)


def test_growth_without_slip_carries_the_force_within_the_limit():
    """Also after a growing and a falling tangential force; equal rates are one step."""
    half, full = (PointContact.under_load(part * LOAD, BALL_RADIUS, E_ALIKE) for part in (0.5, 1.0))
    rates = 0.7 * MU, -0.9 * MU
    grown = GrownContact((half, full), rates, E_ALIKE / G_STAR)
    force = disc_integral(grown.shear, full.contact_radius, [half.contact_radius])
    assert force == pytest.approx(grown.tangential_force, rel=1e-8)
    assert grown.tangential_force == pytest.approx(sum(rates) * LOAD / 2)
    r = full.contact_radius * np.linspace(0, 1, 60)
    assert np.all(np.abs(grown.shear(r)) <= MU * full.pressure(r) * (1 + 1e-12))
    at_once, again = (
        GrownContact(contacts, (MU,) * len(contacts), E_ALIKE / G_STAR)
        for contacts in ((full,), (half, full))
    )
    assert again.shift == pytest.approx(at_once.shift)
    # At the friction limit the shift is that at gross slip (Cattaneo and Mindlin).
    assert at_once.shift == pytest.approx(VIRGIN.sliding_shift)


# ---- Torsion and tilt


def test_the_shear_of_stuck_torsion_carries_the_torque():
    state = StuckTorsion(A, 0.7, 0.3)
    torque = disc_integral(lambda r: r * state.shear(r), A)
    assert torque == pytest.approx(0.3, rel=1e-12)
    assert state.shear(1.1 * A) == 0
    assert state.twist == pytest.approx(3 * 0.3 / (16 * A**3 * 0.7))


def test_pressure_of_a_tilted_punch_carries_force_and_moments():
    at = np.array([0.1, -0.15])
    state = FlatPunchContact(0.9, 1.9, 1.3, tuple(at))
    # r = a sin t: the root at the rim cancels.
    t = (np.arange(64) + 0.5)[:, None] * np.pi / 128
    phi = (np.arange(64) + 0.5) * np.pi / 32
    places = 0.9 * np.sin(t) * np.stack([np.cos(phi), np.sin(phi)])[:, None]
    weight = 0.9**2 * np.sin(t) * np.cos(t) * (np.pi / 128) * (np.pi / 32)
    force = state.pressure(*places) * weight
    assert np.sum(force) == pytest.approx(1.3, rel=1e-3)
    np.testing.assert_allclose(np.sum(force * places, axis=(1, 2)), 1.3 * at, rtol=2e-3)


# ---- Stress


def test_hamiltons_stress_is_that_of_sliding_at_the_surface() -> None:
    x = np.array([-0.5, 0.5, 1.3])
    near = hamilton_stress(x, 0.0, 1e-6, 1.0, 0.0, 1.0, 0.3)[0]
    np.testing.assert_allclose(near, stress_by_hertz_shear(x, 1.0, 1.0, 0.3), atol=1e-5)


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("mu", [0.0, 0.1, 0.7])
def test_a_sliding_contact_is_most_in_tension_at_its_trailing_edge(nu: float, mu: float) -> None:
    x = np.linspace(-3, 3, 6001)
    stress = stress_by_hertz_pressure(x, 1.0, 2.0, nu) + stress_by_hertz_shear(x, 1.0, 2 * mu, nu)
    assert np.max(stress) == pytest.approx(trailing_edge_tension(2.0, mu, nu), rel=1e-9, abs=1e-12)
    if mu > 0:
        assert x[np.argmax(stress)] == pytest.approx(-1.0, abs=1e-9)
