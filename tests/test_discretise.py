"""A window that is left open holds the contact, and hardly more."""

import numpy as np
import pytest
from contact_scenes import INDENTERS, MU, PRESS, A, bump, push, scene, steel

from contact_scene import (
    RIGID,
    Cone,
    Ellipsoid,
    FlatPunch,
    HeightMap,
    Paraboloid,
    Sphere,
    SurfaceDiscretisation,
)
from semi_analytical import ContactAtWindowEdge, SurfaceGrid, discretise, solve_discretised

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


def test_ball_that_would_sink_in_beyond_its_equator_is_reported():
    with pytest.raises(ContactAtWindowEdge):
        solve_discretised(scene({"normal_force": 1e12}, indenter=INDENTERS["sphere"]), COARSE)


@pytest.mark.parametrize("radius", [1e-9, 1e-6, 1.0, 1e3])
def test_window_fits_from_nanometres_to_kilometres(radius):
    for shape in (
        Sphere(radius=radius, material=steel()),
        Paraboloid(radius=radius, material=steel()),
        FlatPunch(radius=radius, material=RIGID),
        Ellipsoid(radii=(radius, 3 * radius), material=RIGID),
    ):
        assert_window_fits(scene({"approach": 1e-3 * radius}, indenter=shape, friction=None))


@pytest.mark.parametrize("ratio", [1e-4, 1e-2, 1e2, 1e4])
@pytest.mark.parametrize(
    "load", [{"normal_force": 1e3}, {"approach": 1e-6}], ids=["force", "shift"]
)
def test_window_follows_a_slender_contact(ratio, load):
    shape = Ellipsoid(radii=(1e-3, ratio * 1e-3), material=RIGID)
    assert_window_fits(scene(load, indenter=shape, friction=None))


@pytest.mark.parametrize("slope", [1e-6, 1e-3, 1.0])
def test_window_fits_blunt_and_sharp_cones(slope):
    cone = Cone(slope_angle=slope, material=RIGID)
    assert_window_fits(scene(PRESS, indenter=cone, friction=None))
    assert_window_fits(scene({"approach": 1e-6}, indenter=cone, friction=None))


def test_window_holds_the_largest_contact_of_the_history():
    small, large = {"normal_force": 1.0}, {"normal_force": 1e3}
    windows = [
        discretise(scene(*loading, friction=None), COARSE).window
        for loading in [(large,), (small, large, small), (large, {"approach": 1e-9})]
    ]
    assert windows[0] == windows[1] == windows[2]


def test_window_of_a_height_map_is_the_map():
    heights = HeightMap(file=bump(24, 3 * A / 24), spacing=3 * A / 24, material=steel())
    grid = discretise(scene(PRESS, indenter=heights), COARSE)
    np.testing.assert_allclose(grid.window, (3 * A, 3 * A))


def test_contact_at_the_rim_of_a_height_map_is_reported():
    heights = HeightMap(file=bump(24, A / 24), spacing=A / 24, material=steel())
    with pytest.raises(ContactAtWindowEdge, match="height map"):
        solve_discretised(scene(PRESS, indenter=heights), COARSE)


def test_what_is_asked_for_is_not_changed():
    asked = SurfaceDiscretisation(cells=(20, 30), window=(1e-3, 2e-3))
    assert discretise(scene(PRESS), asked) == SurfaceGrid((20, 30), (1e-3, 2e-3))


def test_friction_map_gives_the_cells():
    grid = discretise(
        scene(PRESS, push(0.2), friction={"map": np.full((40, 24), MU)}), SurfaceDiscretisation()
    )
    assert grid.cells == (40, 24)


def test_explicit_window_that_cuts_the_contact_is_refused():
    asked = SurfaceDiscretisation(cells=(32, 32), window=(1.5 * A, 1.5 * A))
    with pytest.raises(ContactAtWindowEdge, match="larger window"):
        solve_discretised(scene(PRESS), asked)


def test_window_is_fitted_to_forces_and_approaches_alike():
    result = solve_discretised(
        scene({"approach": 1e-8}, {"normal_force": 1e3}, friction=None), COARSE
    )
    assert result.grid.window[0] > 2 * A
    assert np.isclose(result.steps[1].contact_radius, A, rtol=0.02)
