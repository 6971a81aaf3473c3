"""Slip graded by how much it is held back, and the preconditioners made of it."""

import numpy as np
import pytest
from contact_scenes import PRESS, grid, scene
from hypothesis import given
from hypothesis import strategies as st

from semi_analytical.grades import STIFFNESSES, shares
from semi_analytical.model import ContactModel
from semi_analytical.shear_zones import ShearZones

SHAPE = (16, 24)
SEEDS = st.integers(0, 2**32 - 1)


@given(st.floats(0, 1e6))
def test_shares_of_grades_add_up_to_the_inverse_of_a_stiffness(d):
    """To a quarter between the grades, and exactly beyond the last."""
    found = shares(np.array([d]))[:, 0]
    held = np.sum(found**2 / (1 + np.array([0.0, *STIFFNESSES])))
    assert held * (1 + d) == pytest.approx(1.0, rel=1e-12 if d > STIFFNESSES[-1] else 0.25)
    if d <= STIFFNESSES[-1]:
        assert np.sum(found**2) == pytest.approx(1.0, rel=1e-12)
    assert np.count_nonzero(found) <= 2


def zones_of(rng, self_compliance):
    """Where a third sticks, a third slips and the others are apart."""
    bound = np.where(rng.random(SHAPE) < 0.67, rng.random(SHAPE), 0.0)
    z = 10.0 ** rng.uniform(-2, 2, (1, *SHAPE)) * rng.standard_normal((2, *SHAPE))
    return ShearZones(z, bound, self_compliance), bound


@given(SEEDS)
def test_graded_preconditioner_of_shears_is_symmetric_and_positive(seed):
    rng = np.random.default_rng(seed)
    model = ContactModel.of(scene(PRESS), grid(24))
    zones, _ = zones_of(rng, model.self_compliance)
    inverse = model.operator(SHAPE).shear_inverse
    x, y = (zones.free(v) for v in rng.standard_normal((2, 2, *SHAPE)))
    M_x, M_y = zones.preconditioned(x, inverse), zones.preconditioned(y, inverse)
    scale = np.sqrt(np.sum(x * M_x) * np.sum(y * M_y))
    assert np.sum(x * M_x) > 0
    assert abs(np.sum(y * M_x) - np.sum(x * M_y)) < 1e-12 * scale
    np.testing.assert_allclose(zones.free(M_x), M_x, atol=1e-12 * np.max(np.abs(M_x)))


@pytest.mark.parametrize(("excess", "spread"), [(0.01, 8), (1.0, 8), (30.0, 8), (1e3, 1.1)])
def test_graded_preconditioner_keeps_the_spectrum_of_slip_narrow(excess, spread, rng):
    """Where it is held back least the inverse of the diagonal leaves a spread of 19; where most,
    grades alone one of 3.7."""
    shape = (12, 12)
    model = ContactModel.of(scene(PRESS), grid(24))
    A, inverse, K = (
        model.operator(shape).tangential,
        model.operator(shape).shear_inverse,
        model.self_compliance,
    )
    z = np.zeros((2, *shape))
    z[0] = 1 + excess * (1 + 0.5 * rng.random(shape))
    zones = ShearZones(z, np.ones(shape), K)
    units = np.eye(2 * z[0].size).reshape(-1, 2, *shape)[z[0].size :]
    columns = [zones.free(A(unit)) + zones.turning * unit for unit in units]
    M_H = np.array([zones.preconditioned(c, inverse)[1].ravel() for c in columns]).T
    eigenvalues = np.linalg.eigvals(M_H).real
    assert eigenvalues.max() / eigenvalues.min() < spread
