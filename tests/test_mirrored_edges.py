"""Edges inside the cells of a quarter of the window are those of the whole."""

from dataclasses import replace

import numpy as np
import pytest
from cell_means import ellipse_means
from contact_scenes import LOAD, RADIUS, A, push, scene, steel

from contact_scene import RIGID, Body, Ellipsoid
from semi_analytical import SurfaceGrid, plan, solve
from semi_analytical.edge.displacement import EdgeOperator, Within
from semi_analytical.edge.kernels import PART_OFFSETS, PARTS, EdgeKernels
from semi_analytical.edge.mirrored_displacement import MirroredEdgeOperator
from semi_analytical.edge.rim import rim
from semi_analytical.influence.bodies import influence_coefficients
from semi_analytical.mirrored_transform import mirrored_offsets
from semi_analytical.padded_transform import Convolutions
from semi_analytical.part import QUARTER, WHOLE, Part

CELLS, RADII = 48, (20.3, 16.2)


def within(part: Part) -> Within:
    """Of a pressure below an ellipse, found on a part of the window."""
    centre = ((CELLS - 1) / 2,) * 2
    p = part.of(ellipse_means(CELLS, RADII, centre))
    edge = rim(p, p > 0, part=part)
    assert edge is not None
    return Within.of(p, edge.i, edge.j, edge.parts, part)


def test_what_a_pressure_is_within_the_cells_is_told_by_a_quarter():
    whole, unfolded = within(WHOLE), within(QUARTER).unfolded(QUARTER)
    np.testing.assert_allclose(unfolded.slopes, whole.slopes, rtol=0, atol=1e-12)
    order, other = (np.lexsort((w.j, w.i)) for w in (whole, unfolded))
    np.testing.assert_array_equal(unfolded.i[other], whole.i[order])
    np.testing.assert_array_equal(unfolded.j[other], whole.j[order])
    np.testing.assert_allclose(unfolded.rest[other], whole.rest[order], rtol=0, atol=1e-12)


@pytest.mark.parametrize("side", [CELLS, 4 * CELLS], ids=["by matrices", "by transforms"])
def test_what_a_quarter_moves_is_what_the_whole_moves(side):
    spacing, body, rigid = (1.0, 0.7), Body(material=steel()), Body(material=RIGID)
    offsets = mirrored_offsets((side // 2, side // 2))
    kernels = EdgeKernels(
        "zz",
        influence_coefficients(body, rigid, spacing, offsets),
        influence_coefficients(body, rigid, (1 / PARTS, 0.7 / PARTS), (PART_OFFSETS, PART_OFFSETS)),
    )
    rng = np.random.default_rng(0)
    quarter = side // 2, side // 2
    i, j = (rng.permutation(side // 2)[:9] for _ in range(2))
    # On both planes and in the corner between them, too.
    i, j = np.concatenate([i, [0, 3, 0]]), np.concatenate([j, [5, 0, 0]])
    some = Within(rng.normal(size=(2, *quarter)), i, j, rng.normal(size=(len(i), PARTS, PARTS)))
    whole = EdgeOperator([[(1, kernels)]], (side, side), Convolutions())
    expected = QUARTER.of(whole(some.unfolded(QUARTER))[0])
    counter = Convolutions()
    found = MirroredEdgeOperator(kernels, quarter, counter)(some)[0]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-11 * np.max(np.abs(expected)))
    assert counter.count == 1.5


@pytest.mark.parametrize("cells", [(40, 36), (26, 34)], ids=str)
def test_edges_found_on_a_quarter_are_those_of_the_whole_window(cells):
    """To a tenth of the tolerance: the rounds are the same."""
    some, every = found_on_both(cells, {"normal_force": LOAD}, friction=None)
    assert some.edge_change == pytest.approx(every.edge_change, rel=1e-5)
    scale = np.max(every.pressure)
    np.testing.assert_allclose(some.pressure, every.pressure, rtol=0, atol=1e-9 * scale)
    np.testing.assert_allclose(some.gap, every.gap, rtol=0, atol=1e-9 * every.approach)
    assert some.contact_radius == pytest.approx(every.contact_radius, rel=1e-9)
    assert some.approach == pytest.approx(every.approach, rel=1e-9)


def test_with_shear_they_are_to_a_millionth():
    some, every = found_on_both((40, 36), {"normal_force": LOAD}, push(0.6), friction=0.1)
    scale = np.max(every.pressure)
    np.testing.assert_allclose(some.pressure, every.pressure, rtol=0, atol=1e-9 * scale)
    np.testing.assert_allclose(some.shear, every.shear, rtol=0, atol=1e-6 * scale)


def found_on_both(cells, *loading, friction):
    """The end on a quarter, and on the whole window."""
    ellipsoid = Ellipsoid(radii=(RADIUS, 2 * RADIUS), material=steel())
    of = scene(*loading, friction=friction, indenter=ellipsoid)
    decided, grid = plan(of, edge="last"), SurfaceGrid(cells, (3.4 * A, 4.2 * A))
    assert decided.quarter
    some, every = (
        solve(of, grid, 1e-8, plan=replace(decided, quarter=quarter)).steps[-1]
        for quarter in (True, False)
    )
    assert some.edge_change is not None
    return some, every
