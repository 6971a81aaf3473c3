"""Tests of `slipstick.surface_response`: properties that hold for every layered body."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import slipstick
from contact_scene import RIGID, Body, IsotropicMaterial, Layer

GPA = 1e9
# Rounding errors relative to the largest entry; responses of the recursion have about 1e-15.
ROUNDING = 1e-13
MODULI = st.floats(-1, 3).map(lambda decade: GPA * 10**decade)
RATIOS = st.floats(-0.9, 0.5) | st.sampled_from([0.0, 0.3, 0.5])
MATERIALS = st.builds(IsotropicMaterial, young_modulus=MODULI, poisson_ratio=RATIOS)
THICKNESSES = st.floats(-7, -3).map(lambda decade: 10**decade)
LAYERS = st.builds(Layer, thickness=THICKNESSES, material=MATERIALS)
ELASTIC = st.builds(Body, material=MATERIALS, layers=st.lists(LAYERS, max_size=3).map(tuple))
ON_RIGID = st.builds(
    Body, material=st.just(RIGID), layers=st.lists(LAYERS, min_size=1, max_size=3).map(tuple)
)
BODIES = ELASTIC | ON_RIGID
WAVENUMBERS = st.floats(2, 7).map(lambda decade: 10**decade)
ANGLES = st.floats(-np.pi, np.pi)


def response(body, alpha, angle):
    return slipstick.surface_response(body, alpha * np.cos(angle), alpha * np.sin(angle))


def assert_equal(found, expected, rounding=ROUNDING):
    assert np.abs(found - expected).max() <= rounding * np.abs(expected).max()


@given(BODIES, WAVENUMBERS, ANGLES)
def test_reciprocity(body, alpha, angle):
    """Two loads do the same work on the displacements of each other (Betti)."""
    F = response(body, alpha, angle)
    np.testing.assert_array_equal(F, F.conj().T)
    assert_equal(response(body, alpha, angle + np.pi), F.conj())  # real tractions, real motion


@given(BODIES, WAVENUMBERS, ANGLES)
def test_every_traction_does_work(body, alpha, angle):
    F = response(body, alpha, angle)
    # A layer without compressibility, thin on a rigid base, has eigenvalues far below the largest.
    assert np.linalg.eigvalsh(F).min() > -ROUNDING * np.abs(F).max()
    assert np.all(F.diagonal().real > 0)


@given(BODIES, WAVENUMBERS, ANGLES, st.floats(-3, 3), st.floats(-3, 3))
def test_lengths_and_moduli_scale(body, alpha, angle, lengths, moduli):
    length, modulus = 10**lengths, 10**moduli

    def scaled(material):
        if material is RIGID:
            return RIGID
        return IsotropicMaterial(
            young_modulus=modulus * material.young_modulus, poisson_ratio=material.poisson_ratio
        )

    layers = tuple(
        Layer(thickness=length * one.thickness, material=scaled(one.material))
        for one in body.layers
    )
    found = response(Body(material=scaled(body.material), layers=layers), alpha / length, angle)
    assert_equal(found, response(body, alpha, angle) * length / modulus, 1e-12)


@given(BODIES, WAVENUMBERS, ANGLES, st.floats(0.01, 0.99), st.integers(0, 2))
def test_equal_layers_merge(body, alpha, angle, share, place):
    """A cut through a layer, or a layer of the base's material on the base, changes nothing."""
    layers = list(body.layers)
    if place < len(layers):
        whole = layers[place]
        layers[place : place + 1] = [
            Layer(thickness=part * whole.thickness, material=whole.material)
            for part in (share, 1 - share)
        ]
    elif body.material is not RIGID:
        layers.append(Layer(thickness=1e-5 * share, material=body.material))
    cut = Body(material=body.material, layers=tuple(layers))
    assert_equal(response(cut, alpha, angle), response(body, alpha, angle), 1e-11)


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


@given(ELASTIC.filter(lambda body: body.layers), ANGLES)
def test_short_waves_see_the_outer_layer_and_long_waves_the_base(body, angle):
    outer, total = body.layers[0], sum(layer.thickness for layer in body.layers)
    short = 40 / outer.thickness
    assert_equal(
        response(body, short, angle), response(Body(material=outer.material), short, angle)
    )
    contrast = max(one.young_modulus for one in body.elastic_materials) / min(
        one.young_modulus for one in body.elastic_materials
    )
    long = 1e-7 / (contrast * total)
    base = response(Body(material=body.material), long, angle)
    assert_equal(response(body, long, angle), base, 1e-5)


@given(BODIES, WAVENUMBERS, ANGLES, st.floats(1, 100), st.integers(0, 2))
def test_a_stiffer_layer_gives_a_smaller_compliance(body, alpha, angle, factor, place):
    layers = list(body.layers)
    if place >= len(layers):
        return
    old = layers[place]
    layers[place] = Layer(
        thickness=old.thickness,
        material=IsotropicMaterial(
            young_modulus=factor * old.material.young_modulus,
            poisson_ratio=old.material.poisson_ratio,
        ),
    )
    softer = response(body, alpha, angle)
    stiffer = response(Body(material=body.material, layers=tuple(layers)), alpha, angle)
    assert np.linalg.eigvalsh(softer - stiffer).min() >= -ROUNDING * np.abs(softer).max()


def test_a_pressed_surface_moves_down_and_toward_the_load():
    """The transform of numpy has the sign exp(+i k x) of the response in its inverse."""
    material = IsotropicMaterial(young_modulus=200 * GPA, poisson_ratio=0.3)
    points = 256
    width = 1e-3
    sigma = 2e-5
    x = (np.arange(points) - points // 2) * width / points
    k = 2 * np.pi * np.fft.fftfreq(points, width / points)
    pressure = np.exp(-(x[:, None] ** 2 + x**2) / (2 * sigma**2))
    transformed = np.fft.fft2(pressure)
    m, n = np.meshgrid(k, k, indexing="ij")
    m[0, 0] = 1.0  # the mean is not defined, and subtracted below
    response = slipstick.surface_response(Body(material=material), m, n)[..., :, 2]
    response[0, 0] = 0.0
    ux, uy, uz = (np.fft.ifft2(response[..., i] * transformed).real for i in range(3))
    centre, right = points // 2, points // 2 + 20
    # u_z(0) - u_z(r) of a Gaussian, and the radial displacement of its force (Johnson, 3.18).
    force, shear_modulus, nu = 2 * np.pi * sigma**2, material.shear_modulus, material.poisson_ratio
    deepest = (1 - nu) * force / (2 * shear_modulus * np.sqrt(2 * np.pi) * sigma)
    assert uz[centre, centre] - uz[right, centre] == pytest.approx(
        deepest - (1 - nu) * force / (2 * np.pi * shear_modulus * x[right]), rel=0.05, abs=0
    )
    toward = -(1 - 2 * nu) * force / (4 * np.pi * shear_modulus * x[right])
    assert ux[right, centre] == pytest.approx(toward, rel=0.05, abs=0)
    assert uy[centre, right] == pytest.approx(toward, rel=0.05, abs=0)
    assert ux[right, centre] == pytest.approx(-ux[2 * centre - right, centre], rel=1e-9, abs=0)


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
