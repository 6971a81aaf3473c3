"""Tests of the friction limit: at a point, on a part of the surface, and in total."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from pydantic import ValidationError

from contact_scene import (
    CoulombFriction,
    FrictionMap,
)
from contact_scene.friction import sliding_friction
from contact_scene.friction_limit import refuse_above_limit
from contact_scene.solver_errors import GrossSliding

CELLS = (6, 5)
PRESSURES = arrays(np.float64, CELLS, elements=st.floats(0.0, 1e9))
COEFFICIENTS = st.floats(0.0, 2.0)
BOX = (slice(1, 5), slice(2, 4))


@given(COEFFICIENTS | arrays(np.float64, CELLS, elements=COEFFICIENTS), PRESSURES)
def test_friction_carries_the_pressure_times_the_coefficient_of_the_place(mu, p):
    """What it carries in all is known unless the coefficients of a map differ."""
    given = mu if isinstance(mu, float) else {"map": mu, "spacing": 1.0}
    friction, limit = CoulombFriction.model_validate({"coefficient": given}), mu * p
    np.testing.assert_array_equal(friction.limit(p), limit)
    np.testing.assert_array_equal(friction.limit(p[BOX], where=BOX), limit[BOX])
    assert np.all(friction.slope(p) == mu)
    assert friction.largest == np.max(mu)
    carried, differ = friction.largest_tangential_force(float(np.sum(p))), np.ptp(mu) > 0
    assert (carried is None) == (friction.coefficient_map is not None) == differ
    assert differ or carried == pytest.approx(np.sum(limit), rel=1e-12, abs=1e-300)


@pytest.mark.parametrize("excess", [1e-9, 1e-3, 1.0])
def test_a_load_above_the_limit_is_shown_apart_from_it(excess):
    with pytest.raises(GrossSliding) as refused:
        refuse_above_limit(20.0 * (1 + excess), 0.0, 1 / (1 + excess))
    load, limit = re.findall(r"[\d.]+(?= N)", str(refused.value))
    assert float(load) > float(limit) == 20.0


def mapped(values, **placed):
    return FrictionMap.model_validate({"map": values, "spacing": (0.5, 2.0), **placed})


@pytest.mark.parametrize("origin", [(0.0, 0.0), (0.3, -0.9)])
@pytest.mark.parametrize(("cells", "window"), [((7, 8), (1.0, 2.0)), ((30, 5), (1.9, 4.0))])
def test_a_coefficient_stays_at_its_place_whatever_window_and_cells(origin, cells, window):
    def plane(x, y):
        return 0.5 + 0.1 * x - 0.03 * y

    x, y = (np.arange(n) - (n - 1) / 2 for n in CELLS)
    values = plane(0.5 * x[:, None] + origin[0], 2.0 * y + origin[1])
    spacing = (window[0] / cells[0], window[1] / cells[1])
    found = mapped(values, origin=origin).on_grid(cells, spacing).map.values
    x, y = ((np.arange(n) - (n - 1) / 2) * side for n, side in zip(cells, spacing, strict=True))
    np.testing.assert_allclose(found, plane(x[:, None], y), rtol=1e-12)


def test_a_map_is_even_about_the_origin_of_the_contact_alone():
    even = 0.1 + 0.01 * np.add.outer(np.abs(np.arange(6) - 2.5), np.abs(np.arange(5) - 2))
    assert mapped(even).is_even
    assert not any(mapped(even, origin=at).is_even for at in ((0.3, 0.0), (0.0, -0.9)))
    assert not any(mapped(even + np.eye(6, 5)[::sign]).is_even for sign in (1, -1))


def test_beyond_its_extent_a_map_says_nothing():
    placed = mapped(np.ones(CELLS), origin=(-0.5, 1.0))
    assert placed.extent == (2.0, 8.0)
    placed.on_grid((8, 8), (0.25, 1.0))
    with pytest.raises(ValueError, match="at most"):
        placed.on_grid((8, 8), (0.25, 1.01 * 1.25))
    with pytest.raises(ValidationError, match="does not reach the origin"):
        mapped(np.ones(CELLS), origin=(1.5, 0.0))


def test_friction_while_sliding_is_the_mean_of_both_limits_along_the_shear_at_the_end():
    start, shear = np.ones((2, 3)), np.array([[3.0, 0.0, -6.0], [4.0, 0.0, 0.0]])
    limits = np.array([1.0, 2.0, 0.0]), np.array([4.0, 2.0, 3.0])
    found = sliding_friction(start, shear, np.ones((2, 3)), *limits)
    np.testing.assert_allclose(found, [[1.5, 0.0, -1.5], [2.0, 0.0, 0.0]], rtol=1e-15)


def test_friction_of_what_parts_is_along_its_way_and_half_the_shear_that_it_had():
    start, passed = np.array([[0.3], [-0.4]]), np.array([[0.0], [-7.0]])
    found = sliding_friction(start, 0 * start, passed, np.array([1.0]), np.array([0.0]))
    np.testing.assert_allclose(found, [[0.0], [-0.25]], rtol=1e-15)
