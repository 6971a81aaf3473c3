"""Influence coefficients of layered bodies: against references, and by the laws they obey."""

from math import hypot

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from point_responses import POINT_RESPONSES
from scipy.integrate import dblquad
from stack_strategies import HALF_SPACES, stacks

from contact_scene import kept_arrays
from semi_analytical.frf.stack import Stack
from semi_analytical.influence.closed_form import HalfSpaceCoefficients, RectangleIntegrals
from semi_analytical.influence.layered import LayeredCoefficients
from semi_analytical.influence.radial_table import radial_table

COMPONENTS = ("zz", "xx", "yy", "xy", "zx", "zy")
EVERYTHING = slice(0, 4)


def all_components(coefficients):
    return np.array([getattr(coefficients, name) for name in COMPONENTS])


def own_cell(coefficients):
    """The largest displacement of a loaded cell, which errors are measured by."""
    return max(coefficients.zz[0, 0], coefficients.xx[0, 0], coefficients.yy[0, 0])


@pytest.mark.parametrize(("stack", "r", "expected"), POINT_RESPONSES)
def test_point_response_agrees_with_high_precision(stack, r, expected):
    table = radial_table(stack, 1.7 * r)
    error = np.abs(table(np.array([r]), EVERYTHING)[0] - expected).max()
    # Of the response itself or, under a rigid or stiff base that leaves little of it, of the
    # outer half-space's.
    assert error < 1e-14 * max(np.abs(expected).max(), np.abs(table.near).max())


@given(HALF_SPACES, st.floats(-8, 4), st.floats(-1.3, 1.3))
def test_layer_of_the_same_material_is_no_layer(material, decade, log_aspect):
    """For layers from 1e-8 to 1e4 cells, and cells up to 20 times longer than wide."""
    spacing = (1.0, 10**log_aspect)
    layered = LayeredCoefficients(Stack([(*material, 10**decade)], material), spacing, (40, 36))
    expected = HalfSpaceCoefficients(RectangleIntegrals(*spacing, (40, 36)), *material)
    error = np.abs(all_components(layered) - all_components(expected)).max()
    # What the corner differences of the closed form lose at this distance.
    assert error < 2e-13 * own_cell(layered)


@given(stacks(max_layers=3), st.floats(0.1, 10), st.floats(0.3, 3))
def test_cells_add_up(stack, size, aspect):
    """A cell of 3 x 3 cells is displaced at its centre by the sum of the nine."""
    dx, dy = size, size * aspect
    fine = all_components(LayeredCoefficients(stack, (dx, dy), (27, 24)))
    coarse = all_components(LayeredCoefficients(stack, (3 * dx, 3 * dy), (8, 7)))
    odd_x, odd_y = np.array([1, 1, 1, -1, -1, 1]), np.array([1, 1, 1, -1, 1, -1])
    total = np.zeros_like(coarse)
    for i in range(-1, 2):
        for j in range(-1, 2):
            a, b = 3 * np.arange(8) + i, 3 * np.arange(7) + j
            part = fine[:, abs(a)[:, None], abs(b)]
            part *= np.where(a < 0, odd_x[:, None], 1)[:, :, None]
            part *= np.where(b < 0, odd_y[:, None], 1)[:, None, :]
            total += part
    assert np.abs(total - coarse).max() < 1e-11 * np.abs(coarse).max()


HARD = {
    "film 1e-4 of a cell": Stack([(30.0, 0.3, 1e-4)], (1.0, 0.25)),
    "soft film 1e-3 of a cell on a rigid base": Stack([(1.0, 0.3, 1e-3)]),
    "incompressible film of half a cell on a rigid base": Stack([(1.0, 0.5, 0.5)]),
    "layer of 1e4 cells": Stack([(2.0, 0.3, 1e4)], (1.0, 0.5)),
    "layers from 1e-3 to 1e3 cells": Stack(
        [(5.0, 0.2, 1e-3), (0.1, 0.5, 1.0), (3.0, 0.0, 1e3)], (1.0, 0.3)
    ),
    "contrast 1e6": Stack([(1e6, 0.3, 0.1)], (1.0, 0.3)),
}


