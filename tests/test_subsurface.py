"""Tests of the stress below cells: fields of one cell, rows of a plane and depths."""

import numpy as np
import pytest

from contact_scene import RIGID, Body, IsotropicMaterial, Layer
from semi_analytical.frf.depth import Level
from semi_analytical.frf.stack import HalfSpace, Stack
from semi_analytical.grid import SurfaceGrid
from semi_analytical.influence.closed_form import HalfSpaceCoefficients
from semi_analytical.stress import (
    SubsurfaceField,
    default_depths,
    fields_by_level,
    interfaces,
    subsurface,
)
from semi_analytical.stress.field import depth_coefficients
from semi_analytical.stress.rectangle import half_space_response
from semi_analytical.stress.strips import RESPONSES, border_responses

COATED = Stack([(3.0, 0.2, 0.3), (0.5, 0.5, 0.4)], (1.0, 0.3))
GRID = SurfaceGrid((8, 8), (1.0, 1.0))
LOAD = np.ones((8, 8))


def test_some_rows_have_the_fields_of_the_plane(rng):
    for cells in ((24, 20), (24, 21)):
        grid = SurfaceGrid(cells, (2.4, 2.0))
        pressure, shear = rng.random(cells), rng.normal(size=(2, *cells))
        levels = default_depths(COATED, 0.5)[::5]
        whole = subsurface(COATED, grid, pressure, shear, levels)
        for rows in (np.arange(9, 11), np.array([0]), np.arange(12, 20)):
            some = SubsurfaceField.joined(
                fields_by_level(COATED, grid, pressure, shear, levels, rows)
            )
            np.testing.assert_allclose(some.stress, whole.stress[..., rows], atol=1e-12)
            np.testing.assert_allclose(some.displacement, whole.displacement[..., rows], atol=1e-12)


def test_a_section_has_the_values_of_its_plane_and_of_no_other(rng):
    whole = subsurface(COATED, GRID, rng.random(GRID.cells), None, [0.1, 0.5])
    section = whole.along_x(0.25)
    for of_section, of_whole in zip(section.below(0.3, 0.25), whole.below(0.3, 0.25), strict=True):
        np.testing.assert_array_equal(of_section, of_whole)
    with pytest.raises(ValueError, match="outside of the samples"):
        section.below(0.3, 0.3)


def test_a_number_on_an_interface_is_its_upper_side():
    field = subsurface(COATED, GRID, LOAD, None, [0.1, 0.3 * (1 + 1e-15), 0.5, 0.7, 0.8])
    assert [level.layer for level in field.levels] == [0, 0, 1, 1, 2]


@pytest.mark.parametrize("stack", [Stack([], (1.0, 0.3)), COATED], ids=["half-space", "coated"])
def test_stresses_below_strips_are_in_equilibrium(stack):
    """The forces along x, y and z balance. Constants of the responses cancel in differences."""
    x, step = np.array([-0.7, -0.2, 0.15, 0.4]), 1e-3

    def stresses(right, down):
        found = border_responses(stack, Level(0.1 + down * step, 0), x + right * step)
        return dict(zip(RESPONSES, np.diff(found), strict=True))

    right, left, down, up = (stresses(*to) for to in ((1, 0), (-1, 0), (0, 1), (0, -1)))
    for along, below, traction in (
        ("xx", "xz", "x"),
        ("xx", "xz", "z"),
        ("xz", "zz", "x"),
        ("xz", "zz", "z"),
        ("xy", "yz", "y"),
    ):
        first, second = f"{along} {traction}", f"{below} {traction}"
        change = right[first] - left[first]
        assert np.max(np.abs(change)) > step
        np.testing.assert_allclose(change, up[second] - down[second], atol=2e-3 * step)


STEEL = IsotropicMaterial(young_modulus=2.6, poisson_ratio=0.3)


def test_default_depths_reach_both_sides_of_every_interface():
    body = Body(material=STEEL, layers=[Layer(thickness=0.02, material=STEEL)])
    levels = default_depths(body, 1.0)
    assert levels[0] == Level(0.0, 0)
    assert {Level(0.02, 0), Level(0.02, 1)} <= set(levels)
    assert [level.depth for level in levels] == sorted(level.depth for level in levels)
    assert sum(level.layer == 0 for level in levels) >= 5
    rigid = Body(material=RIGID, layers=[Layer(thickness=0.5, material=STEEL)])
    assert max(level.depth for level in default_depths(rigid, 1.0)) == 0.5
    assert interfaces(rigid) == ((Level(0.5, 0),),)


DX = 1.0
DY = 0.6


def under_cell(x, y, z, nu, G=1.7):
    """Fields (9, 3) at a point by unit tractions on the cell DX by DY at the origin."""
    corners = np.array([x - DX / 2, x + DX / 2]), np.array([y - DY / 2, y + DY / 2])
    return half_space_response(*corners, z, HalfSpace(G, nu))[..., 0, 0]


def test_closed_form_carries_the_traction_at_the_surface():
    loaded, beside = under_cell(0.2, 0.1, 0.0, 0.3), under_cell(0.8, 0.1, 0.0, 0.3)
    # zz, yz, xz by (q_x, q_y, p)
    np.testing.assert_allclose(loaded[5:8], [[0, 0, -1], [0, -1, 0], [-1, 0, 0]], atol=1e-15)
    np.testing.assert_allclose(beside[5:8], 0, atol=1e-15)


@pytest.mark.parametrize("cell", [(0, 0), (1, 0), (0, 1), (2, 1)])
def test_closed_form_moves_the_surface_like_the_surface_coefficients(cell):
    """Two closed forms: of the displacement at any depth, and of the surface alone."""
    surface = HalfSpaceCoefficients((DX, DY), (3, 2), 1.7, 0.3)
    moved = under_cell(cell[0] * DX, cell[1] * DY, 0.0, 0.3)[:3]
    xx, yy, zz, xy, zx, zy = (surface[name][cell] for name in ("xx", "yy", "zz", "xy", "zx", "zy"))
    expected = [[xx, xy, -zx], [xy, yy, -zy], [zx, zy, zz]]
    np.testing.assert_allclose(moved, expected, rtol=1e-13, atol=1e-15)


def scales(coefficients):
    """Largest response of each field, to judge rounding by."""
    return np.abs(coefficients).max(axis=(1, 2, 3))[:, None, None, None]


@pytest.mark.parametrize("thickness", [20.0, 0.3, 1e-3])
def test_layer_of_the_substrates_material_is_not_there(thickness):
    """From layers twice as thick as the window is wide to a hundredth of a cell."""
    spacing, shape = (0.1, 0.08), (50, 50)
    layered = Stack([(1.7, 0.3, thickness)], (1.7, 0.3))
    depths = [0.0, 0.5 * thickness, thickness, thickness, 1.5 * thickness]
    levels = tuple(Level(z, k) for z, k in zip(depths, (0, 0, 0, 1, 1), strict=True))
    alone = tuple(Level(z, 0) for z in depths)
    pairs = zip(
        depth_coefficients(layered, levels, spacing, shape),
        depth_coefficients(Stack((), (1.7, 0.3)), alone, spacing, shape),
        strict=True,
    )
    assert len(levels) == 5
    for found, expected in pairs:
        # Rounding of the corners does not fall with the depth as the coefficients do: 1e-16 each,
        # where one cell at the surface has 1.
        assert np.all(np.abs(found - expected) <= 1e-14 + 1e-12 * scales(expected))
