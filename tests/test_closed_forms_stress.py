"""Subsurface stress of the Hertz contact: equilibrium, boundary values, point-force integrals."""

import numpy as np
import pytest
from scipy.integrate import quad

from verification.closed_forms.hamilton_stress import hamilton_stress
from verification.closed_forms.huber_stress import huber_stress, sliding_axis_shear
from verification.closed_forms.sheared_surface import (
    stress_by_hertz_pressure,
    stress_by_hertz_shear,
    trailing_edge_tension,
)

A, PEAK = 0.8, 1.9
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
