"""Tests of closed forms of the stress below a contact: equilibrium, boundary values, point
forces."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from surface_quadrature import ray_integral

from verification.closed_forms.flat_punch import TiltedPunch
from verification.closed_forms.huber_stress import (
    hamilton_stress,
    huber_stress,
    sliding_axis_shear,
    stress_by_hertz_pressure,
    stress_by_hertz_shear,
    trailing_edge_tension,
)
from verification.closed_forms.torsion import (
    CoatedTorsion,
    StuckTorsion,
    TorsionalPartialSlip,
    TorsionalSurface,
    one_layer,
)

A = 0.8
PEAK = 1.9
POINTS = [(0.1, 0.3), (0.5, 0.4), (0.79, 0.05), (1.2, 0.3), (2.0, 3.0)]


@pytest.mark.parametrize(("r", "z"), POINTS)
@pytest.mark.parametrize("nu", [0.0, 0.3])
def test_stress_is_in_equilibrium(r, z, nu):
    def along(name, dr=0.0, dz=0.0):
        plus = getattr(huber_stress(r + dr, z + dz, A, PEAK, nu), name)
        minus = getattr(huber_stress(r - dr, z - dz, A, PEAK, nu), name)
        return float(plus - minus) / (2 * step)

    step, here = 1e-5, huber_stress(r, z, A, PEAK, nu)
    radial = along("radial", dr=step) + along("shear", dz=step)
    radial += float(here.radial - here.hoop) / r
    axial = along("shear", dr=step) + along("axial", dz=step) + float(here.shear) / r
    # central difference of a field varying over 0.05 at worst
    assert radial == pytest.approx(0, abs=2e-6 * PEAK / A)
    assert axial == pytest.approx(0, abs=2e-6 * PEAK / A)


@pytest.mark.parametrize(("r", "z"), POINTS)
def test_radial_stress_agrees_with_hamilton(r, z):
    # Hamilton's (1983) form of σ_xx at (x, y) = (r, 0) and (0, r) for p0 = a = 1
    nu, r, z = 0.3, r / A, z / A
    B = r**2 + z**2 - 1
    S = np.sqrt(B**2 + 4 * z**2)
    M, N = np.sqrt((S + B) / 2), np.sqrt((S - B) / 2)
    phi = np.arctan(1 / M)
    common = (1 - nu) * N * z**2 - (1 - 2 * nu) / 3 * (N * S + 2 * B * N + 1) - nu * M * z
    radial = (1 + nu) * z * phi + (-common - N * r**2 - M * r**2 * z / S) / r**2
    hoop = (1 + nu) * z * phi + (common - N * 2 * nu * r**2) / r**2
    stress = huber_stress(r * A, z * A, A, PEAK, nu)
    assert stress.radial == pytest.approx(PEAK * radial, rel=1e-11)
    assert stress.hoop == pytest.approx(PEAK * hoop, rel=1e-11, abs=1e-13)
    assert stress.axial == pytest.approx(PEAK * (-N + z * M / S), rel=1e-11)


@pytest.mark.parametrize("z", [0.05, 0.4, 3.0])
def test_sliding_shear_is_the_integral_of_cerruti(z):
    # point force Q along x: τ_xz = -3Q x²z/2πR⁵, averaged over the direction
    integral, _ = quad(
        lambda t: (A * np.sin(t)) ** 3 / ((A * np.sin(t)) ** 2 + z**2) ** 2.5 * A * np.cos(t) ** 2,
        0,
        np.pi / 2,
        epsabs=0,
        epsrel=1e-11,
    )
    assert sliding_axis_shear(z, A, 0.2) == pytest.approx(-1.5 * 0.2 * z * integral, rel=1e-9)
    assert sliding_axis_shear(0.0, A, 0.2) == -0.2


@pytest.mark.parametrize("depth", [0.003, 0.1, 0.5, 2.0])
def test_hamiltons_stress_is_hubers_without_shear(depth: float) -> None:
    r, turn = np.array([1e-9, 0.3, 0.9, 1.0, 1.05, 2.0]), 0.7
    c, s = np.cos(turn), np.sin(turn)
    xx, yy, zz, yz, xz, xy = hamilton_stress(r * c, r * s, depth, 1.0, 1.0, 0.0, 0.3)
    exact = huber_stress(r, depth, 1.0, 1.0, 0.3)
    np.testing.assert_allclose(xx * c * c + yy * s * s + 2 * xy * c * s, exact.radial, atol=1e-9)
    np.testing.assert_allclose(xx * s * s + yy * c * c - 2 * xy * c * s, exact.hoop, atol=1e-9)
    np.testing.assert_allclose(zz, exact.axial, atol=1e-9)
    np.testing.assert_allclose(xz * c + yz * s, exact.shear, atol=1e-9)


def test_hamiltons_stress_is_that_of_sliding_on_the_axis_and_at_the_surface() -> None:
    depth = np.array([0.01, 0.3, 1.0])
    on_axis = hamilton_stress(1e-9, 0.0, depth, 1.0, 0.0, 1.0, 0.3)[4]
    np.testing.assert_allclose(on_axis, sliding_axis_shear(depth, 1.0, 1.0), atol=1e-9)
    x = np.array([-0.5, 0.5, 1.3])
    near = hamilton_stress(x, 0.0, 1e-6, 1.0, 0.0, 1.0, 0.3)[0]
    np.testing.assert_allclose(near, stress_by_hertz_shear(x, 1.0, 1.0, 0.3), atol=1e-5)


def test_hamiltons_stress_is_in_equilibrium() -> None:
    """Of the shear alone, off every symmetry."""
    place, step = np.array([0.7, 0.6, 0.2]), 1e-4
    d_x, d_y, d_z = (
        hamilton_stress(*(place + step * along), 1.0, 0.0, 1.0, 0.3)
        - hamilton_stress(*(place - step * along), 1.0, 0.0, 1.0, 0.3)
        for along in np.eye(3)
    )
    xx, yy, zz, yz, xz, xy = range(6)
    for forces in (
        d_x[xx] + d_y[xy] + d_z[xz],
        d_x[xy] + d_y[yy] + d_z[yz],
        d_x[xz] + d_y[yz] + d_z[zz],
    ):
        assert abs(forces) < 1e-6 * 2 * step


# ---- Closed forms of the surface stress and of Ruiz's parameters: consistent before they judg


POISSON_RATIOS = [0.0, 0.3, 0.5]


@pytest.mark.parametrize("nu", POISSON_RATIOS)
@pytest.mark.parametrize("x", [1.05, -1.4, 6.0])
def test_stress_beyond_a_sheared_circle_is_that_of_the_forces_in_it(x: float, nu: float) -> None:
    """Cerruti's point force, added up over the circle in polar coordinates about its centre."""

    def of_ring(r: float) -> float:
        def of_force(angle: float) -> float:
            X, Y = x - r * np.cos(angle), -r * np.sin(angle)
            R = np.hypot(X, Y)
            return float(-(3 * nu * X**3 / R**5 + (1 - 2 * nu) * X / R**3) / np.pi)

        return r * np.sqrt(1 - r**2) * 2 * quad(of_force, 0, np.pi, epsrel=1e-9)[0]

    expected = quad(of_ring, 0, 1, epsrel=1e-8)[0]
    assert stress_by_hertz_shear(x, 1.0, 1.0, nu) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("nu", POISSON_RATIOS)
