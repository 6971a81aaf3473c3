"""The FFT operators are the dense matrices of the influence coefficients."""

import numpy as np
import pytest
from contact_scenes import steel
from hypothesis import assume, given
from hypothesis import strategies as st

from contact_scene import RIGID, Body, IsotropicMaterial, Layer, Paraboloid
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.operator.domain import WINDOW
from semi_analytical.operator.operator import DisplacementOperator, inverse_2x2
from semi_analytical.operator.slip_compliance_bins import STIFFNESSES
from semi_analytical.operator.transforms import Convolutions, offsets_for

SHAPES = [(6, 5), (2, 7), (7, 11), (16, 8), (13, 17), (31, 3)]
SPACINGS = [(1.0, 1.0), (0.3, 1.7)]
ROUND_OFF = 1e-13
ELASTIC = Body(material=steel()), Paraboloid(radius=1, material=steel(0.3))


def coefficients(shape, spacing, bodies=ELASTIC):
    return influence_coefficients(*bodies, spacing, offsets_for(shape))


def operator(shape, spacing=(0.3, 1.7), bodies=ELASTIC):
    K = coefficients(shape, spacing, bodies)
    return DisplacementOperator(K, shape, WINDOW, Convolutions())


def dense(values, shape, parity):
    """The matrix of a component from its first quadrant and its parity along x and y."""
    i, j = (axis.ravel() for axis in np.indices(shape))
    di, dj = i[:, None] - i, j[:, None] - j
    sign = np.where(di < 0, parity[0], 1) * np.where(dj < 0, parity[1], 1)
    return sign * values[np.abs(di), np.abs(dj)]


@pytest.mark.parametrize("spacing", SPACINGS)
@pytest.mark.parametrize("shape", SHAPES)
def test_operators_are_dense_matrices(shape, spacing, rng):
    """Pressure moves sideways as shear moves normally, with the opposite sign and transposed."""
    bodies = ELASTIC[0], Paraboloid(radius=1, material=RIGID)
    K, A = coefficients(shape, spacing, bodies), operator(shape, spacing, bodies)
    parity = {
        "xx": (1, 1),
        "yy": (1, 1),
        "zz": (1, 1),
        "xy": (-1, -1),
        "zx": (-1, 1),
        "zy": (1, -1),
    }
    xx, yy, zz, xy, zx, zy = (dense(getattr(K, c), shape, sign) for c, sign in parity.items())
    p, q = rng.standard_normal(shape), rng.standard_normal((2, *shape))
    for found, expected in (
        (A.normal(p), zz @ p.ravel()),
        (A.tangential(q), np.block([[xx, xy], [xy, yy]]) @ q.ravel()),
        (A.normal_by_shear(q), np.hstack([zx, zy]) @ q.ravel()),
        (A.tangential_by_pressure(p), -np.vstack([zx, zy]) @ p.ravel()),
    ):
        assert np.max(np.abs(found.ravel() - expected)) < ROUND_OFF * np.max(np.abs(expected))


@given(st.tuples(st.integers(2, 24), st.integers(2, 24)), st.integers(0, 2**32 - 1))
def test_operators_and_preconditioners_are_symmetric_and_positive(shape, seed):
    rng = np.random.default_rng(seed)
    A = operator(shape)
    p, other = rng.standard_normal((2, *shape))
    q, another = rng.standard_normal((2, 2, *shape))
    graded = rng.standard_normal((2, 2 + len(STIFFNESSES), *shape))
    for apply, x, y in [
        (A.normal, p, other),
        (A.precondition, p, other),
        (A.tangential, q, another),
        (A.shear_inverse, *graded),
    ]:
        A_x, A_y = apply(x), apply(y)
        scale = np.sqrt(np.sum(x * A_x) * np.sum(y * A_y))
        assert np.sum(x * A_x) > 0
        assert abs(np.sum(y * A_x) - np.sum(x * A_y)) < 1e-12 * scale


def sheared(of):
    """The approximate inverse for cells that stick."""
    return lambda u: of.shear_inverse(np.concatenate([u, np.zeros_like(u)[: len(STIFFNESSES)]]))[:2]


@pytest.mark.parametrize("which", [0, 1], ids=["pressure", "shear"])
def test_preconditioner_makes_the_spectrum_independent_of_the_mesh(which):
    """The reason it is there: the spread of the eigenvalues hardly grows with the cells."""

    def spread(shape):
        of = operator(shape, (1.0, 1.0))
        A, inverse = (of.tangential, sheared(of)) if which else (of.normal, of.precondition)
        lead = (2,) if which else ()
        units = np.eye(np.prod((*lead, *shape))).reshape(-1, *lead, *shape)
        M_A = np.array([inverse(A(unit)).ravel() for unit in units]).T
        eigenvalues = np.linalg.eigvals(M_A).real
        return eigenvalues.max() / eigenvalues.min()

    assert spread((12, 12)) < 1.6 * spread((6, 6))


STIFF_FILMS = [(1e3, 0.003, (48, 48)), (1e3, 0.003, (12, 48)), (1e4, 0.01, (48, 48))]


@pytest.mark.parametrize(("ratio", "thickness", "shape"), STIFF_FILMS)
def test_shear_preconditioner_is_positive_below_stiff_films(ratio, thickness, shape):
    """Though the spectrum it inverts is not: such films wave beyond the period of the grid."""
    film = IsotropicMaterial(young_modulus=ratio, poisson_ratio=0.5)
    base = IsotropicMaterial(young_modulus=1.0, poisson_ratio=0.3)
    body = Body(material=base, layers=(Layer(thickness=thickness, material=film),))
    rigid = Paraboloid(radius=1, material=RIGID)
    K = influence_coefficients(body, rigid, (2.6 / 48, 2.6 / 48), offsets_for(shape))
    A = DisplacementOperator(K, shape, WINDOW, Convolutions())
    inverse = sheared(A)
    xx, yy, xy = (A.spectrum(pair).quarter[::2, ::2] for pair in ("xx", "yy", "xy"))
    assert np.min(0.5 * (xx + yy) - np.hypot(0.5 * (xx - yy), xy)) < 0
    i, j = np.meshgrid(*map(np.arange, shape), indexing="ij")
    for m in range(shape[0] // 2 + 1):
        for n in range(shape[1] // 2 + 1):
            wave = np.cos(2 * np.pi * (m * i / shape[0] + n * j / shape[1]))
            for direction in ((1, 0), (0, 1), (1, 1), (1, -1)):
                v = np.multiply.outer(direction, wave)
                assert np.sum(v * inverse(v)) > 0


@given(st.floats(-1, 1), st.floats(-1, 1), st.floats(-1, 1))
def test_inverse_has_the_magnitudes_of_the_eigenvalues(xx, yy, xy):
    values, vectors = np.linalg.eigh([[xx, xy], [xy, yy]])
    assume(np.min(np.abs(values)) > 1e-3)
    expected = vectors @ np.diag(1 / np.abs(values)) @ vectors.T
    got = inverse_2x2(*(np.array([[value]]) for value in (xx, yy, xy)))
    got = np.array([[got[0], got[2]], [got[2], got[1]]]).reshape(2, 2)
    np.testing.assert_allclose(got, expected, atol=1e-10 * np.max(np.abs(expected)))
