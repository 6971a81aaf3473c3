"""Tests of the response of the surface to waves: high-precision solves, rigid bodies, refusals."""

import numpy as np
import pytest

import slipstick
from contact_scene import RIGID, Body, IsotropicMaterial, Layer
from semi_analytical.frf.stack import Stack, stack_of
from semi_analytical.frf.surface import half_space_scalars, remainder_scalars, scalars

# Scalars minus those of the outer half-space, from the hyperbolic form of the recursion evaluated
# with 60 digits and more than it cancels; layers (G, nu, h), base, alpha, (c11, c12, c22, csh).
REMAINDERS = [
    (
        [(2.0, 0.3, 1.0)],
        (1.0, 0.25),
        50.0,
        (
            6.7175471646338116e-43,
            6.8532320410223611e-43,
            6.9916580260248206e-43,
            2.4800506506805573e-46,
        ),
    ),
    (
        [(1e-3, 0.5, 1.0), (10.0, 0.0, 0.1)],
        None,
        20.0,
        (
            -1.6161837900675594e-13,
            -1.699010535121736e-13,
            -1.7860848037278371e-13,
            -4.247535228113661e-16,
        ),
    ),
    (
        [(1e3, -0.5, 1.0), (1.0, 0.45, 2.0), (5.0, 0.2, 0.3)],
        (1e-3, 0.5),
        1.0,
        (
            0.0016609256372583497,
            0.0038366811597408231,
            0.0093293858148117927,
            0.00031230723193340723,
        ),
    ),
    (
        [(1.0, 0.3, 1.0)],
        (1.1, 0.3),
        4.5,
        (
            -4.2405457318629283e-5,
            -5.2709026985438466e-5,
            -6.5588511266489008e-5,
            -2.6118323566944105e-6,
        ),
    ),
]


@pytest.mark.parametrize(("layers", "base", "alpha", "expected"), REMAINDERS)
def test_remainder_keeps_its_digits(layers, base, alpha, expected):
    got = np.array(remainder_scalars(Stack(layers, base), alpha))
    assert np.abs(got - expected).max() < 3e-14 * np.abs(expected).max()


@pytest.mark.parametrize("x", [0.49999, 0.50001])
def test_remainder_is_the_difference_on_both_sides_of_its_switch(x):
    stack = Stack([(3.0, 0.3, 1.0), (0.1, 0.5, 2.0)], (1.0, 0.2))
    difference = np.subtract(scalars(stack, x), half_space_scalars(stack.outer, x))
    np.testing.assert_allclose(np.array(remainder_scalars(stack, x)), difference, rtol=1e-14)


def test_stack_of_a_body_keeps_the_order():
    steel, coating = (
        IsotropicMaterial(young_modulus=200e9, poisson_ratio=0.25),
        IsotropicMaterial(young_modulus=400e9, poisson_ratio=0.0),
    )
    films = (Layer(thickness=1e-6, material=coating), Layer(thickness=2e-6, material=steel))
    body = Body(material=coating, layers=films)
    expected = Stack([(200e9, 0.0, 1e-6), (80e9, 0.25, 2e-6)], (200e9, 0.0))
    assert stack_of(body) == expected


@pytest.mark.parametrize(
    ("layers", "base", "message"),
    [
        ([(1.0, 0.3, -1.0)], (1.0, 0.3), "thickness"),
        ([(1.0, 0.3, np.inf)], (1.0, 0.3), "thickness"),
        ([(0.0, 0.3, 1.0)], (1.0, 0.3), "shear modulus is 0.0"),
        ([], (-1.0, 0.3), "shear modulus is -1.0"),
        ([], (np.nan, 0.3), "shear modulus"),
        ([], (1.0, -1.0), "Poisson's ratio is -1.0"),
        ([], (1.0, 0.51), "Poisson's ratio is 0.51"),
        ([], (1.0, np.nan), "Poisson's ratio"),
    ],
)
def test_impossible_materials_are_named(layers, base, message):
    with pytest.raises(ValueError, match=message):
        Stack(layers, base)


STEEL = Body(material=IsotropicMaterial(young_modulus=200e9, poisson_ratio=0.3))


def test_rigid_bodies_and_arrays():
    rigid = Body(material=RIGID)
    assert stack_of(rigid).is_rigid
    assert not np.any(scalars(stack_of(rigid), [1.0, 2.0]))
    assert not np.any(slipstick.surface_response(rigid, 1.0, 2.0))
    many = slipstick.surface_response(STEEL, np.array([[1.0], [2.0]]), np.array([0.0, 1.0, 3.0]))
    assert many.shape == (2, 3, 3, 3)
    np.testing.assert_array_equal(many[1, 2], slipstick.surface_response(STEEL, 2.0, 3.0))


@pytest.mark.parametrize(("m", "n"), [(0.0, 0.0), (np.nan, 1.0), (1.0, np.inf)])
def test_waves_without_a_response_are_refused(m, n):
    with pytest.raises(ValueError, match="positive and finite"):
        slipstick.surface_response(STEEL, m, n)
