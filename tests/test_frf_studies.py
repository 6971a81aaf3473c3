"""The studies of the report measure what they say."""

import pytest

from semi_analytical.frf.stack import Stack
from verification.laws.sampling_route import sampling_errors

COATED = Stack([(2.0, 0.3, 1.0)], (1.0, 0.25))


def test_sampling_on_the_bare_grid_is_off_by_a_seventh():
    errors = sampling_errors(COATED, 0.125, 32, refinement=1, extension=2)
    assert errors.own == pytest.approx(-0.15, abs=0.01)
    assert errors.neighbour == pytest.approx(0.12, abs=0.02)
    assert errors.coupling == pytest.approx(0.21, abs=0.02)


def test_refinement_removes_aliasing_and_extension_the_images():
    coarse, fine = (sampling_errors(COATED, 0.125, 16, r, 4) for r in (2, 8))
    assert abs(fine.own) < 0.01 < 0.05 < abs(coarse.own)
    near, far = (sampling_errors(COATED, 0.125, 16, 4, e) for e in (2, 16))
    assert abs(far.far_shape) < 1e-3 < 0.1 < abs(near.far_shape)
