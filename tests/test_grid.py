"""The surface grid."""

import numpy as np
import pytest

from semi_analytical import SurfaceGrid


def test_centres_are_symmetric_and_fill_the_window():
    grid = SurfaceGrid((7, 4), (1.4, 2.0))
    np.testing.assert_array_equal(grid.x, -grid.x[::-1])
    assert grid.x[-1] + grid.spacing[0] / 2 == pytest.approx(0.7)
    assert grid.y[-1] + grid.spacing[1] / 2 == pytest.approx(1.0)


def test_coarsening_undoes_refining():
    grid = SurfaceGrid((6, 10), (1.0, 3.0))
    assert grid.refined().coarsened() == grid


@pytest.mark.parametrize(
    ("cells", "window"),
    [((1, 8), (1.0, 1.0)), ((8, 8), (0.0, 1.0)), ((8, 8), (1.0, np.nan)), ((8, 8), (1.0, np.inf))],
)
def test_impossible_grid_is_refused(cells, window):
    with pytest.raises(ValueError, match="give"):
        SurfaceGrid(cells, window)


def test_odd_counts_cannot_be_halved():
    with pytest.raises(ValueError, match="even"):
        SurfaceGrid((7, 8), (1.0, 1.0)).coarsened()
