"""The studies of the report measure what they say."""

import numpy as np
import pytest

from semi_analytical.frf.stack import Stack
from verification.laws.classical_forms import FORMS, digit_losses
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


def test_classical_forms_agree_where_they_are_well_conditioned():
    losses = digit_losses(contrasts=(0.5, 4.0), depths=(0.5, 2.0))
    assert {loss.form for loss in losses} == set(FORMS)
    assert max(loss.error for loss in losses) < 1e-13


@pytest.mark.parametrize(
    ("form", "contrast", "depth"),
    [
        ("layer stiffness", 1e6, 1e-8),
        ("global 6x6", 1e-6, 1e-8),
        ("closed form", 1e6, 1e-8),
        ("transfer matrix", 4.0, 316.0),
    ],
)
def test_classical_forms_lose_digits(form, contrast, depth):
    losses = digit_losses((contrast,), (depth,))
    assert next(loss.error for loss in losses if loss.form == form) > 1e-12


def test_growing_exponentials_overflow():
    overflown = {loss.form for loss in digit_losses((4.0,), (1e4,)) if np.isinf(loss.error)}
    assert overflown == {"transfer matrix", "layer stiffness"}