@pytest.mark.parametrize("mu", [0.0, 0.1, 0.7])
def test_a_sliding_contact_is_most_in_tension_at_its_trailing_edge(nu: float, mu: float) -> None:
    x = np.linspace(-3, 3, 6001)
    stress = stress_by_hertz_pressure(x, 1.0, 2.0, nu) + stress_by_hertz_shear(x, 1.0, 2 * mu, nu)
    assert np.max(stress) == pytest.approx(trailing_edge_tension(2.0, mu, nu), rel=1e-9, abs=1e-12)
    if mu > 0:
        assert x[np.argmax(stress)] == pytest.approx(-1.0, abs=1e-9)


# ---- Torsion: equilibrium, Coulomb's bound, rigid rotation of the stick disc, tabulated value


TWIST_A = 0.9
TWIST_PEAK = 1.3
MU = 0.25
MODULUS = 0.7
ratios = st.floats(0.01, 1)


def twisted(ratio):
    return TorsionalPartialSlip(TWIST_A, TWIST_PEAK, MU, MODULUS, ratio * TWIST_A)


def moment_of(state, edge):
    """Moment 2π∫q r² dr, each side of the stick edge mapped by a cosine."""
    total = 0.0
    for low, high in [(0.0, edge), (edge, TWIST_A)]:

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
    assert state.twist * MODULUS / (MU * TWIST_PEAK) == pytest.approx(twist, abs=6e-10)
    assert state.moment / state.sliding_moment == pytest.approx(moment, abs=6e-10)


