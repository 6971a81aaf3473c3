"""Tests of closed forms of normal and tangential contact by quadrature and by other closed
forms."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from surface_quadrature import normal_displacement, tangential_displacement

from semi_analytical.frf.stack import Stack
from semi_analytical.frf.surface import scalars
from verification.closed_forms.cattaneo_mindlin import GrownContact, PartialSlip
from verification.closed_forms.coated_indentation import (
    LayeredSurface,
    paraboloid_under,
)
from verification.closed_forms.flat_punch import ConeContact
from verification.closed_forms.hertz import (
    EllipticalContact,
    PointContact,
    SphereContact,
    contact_modulus,
    tangential_modulus,
)
from verification.references import load_reference

E_STAR = 1.7
# Contact of a radius, slope f' and curvature f'' of the profile.
PROFILES = {
    "paraboloid": (
        lambda a: PointContact(3.0, E_STAR, a),
        lambda r: r / 3.0,
        lambda r: 1 / 3.0,
    ),
    "sphere": (
        lambda a: SphereContact(3.0, E_STAR, a),
        lambda r: r / np.sqrt(9 - r**2),
        lambda r: 9 / np.sqrt(9 - r**2) ** 3,
    ),
    "cone": (lambda a: ConeContact(0.2, E_STAR, a), lambda r: np.tan(0.2), lambda r: 0.0),
}


def integral(function, start, end):
    return quad(function, start, end, epsabs=0, epsrel=1e-11)[0]


@pytest.mark.parametrize("name", PROFILES)
@pytest.mark.parametrize("a", [1e-3, 0.4, 2.0])
def test_integrals_of_the_profile_give_load_approach_and_pressure(name, a):
    """Galin 1946; Sneddon 1965."""
    make, slope, curvature = PROFILES[name]
    closed = make(a)

    def penetration(s):
        return s * integral(lambda t: slope(s * np.sin(t)), 0, np.pi / 2)

    def rate(s):
        return integral(
            lambda t: slope(s * np.sin(t)) + s * np.sin(t) * curvature(s * np.sin(t)), 0, np.pi / 2
        )

    assert penetration(a) == pytest.approx(closed.approach, rel=1e-10)
    assert 2 * E_STAR * integral(lambda s: s * rate(s), 0, a) == pytest.approx(
        closed.load, rel=1e-10
    )
    for r in (0.3 * a, 0.9 * a):  # s² = r² + u² removes the root
        pressure = integral(
            lambda u, r=r: rate(np.hypot(r, u)) / np.hypot(r, u), 0, np.sqrt(a**2 - r**2)
        )
        assert E_STAR / np.pi * pressure == pytest.approx(float(closed.pressure(r)), rel=1e-9)


# ---- Elliptical contact


@pytest.mark.parametrize("at", [(0.0, 0.0), (0.5, 0.0), (0.0, 0.6), (0.4, -0.5)])
def test_elliptical_pressure_makes_the_surface_a_paraboloid(at):
    contact = EllipticalContact.under_load(0.8, (4.0, 1.5), E_STAR)
    x, y = at[0] * contact.semi_axes[0], at[1] * contact.semi_axes[1]
    expected = contact.approach - x**2 / 8 - y**2 / 3
    by_quadrature = normal_displacement(contact.pressure, (x, y), [contact.semi_axes], E_STAR)
    assert by_quadrature == pytest.approx(expected, rel=1e-11)


ROWS = load_reference("coated_frictionless_paraboloid")["rows"]
RADIUS = 10.0


def surface(stack: Stack) -> LayeredSurface:
    G, nu = stack.outer
    return LayeredSurface(
        lambda k: scalars(stack, k).c22, 2 * G / (1 - nu), stack.layers[0].thickness
    )


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"E1/E2 = {row['E1_over_E2']}")
def test_paraboloid_on_a_coating_is_the_reference(row: dict) -> None:
    G2, nu2 = 1.0, row["nu2"]
    # Units in which the Hertz radius is one.
    modulus = 2 * G2 / (1 - nu2)
    load = 4 * modulus / (3 * RADIUS)
    G1 = row["E1_over_E2"] * G2 * (1 + nu2) / (1 + row["nu1"])
    stack = Stack([(G1, row["nu1"], row["h_over_aH"])], (G2, nu2))
    contact = paraboloid_under(load, surface(stack), RADIUS)
    assert contact.contact_radius == pytest.approx(row["a_over_aH"], rel=1e-12)
    assert contact.approach * RADIUS == pytest.approx(row["delta_over_deltaH"], rel=1e-12)
    r = contact.contact_radius * np.array(row["r_over_a"])
    peak = 1.5 * load / np.pi
    np.testing.assert_allclose(contact.pressure(r) / peak, row["p_over_pH"], rtol=1e-12)


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

ratios = st.floats(-1, 1)
LOADED = [0.05, 0.3, 0.6, 0.9, 0.999, 1.0, -0.9]


def cattaneo(ratio):
    return replace(VIRGIN, tangential_force=ratio * LIMIT)


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


@pytest.mark.parametrize("ratio", LOADED)
def test_shear_integrates_to_tangential_force(ratio):
    state = cattaneo(ratio)
    force = disc_integral(state.shear, A, [state.stick_radius])
    assert force == pytest.approx(ratio * LIMIT, rel=1e-10)


@given(ratio=ratios)
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


@pytest.mark.parametrize("ratio", [0.3, 0.9])
@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_stick_zone_moves_rigidly_for_every_poisson_ratio(ratio, nu):
    modulus = 2.1 / (2 * (1 + nu))
    state = replace(cattaneo(ratio), tangential_modulus=tangential_modulus((2.1, nu)))
    c = state.stick_radius
    for x, y in [(0.0, 0.0), (0.5 * c, 0.3 * c), (0.0, -0.8 * c)]:
        along, across = tangential_displacement(
            lambda x, y: state.shear(np.hypot(x, y)), (x, y), [(c, c), (A, A)], modulus, nu
        )
        assert along == pytest.approx(state.shift, rel=1e-9)
        assert across == pytest.approx(0, abs=1e-9 * state.shift)


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
    a = full.contact_radius
    assert at_once.shift == pytest.approx(PartialSlip(LOAD, a, MU, G_STAR, 0.0).sliding_shift)
