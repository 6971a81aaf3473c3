"""The first pressure is Hertz's where Hertz knows, and some pressure where he does not."""

import numpy as np
import pytest
from contact_scenes import LOAD, PRESS, RADIUS, grid, scene

from contact_scene.pair import contact_modulus
from semi_analytical.bearing import bearing_pressure, modulus_of
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.normal_load import FixedApproach, PressureSum
from verification.closed_forms.hertz import PointContact

CELLS = grid(96)
MODULUS = contact_modulus(scene(PRESS))
HERTZ = PointContact.under_load(LOAD, RADIUS, MODULUS)
X, Y = CELLS.coordinates()
GAP = (X**2 + Y**2) / (2 * RADIUS)


@pytest.mark.parametrize("sides", [(1.0, 1.0), (0.3, 1.7)])
@pytest.mark.parametrize("cells", [(1, 1), (3, 1), (5, 8)])
def test_a_rectangle_on_a_half_space_tells_its_modulus(sides, cells):
    """Exactly: the mean of 1/r over a rectangle, about its middle, is known."""
    K = influence_coefficients(scene(PRESS).body, scene(PRESS).indenter, sides, cells)
    assert modulus_of(K.zz, sides) == pytest.approx(MODULUS, rel=1e-12)


@pytest.mark.parametrize(
    "load", [PressureSum(LOAD / CELLS.cell_area), FixedApproach(HERTZ.approach)]
)
def test_below_a_paraboloid_it_is_the_pressure_of_hertz(load):
    p = bearing_pressure(GAP, load, MODULUS, CELLS.cell_area)
    exact = HERTZ.pressure(np.hypot(X, Y))
    assert np.sum(p) * CELLS.cell_area == pytest.approx(LOAD, rel=0.01)
    assert np.sqrt(np.sum((p - exact) ** 2) / np.sum(exact**2)) < 0.03


@pytest.mark.parametrize("load", [PressureSum(1e-9), FixedApproach(2.5)])
def test_where_no_cell_bears_by_hertz_all_do_that_can_touch(load):
    gap = np.array([[2.0, 3.0], [np.inf, 4.0]])
    np.testing.assert_array_equal(bearing_pressure(gap, load, 1.0, 1.0), np.isfinite(gap))
