"""Means of a known field over cells."""

import numpy as np
import pytest

from semi_analytical import SurfaceGrid
from tests.cell_means import ellipse_means
from verification.cell_means import cell_means, round_means
from verification.problems.hertz import BALL
from verification.studies.work_precision.setting import Method, PrecisionCase

EXACT = BALL.ends[-1]


@pytest.mark.parametrize("cells", [(16, 16), (33, 20), (128, 128)])
def test_means_over_cells_carry_the_load(cells: tuple[int, int]) -> None:
    side = 2.6 * BALL.radius
    grid = SurfaceGrid(cells, (side, 1.1 * side))
    means = round_means(EXACT.pressure, *grid.coordinates(), grid.spacing)
    assert grid.cell_area * np.sum(means) == pytest.approx(EXACT.load, rel=5e-6)


def test_means_over_cells_are_those_of_another_quadrature() -> None:
    radius, cells = 7.3, 24
    at = np.arange(cells) - 11.0
    x, y = np.meshgrid(at, at, indexing="ij")
    known = ellipse_means(cells, (radius, radius), (11.0, 11.0))
    means = round_means(lambda r: np.sqrt(np.maximum(1 - (r / radius) ** 2, 0)), x, y, (1.0, 1.0))
    assert np.max(np.abs(means - known)) < 5e-4


@pytest.mark.parametrize("inside", [0.01, 0.05, 0.3, 1.99])
@pytest.mark.parametrize("towards", [(1, 1), (-1, -1), (1, -1)])
def test_an_edge_that_cuts_off_a_corner_is_seen(towards: tuple[int, int], inside: float) -> None:
    """Of a traction that rises as the root of the distance from a straight edge."""
    (m, n), side = towards, np.array([2.0])
    (mean,) = cell_means(
        lambda x, y: np.sqrt(np.maximum(m * x + n * y - 2.0 + inside, 0)),
        np.zeros(1), np.zeros(1), (side, side),
    )  # fmt: skip
    assert mean == pytest.approx(inside**2.5 / 15, abs=2e-4 * inside**0.5)
    assert mean > 0


def test_means_of_cells_that_lie_anywhere_are_those_of_the_grid() -> None:
    grid = SurfaceGrid((32, 48), (3 * BALL.radius, 3 * BALL.radius))
    x, y = grid.coordinates()
    on_grid = round_means(EXACT.pressure, x, y, grid.spacing)
    some = np.random.default_rng(1).permutation(x.size)[:500]
    sides = tuple(np.full(500, side) for side in grid.spacing)
    alone = cell_means(
        lambda x, y: EXACT.pressure(np.hypot(x, y)), x.flat[some], y.flat[some], sides
    )
    assert np.array_equal(alone, on_grid.flat[some])


def test_edges_inside_cells_are_known_by_their_means() -> None:
    """Cells alone err a hundred times as much, and so would these against values at centres."""
    errors = {
        method: PrecisionCase("hertz", method, 32).compute().measures["pressure"]
        for method in (Method.EDGES, Method.SURFACE)
    }
    assert errors[Method.EDGES] < 2e-4 < 1e-2 < errors[Method.SURFACE]
