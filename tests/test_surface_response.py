"""Tests of `slipstick.surface_response`: properties that hold for every layered body."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import slipstick
from contact_scene import RIGID, Body, IsotropicMaterial

GPA = 1e9
# Rounding errors relative to the largest entry; responses of the recursion have about 1e-15.
ROUNDING = 1e-13
MODULI = st.floats(-1, 3).map(lambda decade: GPA * 10**decade)
RATIOS = st.floats(-0.9, 0.5) | st.sampled_from([0.0, 0.3, 0.5])
MATERIALS = st.builds(IsotropicMaterial, young_modulus=MODULI, poisson_ratio=RATIOS)
WAVENUMBERS = st.floats(2, 7).map(lambda decade: 10**decade)
ANGLES = st.floats(-np.pi, np.pi)


def response(body, alpha, angle):
    return slipstick.surface_response(body, alpha * np.cos(angle), alpha * np.sin(angle))


def assert_equal(found, expected, rounding=ROUNDING):
    assert np.abs(found - expected).max() <= rounding * np.abs(expected).max()


@given(MATERIALS, WAVENUMBERS, ANGLES)
def test_half_space_has_the_closed_form_with_its_signs(material, alpha, angle):
    """Transforms of Boussinesq's and Cerruti's displacements (Johnson 1985, section 3.2)."""
    nu, unit = material.poisson_ratio, 1 / (material.shear_modulus * alpha)
    x, y = np.cos(angle), np.sin(angle)
    expected = unit * np.array(
        [
            [1 - nu * x * x, -nu * x * y, 1j * x * (0.5 - nu)],
            [-nu * x * y, 1 - nu * y * y, 1j * y * (0.5 - nu)],
            [-1j * x * (0.5 - nu), -1j * y * (0.5 - nu), 1 - nu],
        ]
    )
    assert_equal(response(Body(material=material), alpha, angle), expected)


def test_a_pressed_surface_moves_toward_the_load():
    """The transform of numpy has the sign exp(+i k x) of the response in its inverse."""
    points, width = 64, 1e-3
    x = (np.arange(points) - points // 2) * width / points
    k = 2 * np.pi * np.fft.fftfreq(points, width / points)
    m, n = np.meshgrid(k, k, indexing="ij")
    m[0, 0] = 1.0  # the mean is not defined
    steel = IsotropicMaterial(young_modulus=200 * GPA, poisson_ratio=0.3)
    u_x_by_p = slipstick.surface_response(Body(material=steel), m, n)[..., 0, 2]
    u_x_by_p[0, 0] = 0.0
    pressure = np.exp(-((20 * x[:, None] / width) ** 2) - (20 * x / width) ** 2)
    moved = np.fft.ifft2(u_x_by_p * np.fft.fft2(pressure)).real
    assert moved[points // 2 + 8, points // 2] < 0 < moved[points // 2 - 8, points // 2]


def test_rigid_bodies_and_arrays():
    assert not np.any(slipstick.surface_response(Body(material=RIGID), 1.0, 2.0))
    steel = Body(material=IsotropicMaterial(young_modulus=200 * GPA, poisson_ratio=0.3))
    many = slipstick.surface_response(steel, np.array([[1.0], [2.0]]), np.array([0.0, 1.0, 3.0]))
    assert many.shape == (2, 3, 3, 3)
    np.testing.assert_array_equal(many[1, 2], slipstick.surface_response(steel, 2.0, 3.0))


@pytest.mark.parametrize(("m", "n"), [(0.0, 0.0), (np.nan, 1.0), (1.0, np.inf)])
def test_waves_without_a_response_are_refused(m, n):
    steel = Body(material=IsotropicMaterial(young_modulus=200 * GPA, poisson_ratio=0.3))
    with pytest.raises(ValueError, match="positive and finite"):
        slipstick.surface_response(steel, m, n)
