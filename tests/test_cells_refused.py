"""Tests of contacts that the cells refuse: too wide, too small, too large, or not converged."""

import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    PRESS,
    RADIUS,
    A,
    grid,
    push,
    scene,
    steel,
)

from contact_scene import (
    Paraboloid,
    SurfaceDiscretisation,
)
from semi_analytical import (
    ContactAtWindowEdge,
    ContactNotResolved,
    NotConverged,
    ResourceRefused,
    SurfaceGrid,
    solve,
    solve_discretised,
)
from semi_analytical.increments import stick_slip

LOOSE = 1e-8


def test_contact_that_grows_to_the_edge_names_the_step_and_keeps_the_state_before():
    with pytest.raises(ContactAtWindowEdge, match="step 2") as caught:
        solve(scene(PRESS, {"normal_force": 1e5}), grid(), LOOSE)
    assert caught.value.last_state.normal_force == pytest.approx(1e3)


@pytest.mark.parametrize("cells", [31, 32])
def test_contact_between_the_cell_centres_is_refused(cells):
    tiny = {"approach": 1e-7 * APPROACH}
    on = grid(cells)
    asked = SurfaceDiscretisation(cells=on.cells, window=on.window)
    touched = r"1 of them carry" if cells % 2 else r"no cell .* contact"  # a centre is at the tip
    with pytest.raises(ContactNotResolved, match=touched):
        solve_discretised(scene(tiny, friction=None), asked)


class Unseen(Paraboloid):
    """Its gap is never asked for."""

    def initial_gap(self, x, y):
        pytest.fail("memory is taken")


def test_more_memory_than_there_is_is_refused_before_any_is_taken():
    enormous = SurfaceGrid((2**20, 2**20), (3 * A, 3 * A))
    with pytest.raises(ResourceRefused, match=r"GiB.*fewer cells"):
        solve(scene(PRESS), enormous, LOOSE)
    ball = Unseen(radius=RADIUS, material=steel())
    asked = SurfaceDiscretisation(cells=(16384, 16384), window=(3 * A, 3 * A))
    long = scene({**PRESS, "increments": 50}, push(0.5, increments=50), indenter=ball)
    with pytest.raises(ResourceRefused, match=r"GiB.*fewer cells"):
        solve_discretised(long, asked)


def test_not_converged_says_where_and_carries_the_last_good_state(monkeypatch):
    def fail(*_, **__):
        raise NotConverged("the shear", 7, 1e-3, LOOSE)

    seen = []
    monkeypatch.setattr(stick_slip, "shear", fail)
    with pytest.raises(NotConverged, match=r"step 2, increment 1 of 2.*1\.00e-03.*7") as caught:
        solve(scene(PRESS, push(0.5, increments=2)), grid(), LOOSE, seen.append)
    error = caught.value
    assert (error.iterations, error.residual, error.tolerance) == (7, 1e-3, LOOSE)
    np.testing.assert_array_equal(error.last_state.pressure, seen[-1].pressure)
