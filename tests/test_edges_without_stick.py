"""Edges of bodies that couple, inside the cells, where no cell sticks and yet not all slides."""

import numpy as np
import pytest
from contact_scenes import grid
from coupled_scenes import bulk, press, scene

from semi_analytical import plan, solve


@pytest.mark.parametrize("cells", [32])
def test_stick_narrower_than_a_cell_does_not_keep_the_edge_of_contact_on_cells(cells):
    """On odd cells one sticks; on these none does."""
    described = scene(press(increments=4), body=bulk(0.0))
    decided = plan(described, edge="last")
    none, one = (
        solve(described, grid(n, 1.1), 1e-8, plan=decided).steps[0] for n in (cells, cells + 1)
    )
    assert not np.any(none.in_stick)
    assert none.edge_change is not None
    exact = solve(described, grid(97, 1.1), 1e-8, plan=decided).steps[0]
    for end in (none, one):
        assert end.contact_radius == pytest.approx(exact.contact_radius, rel=3e-4)
        assert end.approach == pytest.approx(exact.approach, rel=3e-5)