@pytest.mark.parametrize("stack", HARD.values(), ids=HARD)
@pytest.mark.parametrize("cell", [(1, 0), (0, 2), (3, 5), (33, 4)])
def test_other_cells_by_adaptive_quadrature(stack, cell):
    dx, dy = 1.0, 0.7
    coefficients = LayeredCoefficients(stack, (dx, dy), (40, 40))
    table = radial_table(stack, 60.0)

    def normal(y, x):
        r = hypot(x, y)
        return float(table(np.array([r]), slice(0, 1))[0, 0]) / r

    def coupling(y, x):
        r = hypot(x, y)
        return float(table(np.array([r]), slice(3, 4))[0, 0]) / r * (x / r)

    x, y = cell[0] * dx, cell[1] * dy
    bounds = (x - dx / 2, x + dx / 2, y - dy / 2, y + dy / 2)
    for integrand, got in ((normal, coefficients.zz), (coupling, coefficients.zx)):
        expected, _ = dblquad(integrand, *bounds, epsabs=1e-13 * own_cell(coefficients), epsrel=0)
        assert abs(got[cell] - expected) < 1e-12 * own_cell(coefficients)


def test_coefficients_scale_with_length_and_stiffness():
    stack, scaled = Stack([(2.0, 0.3, 0.5)], (1.0, 0.25)), Stack([(2e9, 0.3, 5e-7)], (1e9, 0.25))
    here = all_components(LayeredCoefficients(stack, (0.1, 0.2), (40, 30)))
    there = all_components(LayeredCoefficients(scaled, (1e-7, 2e-7), (40, 30)))
    assert np.abs(here - there * 1e15).max() < 1e-14 * here.max()


def test_exchanging_x_and_y_exchanges_the_components():
    stack = Stack([(2.0, 0.3, 0.5), (0.3, 0.5, 2.0)])
    wide = LayeredCoefficients(stack, (0.3, 0.1), (50, 40))
    tall = LayeredCoefficients(stack, (0.1, 0.3), (40, 50))
    for one, other in (("zz", "zz"), ("xx", "yy"), ("xy", "xy"), ("zx", "zy")):
        difference = np.abs(getattr(wide, one).T - getattr(tall, other)).max()
        assert difference < 1e-15 * own_cell(wide)


def test_rigid_body_has_no_coefficients():
    with pytest.raises(ValueError, match="rigid"):
        LayeredCoefficients(Stack(), (1.0, 1.0), (3, 3))


STACK = Stack([(2.0, 0.3, 0.5)], (1.0, 0.3))


def normal_coefficients(stack=STACK, spacing=(1.0, 1.0), shape=(5, 4)):
    return LayeredCoefficients(stack, spacing, shape, kept_arrays.remembered).zz


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("SLIPSTICK_CACHE_DIR", str(tmp_path / "deep" / "cache"))
    return tmp_path / "deep" / "cache"


@pytest.fixture
def computations(monkeypatch):
    """Counts the computations that are done."""
    from semi_analytical.influence import layered

    count = []

    def counted(*arguments):
        count.append(1)
        return original(*arguments)

    original = layered.cell_integrals
    monkeypatch.setattr(layered, "cell_integrals", counted)
    return count


def test_cache_returns_the_same_bits(folder, computations):
    first, second = normal_coefficients(), normal_coefficients()
    np.testing.assert_array_equal(first, second)
    assert len(computations) == 1
    second[0, 0] = 0  # what comes from the cache is writable and nobody else's


def test_bodies_in_one_cache_do_not_share_entries(folder, computations):
    layer, other_layer, base, other_base = (2.0, 0.3, 0.5), (2.0, 0.4, 0.5), (1.0, 0.3), (1.0, 0.2)
    stacks = [
        Stack([layer], base),
        Stack([layer], other_base),
        Stack([other_layer], base),
        Stack([layer, other_layer], base),
        Stack([other_layer, layer], base),
        Stack([layer, layer], base),
    ]
    for entries, stack in enumerate(stacks, start=1):
        normal_coefficients(stack)
        assert len(list(folder.iterdir())) == len(computations) == entries
    for stack in stacks:
        fresh = LayeredCoefficients(stack, (1.0, 1.0), (5, 4)).zz
        np.testing.assert_array_equal(normal_coefficients(stack), fresh)
