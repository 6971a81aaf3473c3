"""Tests of closed forms by their integrals, where the quick level does not see an error of 2 %.

It compares Cattaneo's contact and the stress of sliding balls with the solvers closely enough.
"""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad

from verification.closed_forms.cattaneo_mindlin import GrownContact, PartialSlip
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.closed_forms.hertz import PointContact, contact_modulus, tangential_modulus
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


LOAD = 0.8
MU = 0.25
BODY = (2.1, 0.0)


def test_growth_without_slip_carries_the_force_within_the_limit():
    """Also after a growing and a falling tangential force; equal rates are one step."""
    normal, tangential = contact_modulus(BODY), tangential_modulus(BODY)
    half, full = (PointContact.under_load(part * LOAD, 3.0, normal) for part in (0.5, 1.0))
    rates = 0.7 * MU, -0.9 * MU
    grown = GrownContact((half, full), rates, normal / tangential)
    force = disc_integral(grown.shear, full.contact_radius, [half.contact_radius])
    assert force == pytest.approx(grown.tangential_force, rel=1e-8)
    assert grown.tangential_force == pytest.approx(sum(rates) * LOAD / 2)
    r = full.contact_radius * np.linspace(0, 1, 60)
    assert np.all(np.abs(grown.shear(r)) <= MU * full.pressure(r) * (1 + 1e-12))
    at_once, again = (
        GrownContact(contacts, (MU,) * len(contacts), normal / tangential)
        for contacts in ((full,), (half, full))
    )
    assert again.shift == pytest.approx(at_once.shift)
    # At the friction limit the shift is that at gross slip (Cattaneo and Mindlin).
    virgin = PartialSlip(LOAD, full.contact_radius, MU, tangential, 0.0)
    assert at_once.shift == pytest.approx(virgin.sliding_shift)


def test_the_shear_of_stuck_torsion_carries_the_torque():
    state = StuckTorsion(0.9, 0.7, 0.3)
    torque = disc_integral(lambda r: r * state.shear(r), 0.9)
    assert torque == pytest.approx(0.3, rel=1e-12)
    assert state.shear(1.0) == 0
    assert state.twist == pytest.approx(3 * 0.3 / (16 * 0.9**3 * 0.7))


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
