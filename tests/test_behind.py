"""The path so far: how far the next increment goes on, and what that spares the shear solver."""

from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import PRESS, grid, push, scene

from semi_analytical import solve
from semi_analytical.behind import Behind, further, further_shear
from semi_analytical.pressing import NormalTarget
from semi_analytical.shearing import TangentialTarget, Torsion

TOLERANCE = 1e-8
NOTHING = np.zeros((2, 1, 1))
FIRST = Behind(
    target=NormalTarget(force=1.0),
    pressure=NOTHING[0],
    shear=NOTHING + 1,
    displacement=NOTHING + 10,
    normal_force=1.0,
    approach=1.0,
    covered_cells=1.0,
    force=np.array([0.1, 0.2]),
    shift=np.array([1.0, 2.0]),
)
SECOND = replace(
    FIRST,
    shear=NOTHING + 3,
    displacement=NOTHING + 50,
    force=np.array([0.3, 0.5]),
    shift=np.array([3.0, 5.0]),
)
WAY = np.array([0.2, 0.3])


@pytest.mark.parametrize("part", [0.01, 0.5, 1.0, 2.0])
def test_where_the_load_goes_straight_on_the_shear_goes_as_much_further(part):
    for target in (
        TangentialTarget(force=SECOND.force + part * WAY),
        TangentialTarget(shift=SECOND.shift + 10 * part * WAY),
    ):
        assert further(SECOND, FIRST, target) == pytest.approx(part, rel=1e-12)
        shear, displacement = further_shear(SECOND, FIRST, target)
        np.testing.assert_allclose(shear, 3 + 2 * part)
        np.testing.assert_allclose(displacement, 50 + 40 * part)


@pytest.mark.parametrize("way", [-WAY, 2.1 * WAY, 0 * WAY, WAY @ [[1, 0.01], [0, 1]]])
def test_where_the_load_turns_rests_or_leaps_the_shear_stays(way):
    target = TangentialTarget(force=SECOND.force + way)
    assert further(SECOND, FIRST, target) == 0
    assert further_shear(SECOND, FIRST, target) == (SECOND.shear, SECOND.displacement)


def test_nothing_goes_on_from_another_normal_load_from_nothing_or_in_a_twist():
    straight = TangentialTarget(force=SECOND.force + WAY)
    assert further(SECOND, FIRST, straight) > 0
    assert further(SECOND, None, straight) == 0
    assert further(SECOND, replace(FIRST, force=SECOND.force), straight) == 0
    assert further(SECOND, replace(FIRST, target=NormalTarget(force=0.9)), straight) == 0
    assert further(SECOND, FIRST, replace(straight, torsion=Torsion(twist=0.0))) == 0


def products(described, cells):
    """Of two convolutions each, in every increment but the first, which presses."""
    increments = solve(described, grid(cells), TOLERANCE).increments
    assert all(increment.halvings == 0 for increment in increments)
    return np.array([0.5 * increment.convolutions for increment in increments[1:]])


def test_a_loop_takes_few_products_on_any_cells():
    """Nested grids, the inverse on stick and the diagonal on slip took 41 and 80."""
    loop = scene(PRESS, push(0.9, increments=9), push(-0.9, increments=18))
    few, many = (np.mean(products(loop, cells)) for cells in (32, 128))
    assert few < 17
    assert many < 1.3**2 * few