@pytest.mark.parametrize("ratio", [0.05, 0.5, 0.8, 0.99])
def test_torsional_shear_carries_the_moment(ratio):
    state = twisted(ratio)
    assert moment_of(state, ratio * TWIST_A) == pytest.approx(state.moment, rel=1e-9)


@given(ratio=ratios)
def test_torsional_shear_obeys_coulomb(ratio):
    state = twisted(ratio)
    r = TWIST_A * np.linspace(0, 1, 60)
    bound = MU * TWIST_PEAK * np.sqrt(1 - (r / TWIST_A) ** 2)
    assert np.all(state.shear(r) <= bound * (1 + 1e-14))
    assert np.all(state.shear(r) >= -1e-12 * MU * TWIST_PEAK)
    np.testing.assert_array_equal(state.shear(r)[r > ratio * TWIST_A], bound[r > ratio * TWIST_A])


@pytest.mark.parametrize("ratio", [0.5, 0.8])
def test_stick_disc_turns_rigidly(ratio):
    state, c = twisted(ratio), ratio * TWIST_A

    def across(x, y):
        r = np.hypot(x, y)
        return state.shear(r) * x / r

    for x in (0.3 * c, 0.8 * c):
        # the field is divergence-free, hence the nu = 0 kernel serves every nu
        displacement = ray_integral(
            across,
            (x, 0.0),
            [(c, c), (TWIST_A, TWIST_A)],
            lambda phi: 0 * phi + 1 / (2 * np.pi * MODULUS),
        )
        # the logarithm at the axis limits the quadrature, not the formula
        assert displacement == pytest.approx(state.twist * x, rel=1e-4)


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


# ---- Tilted punch and coated torsion: equilibrium, rigid motion of what sticks, limits.


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


def limit(r):
    return MU * TWIST_PEAK * np.sqrt(np.maximum(1 - (r / TWIST_A) ** 2, 0.0))


def coated(thickness=0.4, coating=2.0, base=0.5):
    return TorsionalSurface(lambda k: one_layer(k, thickness, coating, base), coating, thickness)


def twisted_film(ratio=0.6, **layer):
    return CoatedTorsion(coated(**layer), TWIST_A, limit, ratio * TWIST_A)


@pytest.mark.parametrize("ratio", [0.15, 0.5, 0.8, 0.99])
def test_a_layer_of_the_same_material_is_none(ratio):
    state = twisted_film(ratio, coating=MODULUS, base=MODULUS)
    plain = TorsionalPartialSlip(TWIST_A, TWIST_PEAK, MU, MODULUS, ratio * TWIST_A)
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
    r = ratio * TWIST_A * np.array([0.1, 0.6, 1.0])
    np.testing.assert_allclose(state.displacement(r), state.twist * r, rtol=1e-10)
    assert 0 < state.torque < state.sliding_torque
