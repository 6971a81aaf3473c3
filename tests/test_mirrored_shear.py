"""Operators on a quarter: shear along one axis is even about both planes, that across it odd."""

import numpy as np
import pytest
from contact_scenes import PRESS, scene
from hypothesis import given
from hypothesis import strategies as st

from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.mirrored_inverse import MirroredPeriodicInverse
from semi_analytical.mirrored_shear import MirroredTangentialOperator
from semi_analytical.mirrored_transform import mirrored_offsets
from semi_analytical.operator import TangentialOperator
from semi_analytical.padded_transform import Convolutions
from semi_analytical.part import WHOLE, Part
from semi_analytical.periodic_inverse import PeriodicInverse
from semi_analytical.sines import MOST_BY_MATRIX

ROUND_OFF = 1e-13
LONG = MOST_BY_MATRIX + 2
ELASTIC = scene(PRESS).body, scene(PRESS).indenter
SHAPES = [(1, 1), (3, 5), (8, 13), (17, 1), (LONG, 6), (5, LONG), (LONG, LONG), (150, 200)]


def told(along):
    return Part((True, True), along=along)


def operators(shape, along, counter=None):
    """On a quarter of `shape` cells and on the whole window."""
    K = influence_coefficients(*ELASTIC, (0.3, 1.7), mirrored_offsets(shape))
    counter = counter or Convolutions()
    whole = 2 * shape[0], 2 * shape[1]
    return (
        MirroredTangentialOperator(K, shape, told(along), counter),
        TangentialOperator(K, whole, counter),
    )


def off(found, expected):
    return np.max(np.abs(found - expected)) / np.max(np.abs(expected))


@pytest.mark.parametrize("along", [0, 1])
@pytest.mark.parametrize("shape", SHAPES)
def test_the_operator_on_a_quarter_is_that_on_the_window(shape, along, rng):
    (of_quarter, of_window), part = operators(shape, along), told(along)
    q = rng.standard_normal((2, *shape))
    expected = of_window(part.unfolded_vector(q))
    assert off(part.unfolded_vector(of_quarter(q)), expected) < ROUND_OFF


@pytest.mark.parametrize("along", [0, 1])
@pytest.mark.parametrize("shape", [(4, 6), (8, 1), (24, LONG + 4), (80, 100)])
def test_the_preconditioner_on_a_quarter_is_that_on_the_window(shape, along, rng):
    """Where both have the same period; what turns the shear is odd about both planes."""
    (of_quarter, of_window), part = operators(shape, along), told(along)
    u = rng.standard_normal((4, *shape))
    odd = [part.unfolded(one, part.turning) for one in u[2:]]
    expected = PeriodicInverse(of_window, 0.3)(np.stack([*part.unfolded_vector(u[:2]), *odd]))
    found = MirroredPeriodicInverse(of_quarter, 0.3)(u)
    odd = [part.unfolded(one, part.turning) for one in found[2:]]
    found = np.stack([*part.unfolded_vector(found[:2]), *odd])
    # Long waves across the longer cells are divided by little.
    assert off(found, expected) < 10 * ROUND_OFF


@given(st.tuples(st.integers(1, 40), st.integers(1, 80)), st.integers(0, 1), st.integers(0, 2**32))
def test_operator_and_preconditioner_are_symmetric_and_positive(shape, along, seed):
    of_quarter, _ = operators(shape, along)
    a, b = np.random.default_rng(seed).standard_normal((2, 2, *shape))
    for linear in (of_quarter, MirroredPeriodicInverse(of_quarter, 0.3)):
        size = np.linalg.norm(a) * np.linalg.norm(linear(b))
        assert np.sum(a * linear(b)) == pytest.approx(np.sum(linear(a) * b), abs=1e-12 * size)
        assert np.sum(a * linear(a)) > 0


def test_a_vector_of_a_quarter_takes_two_convolutions():
    counter = Convolutions()
    of_quarter, _ = operators((6, 70), 0, counter)
    MirroredPeriodicInverse(of_quarter, 0.3)(of_quarter(np.ones((2, 6, 70))))
    assert counter.count == 2


@pytest.mark.parametrize("along", [0, 1])
def test_sums_over_the_window_are_told_by_a_quarter(along, rng):
    q, part = rng.standard_normal((2, 5, 7)), told(along)
    whole = part.unfolded_vector(q)
    assert part.resultant(q) == pytest.approx(WHOLE.resultant(whole), abs=1e-12)
    np.testing.assert_array_equal(np.stack([part.of(one) for one in whole]), q)
