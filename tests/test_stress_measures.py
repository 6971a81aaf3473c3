"""Tests of measures of a stress: equivalent, principal and interface stresses."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from contact_results.largest import index_of_largest
from contact_results.stress.invariants import principal_stresses, von_mises
from contact_results.stress.points import StressPoints


def test_measures_of_a_pure_shear():
    nothing, one = np.zeros(1), np.zeros((3, 1))
    shear = np.array([0, 0, 0, 0, 3.0, 0])[:, None]
    points = StressPoints(nothing, nothing, nothing, nothing.astype(int), one, shear, nothing > 0)
    found = {name: value.item() for name, value in points.measures.items()}
    expected = {"von_mises": 3 * np.sqrt(3), "max_principal": 3.0, "max_shear": 3.0}
    expected |= {"interface_shear": 3.0, "interface_tensile_stress": 0.0}
    assert found == pytest.approx(expected)


# Sixth powers of a stress are taken: below 1e-50 they underflow.
STRESS = st.floats(-1e9, 1e9).map(lambda s: s if abs(s) > 1e-50 else 0.0)
STRESSES = st.lists(STRESS, min_size=6, max_size=6).map(np.array)


def tensor(s):
    xx, yy, zz, yz, xz, xy = s
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def components(t):
    return np.array([t[0, 0], t[1, 1], t[2, 2], t[1, 2], t[0, 2], t[0, 1]])


@given(STRESSES, st.integers(0, 2**32 - 1), st.sampled_from([0, 1e-15, 1e-12, 1e-8, 1e-3]))
def test_principal_stresses_keep_their_digits_and_make_up_the_von_mises_stress(values, seed, apart):
    """Also where two are equal."""
    turn, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    first, _, third, *_ = values
    pair, triple = (first, first * (1 + apart), third), (first, first, first * (1 - apart))
    for roots in (pair, triple, values[:3]):
        whole = tensor(components(turn @ np.diag(roots) @ turn.T))
        found = principal_stresses(components(whole))
        exact = np.linalg.eigvalsh(whole)[::-1]
        near, (a, b, c) = 1e-14 * np.abs(exact).max(), exact
        np.testing.assert_allclose(found, exact, rtol=0, atol=near)
        equivalent = np.sqrt(((a - b) ** 2 + (b - c) ** 2 + (c - a) ** 2) / 2)
        assert von_mises(components(whole)) == pytest.approx(equivalent, rel=0, abs=near)


def test_round_off_does_not_choose_the_place_of_a_largest_stress_that_is_zero():
    """Beside a contact the surface is free of stress: the first of equal points counts."""
    assert index_of_largest(np.array([-1e9, 2e-7, 5e-7, 0.0, -np.inf])) == 1
    assert index_of_largest(np.array([-1e9, 2e-7, 1.0, 0.0, -np.inf])) == 2
