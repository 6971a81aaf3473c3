"""Means of a known field over cells."""

import numpy as np
import pytest

from semi_analytical import SurfaceGrid
from tests.cell_means import ellipse_means
from verification.cell_means import cell_means
from verification.problems.hertz import BALL
from verification.studies.work_precision.setting import Method, PrecisionCase

EXACT = BALL.ends[-1]


@pytest.mark.parametrize("cells", [(16, 16), (33, 20), (128, 128)])
def test_means_over_cells_carry_the_load(cells: tuple[int, int]) -> None:
    side = 2.6 * BALL.radius
    grid = SurfaceGrid(cells, (side, 1.1 * side))
    means = cell_means(EXACT.pressure, *grid.coordinates(), grid.spacing)
    assert grid.cell_area * np.sum(means) == pytest.approx(EXACT.load, rel=5e-6)


def test_means_over_cells_are_those_of_another_quadrature() -> None:
    radius, cells = 7.3, 24
    at = np.arange(cells) - 11.0
    x, y = np.meshgrid(at, at, indexing="ij")
    known = ellipse_means(cells, (radius, radius), (11.0, 11.0))
    means = cell_means(lambda r: np.sqrt(np.maximum(1 - (r / radius) ** 2, 0)), x, y, (1.0, 1.0))
    assert np.max(np.abs(means - known)) < 5e-4


def test_edges_inside_cells_are_known_by_their_means() -> None:
    """Cells alone err a hundred times as much, and so would these against values at centres."""
    errors = {
        method: PrecisionCase("hertz", method, 32).compute().measures["pressure"]
        for method in (Method.EDGES, Method.SURFACE)
    }
    assert errors[Method.EDGES] < 2e-4 < 1e-2 < errors[Method.SURFACE]
