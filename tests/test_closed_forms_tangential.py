"""Partial slip: equilibrium, Coulomb's bound, rigid stick zone, energy, superposition."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from surface_quadrature import tangential_displacement

from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.ciavarella_jaeger import superpose
from verification.closed_forms.cone import ConeContact
from verification.closed_forms.hertz import PointContact
from verification.closed_forms.moduli import contact_modulus, tangential_modulus
from verification.closed_forms.sphere import SphereContact
from verification.closed_forms.tangential_history import TangentialHistory

LOAD, RADIUS, MU = 0.8, 3.0, 0.25
BODY = (2.1, 0.0)
E_STAR, G_STAR = contact_modulus(BODY), tangential_modulus(BODY)
HERTZ = PointContact.under_load(LOAD, RADIUS, E_STAR)
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


# --- Cattaneo–Mindlin


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


@given(ratio=st.floats(0.001, 0.99))
def test_stiffness_is_the_slope_of_force_against_shift(ratio):
    step = 1e-5 * min(ratio, 1 - ratio)
    rise = cattaneo(ratio + step).shift - cattaneo(ratio - step).shift
    # central difference: rounding 1e-16/1e-8 dominates
    assert 2 * step * LIMIT / rise == pytest.approx(cattaneo(ratio).stiffness, rel=1e-6)


# --- energy


# --- histories of the force


@given(forces=st.lists(ratios, min_size=1, max_size=5))
def test_history_balances_energy_and_obeys_coulomb(forces):
    state, work = TangentialHistory(VIRGIN), 0.0
    nodes, weights = np.polynomial.legendre.leggauss(20)
    for ratio in forces:
        start, end = state, ratio * LIMIT
        # ∫T dδ = [Tδ] - ∫δ dT, in pieces ending where an old turning point is forgotten
        turning = (*state.turning_points, state.tangential_force)
        kinks = sorted({*turning, *(-force for force in turning)})
        low, high = sorted((state.tangential_force, end))
        stops = [low, *(k for k in kinks if low < k < high), high]
        if end < state.tangential_force:
            stops.reverse()
        area = 0.0
        for left, right in pairwise(stops):
            # cosine map: shifts end in fractional powers
            t = np.pi * (nodes + 1) / 2
            path = left + (right - left) * (1 - np.cos(t)) / 2
            shifts = np.array([start.loaded_to(force).shift for force in path])
            area += (right - left) * (shifts * np.sin(t) * weights).sum() * np.pi / 4
        state = state.loaded_to(end)
        work += end * state.shift - start.tangential_force * start.shift - area
        assert state.dissipated_energy >= start.dissipated_energy - 1e-16
    r = A * np.linspace(0, 1, 101)
    bound = MU * HERTZ.pressure(r) + 1e-12 * MU * HERTZ.peak_pressure
    assert np.all(np.abs(state.shear(r)) <= bound)
    radii = [branch.stick_radius for _, branch in state.branches()]
    elastic = disc_integral(lambda r: state.shear(r) * (state.shift + state.slip(r)) / 2, A, radii)
    scale = LIMIT * VIRGIN.sliding_shift
    assert work == pytest.approx(elastic + state.dissipated_energy, abs=1e-6 * scale)


# --- superposition for other profiles

CONTACTS = {
    "paraboloid": lambda load: PointContact.under_load(load, RADIUS, E_STAR),
    "sphere": lambda load: SphereContact.under_load(load, RADIUS, E_STAR),
    "cone": lambda load: ConeContact.under_load(load, 0.2, E_STAR),
}


@pytest.mark.parametrize("name", CONTACTS)
@pytest.mark.parametrize("ratio", [0.3, -0.9])
def test_superposed_shear_carries_the_force(name, ratio):
    state = superpose(CONTACTS[name], LOAD, ratio * LIMIT, MU, E_STAR / G_STAR)
    a, c = state.full.contact_radius, state.stick.contact_radius
    assert disc_integral(state.shear, a, [c]) == pytest.approx(ratio * LIMIT, rel=1e-8)
    r = a * np.linspace(0.01, 1, 60)
    assert np.all(np.abs(state.shear(r)) <= MU * state.full.pressure(r) * (1 + 1e-12))
    assert np.all(state.slip(r) * state.shear(r) <= 0)
    assert np.all(state.slip(r[r < c]) == 0)


# --- dimension and range
