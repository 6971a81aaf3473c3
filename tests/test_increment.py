"""Tests of single increments: one cell in contact, and the contact fraction."""

import numpy as np
import pytest
from contact_scenes import (
    grid,
)
from coupled_scenes import press
from coupled_scenes import scene as coupled_scene

from contact_scene.quantities.summary import ContactStatus
from fem_reference.contact.increment import touching_share as share_of_rings
from semi_analytical import SurfaceGrid, solve
from semi_analytical.increments.tangential_state import touching_share


def test_one_cell_that_touches_sticks_and_its_slip_of_round_off_is_none():
    """Its own displacement vanishes by symmetry: what its pressure does around it tells a scale."""
    odd = SurfaceGrid((45, 45), (9 * grid().window[0], 9 * grid().window[1]))
    end = solve(coupled_scene(press(1e-6, increments=2)), odd, 1e-10).increments[-1]
    assert np.count_nonzero(end.in_contact) == 1
    assert end.status is ContactStatus.FULL_STICK
    assert end.halvings == 0
    assert end.residuals.slip_direction < 1e-10


X = np.linspace(-1.2, 1.2, 49)
SQUARED = X[:, None] ** 2 + X**2


def hertz(a, squared=SQUARED):
    """Pressure below a paraboloid in contact up to a, over its largest at a = 1."""
    return np.sqrt(np.maximum(a**2 - squared, 0.0))


@pytest.mark.parametrize("a", [0.0, 0.52, 0.88])
def test_below_a_paraboloid_the_share_is_that_of_the_area(a):
    share = touching_share(hertz(a), hertz(1.0), SQUARED)
    meets = (a**2 < SQUARED) & (SQUARED < 1)
    np.testing.assert_allclose(share[meets], (1 - SQUARED[meets]) / (1 - a**2), atol=1e-9)
    assert np.all(share[~meets] == 1)


def test_a_lower_summit_touches_later():
    """Of alike summits each has p² in proportion to how far it is pressed in."""
    nearer, farther = (SQUARED + 1.2 * X[:, None] * side + 0.36 for side in (1, -1))
    before, after = hertz(0.3, nearer), hertz(0.5, nearer) + hertz(0.2, farther)
    share = touching_share(before, after, SQUARED)
    assert share[farther < 0.04].max() == pytest.approx(0.04 / 0.16)


def test_rings_touch_for_their_part_of_the_way_of_the_edge():
    radii = np.array([0.5, 1.25, 1.75, 3.0])
    small, large = (1.0, radii > 1.0), (2.0, radii > 2.0)
    for (edge, apart), (edge_after, apart_after) in ((small, large), (large, small)):
        share = share_of_rings(radii, apart, apart_after, edge, edge_after)
        np.testing.assert_allclose(share[:3], [1.0, 0.75, 0.25])
    assert share_of_rings(radii, small[1], large[1], 1.0, 2.0)[3] == 0.0
