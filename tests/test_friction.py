"""The friction limit: what it is at a place, on a part of the surface, and in all."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from contact_scene import CoulombFriction
from contact_scene.friction import FRICTIONLESS

CELLS = (6, 5)
PRESSURES = arrays(np.float64, CELLS, elements=st.floats(0.0, 1e9))
UNIFORM = st.floats(0.0, 2.0).map(lambda mu: CoulombFriction(coefficient=mu))
MAPPED = arrays(np.float64, CELLS, elements=st.floats(0.0, 2.0)).map(
    lambda values: CoulombFriction.model_validate({"coefficient": {"map": values}})
)
BOX = (slice(1, 5), slice(2, 4))


@given(UNIFORM | MAPPED, PRESSURES)
def test_the_limit_on_a_part_of_the_surface_is_that_part_of_the_limit(friction, p) -> None:
    whole = friction.limit(p)
    assert whole.shape == p.shape
    np.testing.assert_array_equal(friction.limit(p[BOX], where=BOX), whole[BOX])


@given(UNIFORM | MAPPED, PRESSURES)
def test_the_limit_is_between_none_and_the_largest_ratio_of_the_pressure(friction, p) -> None:
    limit = friction.limit(p)
    assert np.all((limit >= 0) & (limit <= friction.largest * p))
    assert np.all(limit[p == 0] == 0)
    assert not np.any(FRICTIONLESS.limit(p))


@given(UNIFORM | MAPPED, PRESSURES)
def test_the_slope_is_how_fast_the_limit_grows(friction, p) -> None:
    step = np.full(CELLS, 2.0**20)
    grown = friction.limit(p + step) - friction.limit(p)
    np.testing.assert_allclose(grown, friction.slope() * step, atol=1e-6)


@given(UNIFORM | MAPPED, PRESSURES)
def test_what_is_carried_in_all_is_the_sum_of_the_limit_or_not_known(friction, p) -> None:
    carried = friction.carried(float(np.sum(p)))
    assert (carried is None) == (friction.uniform is None) == (friction.cells == CELLS)
    if carried is not None:
        assert carried == pytest.approx(float(np.sum(friction.limit(p))), rel=1e-12, abs=1e-300)
