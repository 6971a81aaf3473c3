"""Tests of influence coefficients of layered bodies, against references and by symmetry laws."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from stack_strategies import HALF_SPACES

from semi_analytical.frf.stack import Stack
from semi_analytical.influence.closed_form import HalfSpaceCoefficients
from semi_analytical.influence.layered import LayeredCoefficients
from semi_analytical.influence.layered_response import half_space_response, remainder_table

POINT_RESPONSES = [
    # stiff film, soft base
    (
        Stack([(1000000.0, 0.3, 1.0)], (1.0, 0.3)),
        0.25,
        (
            0.00057736687364816576,
            5.7757708602241414e-7,
            -2.3602749697715694e-8,
            8.0552623101003821e-8,
        ),
    ),
    # soft film, stiff base
    (
        Stack([(1e-06, 0.3, 1.0)], (1.0, 0.3)),
        3.0,
        (-485.7782340511409, 10280.914512076256, -11047.088824037023, -2968.4119300129473),
    ),
    # incompressible film, rigid base
    (
        Stack([(1.0, 0.5, 1.0)], None),
        8.0,
        (
            -0.00016973372808311022,
            0.00043672416151041283,
            -0.00059254867667278364,
            -0.00041566456128911855,
        ),
    ),
    # film on thin incompressible film, rigid base
    (
        Stack([(10000.0, 0.3, 1.0), (1.0, 0.5, 0.1)], None),
        40.0,
        (
            -1.0928396355352794e-8,
            0.00016114312481458935,
            -6.1300922541430289e-5,
            -1.9008267679536725e-6,
        ),
    ),
    # thick under thin
    (
        Stack([(3.0, 0.2, 1.0), (0.5, 0.4, 12.0)], (2.0, 0.25)),
        10.0,
        (0.069319341168501458, 0.15263570196064001, -0.034943849130287488, 0.012170331256436841),
    ),
    # thin under thick
    (
        Stack([(3.0, 0.2, 1.0), (0.001, 0.4, 0.002), (10.0, 0.49, 0.03)], (2.0, 0.0)),
        2.0,
        (0.095836640448262917, 0.083079320096604897, -0.0054239002218235337, 0.033863051513138836),
    ),
]


COMPONENTS = ("zz", "xx", "yy", "xy", "zx", "zy")


def radial_functions(stack, r):
    """r times (zz, mean, twist, cross) of a layered body at distance r."""
    return (
        half_space_response(stack.outer) + r * remainder_table(stack, 1.7 * r)(np.array([r]))[:, 0]
    )


def all_components(coefficients):
    return np.array([coefficients[name] for name in COMPONENTS])


def own_cell(coefficients):
    """The largest displacement of a loaded cell, which errors are measured by."""
    return max(coefficients[name][0, 0] for name in ("zz", "xx", "yy"))


@pytest.mark.parametrize(("stack", "r", "expected"), POINT_RESPONSES)
def test_point_response_agrees_with_high_precision(stack, r, expected):
    error = np.abs(radial_functions(stack, r) - expected).max()
    # Of the response itself or, under a rigid or stiff base that leaves little of it, of the
    # outer half-space's.
    assert error < 1e-14 * max(
        np.abs(expected).max(), np.abs(half_space_response(stack.outer)).max()
    )


@given(HALF_SPACES, st.floats(-8, 4), st.floats(-1.3, 1.3))
def test_layer_of_the_same_material_is_no_layer(material, decade, log_aspect):
    """For layers from 1e-8 to 1e4 cells, and cells up to 20 times longer than wide."""
    spacing = (1.0, 10**log_aspect)
    layered = LayeredCoefficients(Stack([(*material, 10**decade)], material), spacing, (24, 20))
    expected = HalfSpaceCoefficients(spacing, (24, 20), *material)
    error = np.abs(all_components(layered) - all_components(expected)).max()
    # What the corner differences of the closed form lose at this distance.
    assert error < 2e-13 * own_cell(layered)
