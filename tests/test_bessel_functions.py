"""Tests of Bessel functions of many orders against scipy, and of the memory they take."""

import tracemalloc

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import jv, spherical_jn

from radial.response.bessel_functions import bessel_functions, spherical_bessel_functions
from radial.response.wavenumbers import waves


@pytest.mark.parametrize("highest", [0, 1, 2, 10, 40])
def test_bessel_functions_of_all_orders_are_those_of_scipy(highest):
    at = np.concatenate([[0.0], np.geomspace(1e-8, 300, 2000), highest + np.linspace(-1, 1, 41)])
    at = np.abs(at)
    found = list(bessel_functions(highest, at))
    assert len(found) == highest + 1
    for m, values in enumerate(found):
        assert_allclose(values, jv(m, at), atol=2e-14)


@pytest.mark.parametrize("count", [1, 2, 3, 40, 300])
def test_spherical_bessel_functions_of_all_orders_are_those_of_scipy(count):
    at = np.geomspace(1e-8, 2500, 1500)
    expected = spherical_jn(np.arange(count)[:, None], at)
    found = spherical_bessel_functions(count, at)
    assert_allclose(found * np.maximum(at, 1), expected * np.maximum(at, 1), rtol=0, atol=5e-14)
    small = (at < 1) & (np.abs(expected) > 1e-290)
    assert_allclose(found[small], expected[small], rtol=5e-13)


def test_transforms_of_many_wavenumbers_take_little_memory_beside_their_result():
    """Thin layers need 40 000 wavenumbers: all orders of all at once took gigabytes."""
    tracemalloc.start()
    many = waves(shortest=10_000.0, longest=1.0, reach=3.0)
    found = many.even_transforms(104), many.legendre_transform(np.ones(40))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    kept = found[0].nbytes + 40 * found[1].nbytes
    assert peak < 1.5 * kept
