"""Tests of the stress below the cells of a contact: planes, symmetry and depths."""

import numpy as np
import pytest

from contact_scene import RIGID, Body, IsotropicMaterial, Layer
from semi_analytical.frf.depth import Level
from semi_analytical.frf.stack import Stack
from semi_analytical.grid import SurfaceGrid
from semi_analytical.stress import (
    SubsurfaceField,
    default_depths,
    fields_by_level,
    interfaces,
    subsurface,
)
from semi_analytical.stress.convolution import mirror_planes

NU = 0.3
HALF_SPACE = Stack((), (1.0, NU))
COATED = Stack([(3.0, 0.2, 0.3), (0.5, 0.5, 0.4)], (1.0, 0.3))
XX, YY, ZZ, YZ, XZ, XY = range(6)
GRID = SurfaceGrid((8, 8), (1.0, 1.0))
LOAD = np.ones((8, 8))


@pytest.mark.parametrize("stack", [HALF_SPACE, COATED], ids=["homogeneous", "coated"])
def test_every_plane_carries_the_load(stack):
    """Sum of the tractions on a plane; beyond a window of half side L about (z/L)^3 is missing."""
    grid = SurfaceGrid((100, 100), (40.0, 40.0))
    pressure = np.where(np.hypot(*grid.coordinates()) < 1.5, 1.0, 0.0)
    field = subsurface(stack, grid, pressure, None, [0.2, 0.6, 1.2])
    carried = field.stress.sum(axis=(2, 3)) / pressure.sum()
    np.testing.assert_allclose(carried[:, ZZ], -1, atol=1e-3)
    np.testing.assert_allclose(carried[:, [XZ, YZ, XY]], 0, atol=1e-12)


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


@pytest.mark.parametrize("cells", [(12, 10), (11, 10)])
@pytest.mark.parametrize("axes", [(0,), (1,), (0, 1)], ids=["x", "y", "both"])
def test_mirrored_tractions_have_the_sum_of_the_fields_of_their_parts(axes, cells, rng):
    """The parts are not symmetric; the sum uses its mirror planes."""
    grid = SurfaceGrid(cells, (1.2, 1.0))
    tractions = rng.normal(size=(3, *cells))
    for axis in axes:
        image = np.flip(tractions, 1 + axis).copy()
        image[axis] *= -1
        tractions = tractions + image
    assert np.flatnonzero(mirror_planes(tractions)).tolist() == list(axes)
    part = rng.random(cells) * tractions
    whole, one, other = (
        subsurface(COATED, grid, p, np.stack([q_x, q_y]), [0.05, 0.5])
        for q_x, q_y, p in (tractions, part, tractions - part)
    )
    np.testing.assert_allclose(whole.stress, one.stress + other.stress, atol=1e-12)
    np.testing.assert_allclose(
        whole.displacement, one.displacement + other.displacement, atol=1e-12
    )


def test_a_number_on_an_interface_is_its_upper_side():
    field = subsurface(COATED, GRID, LOAD, None, [0.1, 0.3 * (1 + 1e-15), 0.5, 0.7, 0.8])
    assert [level.layer for level in field.levels] == [0, 0, 1, 1, 2]


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


@pytest.mark.parametrize(
    ("stack", "depth", "complaint"),
    [
        (COATED, -0.1, "expected a finite length >= 0"),
        (COATED, float("nan"), "expected a finite length >= 0"),
        (Stack([(1.0, 0.3, 0.5)]), 0.6, "rigid base"),
        (COATED, Level(0.1, 2), "outside of its layer"),
        (COATED, Level(0.1, 3), "does not exist"),
        (Stack([(1.0, 0.3, 0.5)]), Level(0.5, 1), "does not exist"),
        (Stack(), 0.1, "the body is rigid"),
    ],
)
def test_depths_outside_of_the_body_are_refused(stack, depth, complaint):
    with pytest.raises(ValueError, match=complaint):
        subsurface(stack, GRID, LOAD, None, [depth])
