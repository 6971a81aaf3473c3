"""Tests of contact of layered bodies: default window, invariance, and refusals."""

import numpy as np
import pytest
from contact_scenes import INDENTERS, PRESS, A, push, scene, steel
from coupled_scenes import coated
from coupled_scenes import scene as coupled_scene

from contact_scene import (
    HeightMap,
    SurfaceDiscretisation,
)
from semi_analytical import (
    discretise,
    solve_discretised,
)

COARSE = SurfaceDiscretisation(cells=(48, 48), tolerance=1e-6)
LOADS = [1e-12, 1e-3, 1.0, 1e9]


def extents(increment, grid):
    """Sides of the contact, from the outermost cells that carry pressure."""
    x, y = grid.coordinates()
    inside = increment.in_contact
    return (
        2 * np.max(np.abs(x[inside])) + grid.spacing[0],
        2 * np.max(np.abs(y[inside])) + grid.spacing[1],
    )


def assert_window_fits(asked):
    result = solve_discretised(asked, COARSE)
    size = extents(result.steps[-1], result.grid)
    for side, length in zip(result.grid.window, size, strict=True):
        assert length < side < 1.6 * length


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("name", sorted(INDENTERS.keys() - {"sphere"}))
def test_window_fits_any_shape_under_any_load(name, load):
    assert_window_fits(scene({"normal_force": load}, indenter=INDENTERS[name], friction=None))


@pytest.mark.parametrize("ratio", [0.1, 10.0])
def test_window_fits_on_a_film(ratio):
    assert_window_fits(coupled_scene(PRESS, body=coated(ratio, 0.3), friction=None))


def test_window_holds_the_largest_contact_of_the_history():
    small, large = {"normal_force": 1.0}, {"normal_force": 1e3}
    windows = [
        discretise(scene(*loading, friction=None), COARSE).window
        for loading in [(large,), (small, large, small), (large, {"approach": 1e-9})]
    ]
    assert windows[0] == windows[1] == windows[2]


@pytest.mark.parametrize("shape", [(40, 24), (300, 24), (512, 300)])
@pytest.mark.parametrize("window", [2.2 * A, 3 * A])
def test_chosen_cells_divide_the_spacing_of_a_map_by_the_same_number(shape, window):
    values = np.add.outer(np.arange(shape[0]), np.arange(shape[1])) * 1e-9
    rough = HeightMap(file=values, spacing=tuple(4 * A / np.array(shape)), material=steel())
    asked = SurfaceDiscretisation(window=(window, window))
    friction = {"map": np.full(shape, values), "spacing": tuple(4 * A / np.array(shape))}
    for described in (
        scene(PRESS, push(0.2), friction=friction),
        scene(PRESS, friction=None, indenter=rough),
    ):
        cells = np.array(discretise(described, asked).cells)
        points = np.ceil(window / (4 * A / np.array(shape)) - 1e-9)
        factor = cells[0] // points[0]
        assert list(cells) == list(factor * points)
        assert min(cells) >= 128 > min((factor - 1) * points)
