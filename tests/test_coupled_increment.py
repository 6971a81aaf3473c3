"""Tests of coupled increments: status, contact fraction, and slip from first touch."""

from itertools import groupby

import numpy as np
import pytest
from contact_scenes import APPROACH, LIMIT, LOAD, grid
from coupled_scenes import (
    bulk,
    press,
    scene,
)

from contact_scene.quantities.summary import ContactStatus
from fem_reference.contact.increment import touching_share as share_of_rings
from semi_analytical import SurfaceGrid, solve
from semi_analytical.increments.tangential_state import touching_share

TOLERANCE = 1e-8
GRID = grid(32)


def last(described, on=GRID, tolerance=1e-10):
    return solve(described, on, tolerance).increments[-1]


def test_status_tells_partial_slip_from_no_stick_area_from_gross_sliding():
    shift = {"tangential_shift": (APPROACH, 0.0), "increments": 10}
    path = solve(scene(press(), shift, body=bulk()), GRID, TOLERANCE).increments[2:]
    assert [status for status, _ in groupby(increment.status for increment in path)] == [
        ContactStatus.PARTIAL_SLIP,
        ContactStatus.NO_STICK_AREA_LEFT,
        ContactStatus.GROSS_SLIDING,
    ]
    for increment in path:
        assert (increment.stick_area == 0) == (increment.status is not ContactStatus.PARTIAL_SLIP)
    # The force rises all the way: no peak above what sliding takes, and no drop after it.
    force = [increment.tangential_force[0] for increment in path]
    assert np.all(np.diff(force) > 0)
    assert force[-1] == pytest.approx(LIMIT, rel=1e-5)


def test_one_cell_that_touches_sticks_and_its_slip_of_round_off_is_none():
    """Its own displacement vanishes by symmetry: what its pressure does around it tells a scale."""
    odd = SurfaceGrid((45, 45), (9 * GRID.window[0], 9 * GRID.window[1]))
    end = last(scene(press(1e-6, increments=2)), odd)
    assert np.count_nonzero(end.in_contact) == 1
    assert end.status is ContactStatus.FULL_STICK
    assert end.halvings == 0
    assert end.residuals.slip_direction < 1e-10


def to(x, load, increments=4) -> dict:
    """Both forces at once, in parts of the friction limit under full load and of that load."""
    force = {"tangential_force": (x * LIMIT, 0.0), "normal_force": load * LOAD}
    return {**force, "increments": increments}


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


def test_parting_is_meeting_backwards():
    meets = touching_share(hertz(0.8), hertz(1.0), SQUARED)
    np.testing.assert_array_equal(touching_share(hertz(1.0), hertz(0.8), SQUARED), meets)
    assert np.any(meets < 1)


def test_slip_and_its_energy_count_from_touch():
    """Against many increments; charged for all motion they are off by 0.58 and 0.08."""

    def pressed(increments):
        return solve(
            scene(press(increments=increments), body=bulk(0.3)), grid(40, 1.25), 1e-7
        ).increments[-1]

    few, many = pressed(10), pressed(40)
    assert np.max(np.hypot(*few.slip)) == pytest.approx(np.max(np.hypot(*many.slip)), rel=0.06)
    assert few.dissipated_energy == pytest.approx(many.dissipated_energy, rel=0.03)


def test_rings_touch_for_their_part_of_the_way_of_the_edge():
    radii = np.array([0.5, 1.25, 1.75, 3.0])
    small, large = (1.0, radii > 1.0), (2.0, radii > 2.0)
    for (edge, apart), (edge_after, apart_after) in ((small, large), (large, small)):
        share = share_of_rings(radii, apart, apart_after, edge, edge_after)
        np.testing.assert_allclose(share[:3], [1.0, 0.75, 0.25])
    assert share_of_rings(radii, small[1], large[1], 1.0, 2.0)[3] == 0.0
