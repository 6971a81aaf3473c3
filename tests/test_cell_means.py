"""Tests of the means of known fields over cells."""

import numpy as np
import pytest

from semi_analytical import SurfaceGrid
from verification.norms import cell_means, round_means
from verification.problems.indentation import BALL

EXACT = BALL.ends[-1]


@pytest.mark.parametrize("cells", [(16, 16), (33, 20), (128, 128)])
def test_means_over_cells_carry_the_load(cells: tuple[int, int]) -> None:
    side = 2.6 * BALL.radius
    grid = SurfaceGrid(cells, (side, 1.1 * side))
    means = round_means(EXACT.pressure, *grid.coordinates(), grid.spacing)
    assert grid.cell_area * np.sum(means) == pytest.approx(EXACT.load, rel=5e-6)


@pytest.mark.parametrize("inside", [0.01, 0.05, 0.3, 1.99])
@pytest.mark.parametrize("towards", [(1, 1), (-1, -1), (1, -1)])
def test_an_edge_that_cuts_off_a_corner_is_seen(towards: tuple[int, int], inside: float) -> None:
    """Of a traction that rises as the root of the distance from a straight edge."""
    (m, n), side = towards, np.array([2.0])
    (mean,) = cell_means(
        lambda x, y: np.sqrt(np.maximum(m * x + n * y - 2.0 + inside, 0)),
        np.zeros(1),
        np.zeros(1),
        (side, side),
    )
    assert mean == pytest.approx(inside**2.5 / 15, abs=2e-4 * inside**0.5)
    assert mean > 0
