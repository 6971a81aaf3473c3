"""Operators of bodies that couple on half of the window and on a quarter of it are those on all."""

import numpy as np
import pytest
from coupled_scenes import press, scene
from hypothesis import given
from hypothesis import strategies as st

from semi_analytical.coupled_operator import CoupledOperator
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.mirrored_coupling import MirroredCoupledOperator
from semi_analytical.mirrored_inverse import MirroredPeriodicInverse
from semi_analytical.mirrored_shear import MirroredTangentialOperator
from semi_analytical.mirrored_transform import mirrored_offsets
from semi_analytical.operator import CouplingOperator, NormalOperator, TangentialOperator
from semi_analytical.padded_transform import Convolutions
from semi_analytical.part import QUARTER, WHOLE, Part
from semi_analytical.periodic_inverse import PeriodicInverse
from semi_analytical.predictor import Lens
from semi_analytical.sines import MOST_BY_MATRIX

ROUND_OFF = 1e-13
SINGLE = 1e-5
PARTS = {"y > 0": Part((False, True)), "x > 0": Part((True, False)), "quarter": QUARTER}
LONG = MOST_BY_MATRIX + 4
SHAPES = [(2, 3), (8, 12), (LONG, 6), (6, LONG), (LONG, LONG), (120, 150)]
SPACING = (2e-5, 3e-5)
DOUBLES, SINGLES = np.dtype(np.float64), np.dtype(np.float32)


def coefficients(part, shape):
    described = scene(press())
    reach = mirrored_offsets(part.window(shape))
    return influence_coefficients(described.body, described.indenter, SPACING, reach)


def operators(part, shape, counter=None):
    """On the part and on the window."""
    K, counter, whole = coefficients(part, shape), counter or Convolutions(), part.window(shape)
    on_window = (one(K, whole, counter) for one in (NormalOperator, TangentialOperator))
    normal, tangential = on_window
    return (
        MirroredCoupledOperator(MirroredTangentialOperator(K, shape, part, counter)),
        CoupledOperator(normal, tangential, CouplingOperator(K, whole, counter)),
    )


def unfolded(part, field):
    """Shears, a pressure, and what turns shears, on the window."""
    scalars = [part.unfolded(field[2])] if len(field) > 2 else []
    turning = [part.unfolded(one, part.turning) for one in field[3:]]
    return np.stack([*part.unfolded_vector(field[:2]), *scalars, *turning])


def off(found, expected):
    return np.max(np.abs(found - expected)) / np.max(np.abs(expected))


@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_tractions_displace_as_on_the_window(part, shape, rng):
    of_part, of_window = operators(part, shape)
    t = rng.standard_normal((3, *shape))
    q, p = unfolded(part, t)[:2], part.unfolded(t[2])
    assert off(unfolded(part, of_part(t)), of_window(unfolded(part, t))) < ROUND_OFF
    assert off(part.unfolded(of_part.normal(t[2])), of_window.normal(p)) < ROUND_OFF
    u_t = of_part.tangential(t[:2]), of_part.coupling.tangential_by_pressure(t[2])
    expected = of_window.tangential(q), of_window.coupling.tangential_by_pressure(p)
    for found, right in zip(u_t, expected, strict=True):
        assert off(part.unfolded_vector(found), right) < ROUND_OFF
    u_z = part.unfolded(of_part.coupling.normal_by_shear(t[:2]))
    assert off(u_z, of_window.coupling.normal_by_shear(q)) < ROUND_OFF


@pytest.mark.parametrize("precision", [DOUBLES, SINGLES], ids=["double", "single"])
@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
@pytest.mark.parametrize("shape", [(8, 12), (LONG, 6), (108, 150)], ids=str)
def test_the_preconditioner_is_that_on_the_window(part, shape, precision, rng):
    """Also for cells that yield, where both have the same period."""
    of_part, of_window = operators(part, shape)
    u = rng.standard_normal((5, *shape))
    bound = SINGLE if precision == SINGLES else 10 * ROUND_OFF
    assert (
        off(
            part.unfolded(of_part.normal.precondition(u[2])),
            of_window.normal.precondition(part.unfolded(u[2])),
        )
        < 10 * ROUND_OFF
    )
    stiff = float(coefficients(part, shape).xx[0, 0])
    found = MirroredPeriodicInverse(of_part.tangential, stiff, of_part.normal, precision)
    right = PeriodicInverse(of_window.tangential, stiff, of_window.normal, precision.type)
    for one, other in ((found, right), (found.yielding(3 * stiff), right.yielding(3 * stiff))):
        assert one(u).dtype == precision
        assert off(unfolded(part, one(u)), other(unfolded(part, u))) < bound


@given(
    st.sampled_from([*PARTS.values()]),
    st.tuples(st.integers(2, 20), st.integers(2, 30)),
    st.integers(0, 2**32 - 1),
)
def test_energy_is_positive_and_work_reciprocal(part, shape, seed):
    """Betti: what one of two tractions does along the displacements of the other, the other does
    along its."""
    of_part, _ = operators(part, shape)
    a, b = np.random.default_rng(seed).standard_normal((2, 3, *shape))
    size = np.linalg.norm(a) * np.linalg.norm(of_part(b))
    assert np.sum(a * of_part(b)) == pytest.approx(np.sum(of_part(a) * b), abs=1e-12 * size)
    assert np.sum(a * of_part(a)) > 0


def test_convolutions_of_a_part_count_as_those_of_the_window():
    counts = []
    for which in (0, 1):
        counter, t = Convolutions(), np.ones((3, 6, 10))
        together = operators(PARTS["y > 0"], (6, 10), counter)[which]
        t = t if which == 0 else unfolded(PARTS["y > 0"], t)
        together(t)
        together.normal(t[2])
        together.tangential(t[:2])
        together.coupling.normal_by_shear(t[:2])
        together.coupling.tangential_by_pressure(t[2])
        counts.append(counter.count)
    assert counts == [9, 9]


@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
def test_sums_and_images_are_those_of_the_window(part, rng):
    q = rng.standard_normal((2, 5, 7))
    whole = part.unfolded_vector(q)
    assert part.resultant(q) == pytest.approx(WHOLE.resultant(whole), abs=1e-12)
    np.testing.assert_array_equal(np.stack([part.of(one) for one in whole]), q)
    assert part.images * q[0].size == whole[0].size
    for axis in (0, 1):
        if part.mirrored[axis]:  # as a mirror shows a vector
            image = np.flip(whole, 1 + axis).copy()
            image[axis] *= -1
            np.testing.assert_array_equal(image, whole)


@pytest.mark.parametrize("factor", [0.8, 1.0, 1.3])
@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
def test_fields_of_a_part_dilate_as_those_of_the_window(part, factor, rng):
    p, q = rng.random((6, 8)), rng.standard_normal((2, 6, 8))
    # Even about both planes: its centre is in the middle.
    middle = Lens.over(WHOLE.unfolded(np.ones(part.window((6, 8)))), factor)
    lens = Lens.over(p, factor, part)
    for axis in (0, 1):  # about the same place
        if not part.mirrored[axis]:
            centre = list(lens.centre)
            centre[axis] = middle.centre[axis]
            lens = Lens(tuple(centre), factor, part)
    np.testing.assert_allclose(part.unfolded(lens(p)), middle(part.unfolded(p)), atol=1e-12)
    found, expected = part.unfolded_vector(lens(q)), middle(part.unfolded_vector(q))
    np.testing.assert_allclose(found, expected, atol=1e-12)
