"""Fields below a contact: Hertz, Hamilton, coated quadrature, interfaces, equilibrium, errors."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from polar_synthesis import fields_at, hertz_transform

from contact_scene import RIGID, Body, IsotropicMaterial, Layer
from contact_scene.solver_errors import ResourceRefused
from semi_analytical.frf.stack import Stack
from semi_analytical.grid import SurfaceGrid
from semi_analytical.stress import (
    Level,
    default_depths,
    interfaces,
    subsurface,
    subsurface_section,
)
from semi_analytical.stress import field as stress_field
from semi_analytical.stress.levels import line_weights

NU, MU = 0.3, 0.25
HALF_SPACE = Stack((), (1.0, NU))
COATED = Stack([(3.0, 0.2, 0.3), (0.5, 0.5, 0.4)], (1.0, 0.3))
XX, YY, ZZ, YZ, XZ, XY = range(6)
GRID = SurfaceGrid((8, 8), (1.0, 1.0))
LOAD = np.ones((8, 8))


def hertz(cells, window=3.0):
    """Grid and Hertz pressure p0 = a = 1 at the cell centres."""
    grid = SurfaceGrid((cells, cells), (window, window))
    x, y = grid.coordinates()
    return grid, np.sqrt(np.maximum(1 - x**2 - y**2, 0.0))


def sheared(pressure):
    return np.stack([MU * pressure, 0 * pressure])


def sliding(m, n):
    pressure = hertz_transform(1.0)(m, n)
    return MU * pressure, 0.0, pressure


@pytest.mark.parametrize("stack", [HALF_SPACE, COATED], ids=["homogeneous", "coated"])
@pytest.mark.parametrize("depth", [0.25, 0.5, 1.2])
def test_sliding_contact_agrees_with_quadrature_of_the_frf(stack, depth):
    """Hamilton's sliding sphere, and the same on layers, off the axis in all components."""
    grid, pressure = hertz(256)
    layer = int(np.searchsorted(np.cumsum([f.thickness for f in stack.layers]), depth))
    level = Level(depth, layer)
    field = subsurface(stack, grid, pressure, sheared(pressure), [level])
    i, j = 168, 154
    expected = fields_at(stack, level, (grid.x[i], grid.y[j]), sliding, reach=2.0)
    # Of p0 = G = a = 1; the cells, second order, make all of it.
    np.testing.assert_allclose(field.displacement[0, :, i, j], expected[:3], atol=1e-4)
    np.testing.assert_allclose(field.stress[0, :, i, j], expected[3:], atol=1e-4)


@pytest.mark.parametrize("stack", [HALF_SPACE, COATED, Stack([(1.0, 0.5, 0.2)])])
def test_surface_carries_the_given_tractions(stack, rng):
    grid = SurfaceGrid((20, 14), (2.0, 1.6))
    pressure, shear = rng.random(grid.cells), rng.normal(size=(2, *grid.cells))
    stress = subsurface(stack, grid, pressure, shear, [0.0]).stress[0]
    np.testing.assert_allclose(stress[ZZ], -pressure, atol=1e-13)
    np.testing.assert_allclose(stress[XZ], -shear[0], atol=1e-13)
    np.testing.assert_allclose(stress[YZ], -shear[1], atol=1e-13)


@pytest.mark.parametrize(
    "stack",
    [COATED, Stack([(100.0, 0.2, 0.01)], (1.0, 0.4)), Stack([(0.01, 0.4, 0.5)], (1.0, 0.3))],
    ids=["two layers", "thin hard", "soft"],
)
def test_interfaces_carry_displacement_and_traction_and_strain(stack, rng):
    grid = SurfaceGrid((48, 40), (3.0, 2.6))
    pressure, shear = rng.random(grid.cells), rng.normal(size=(2, *grid.cells))
    for sides in interfaces(stack):
        field = subsurface(stack, grid, pressure, shear, sides)
        for k in (ZZ, XZ, YZ):
            np.testing.assert_allclose(field.stress[0, k], field.stress[1, k], atol=1e-11)
        scale = np.abs(field.displacement).max()
        np.testing.assert_allclose(*field.displacement, atol=1e-11 * scale)
        jump = field.stress[1] - field.stress[0]
        expected = in_plane_jump(stack, sides, field.stress[0])
        scale = np.abs(field.stress).max()
        np.testing.assert_allclose(jump[[XX, YY, XY]], expected, atol=1e-10 * scale)


def in_plane_jump(stack, sides, above):
    """What equal in-plane strains and equal normal stress make of the stress above."""
    materials = [*((f.shear_modulus, f.poisson_ratio) for f in stack.layers), stack.base]
    (G1, nu1), (G2, nu2) = materials[sides[0].layer], materials[sides[1].layer]
    E1 = 2 * G1 * (1 + nu1)
    zz = above[ZZ]
    e_x = (above[XX] - nu1 * (above[YY] + zz)) / E1
    e_y = (above[YY] - nu1 * (above[XX] + zz)) / E1
    plate, squeeze = 2 * G2 / (1 - nu2), nu2 / (1 - nu2) * zz
    below = plate * (e_x + nu2 * e_y) + squeeze, plate * (e_y + nu2 * e_x) + squeeze
    return np.stack([below[0] - above[XX], below[1] - above[YY], above[XY] * (G2 / G1 - 1)])


@pytest.mark.parametrize("stack", [HALF_SPACE, COATED], ids=["homogeneous", "coated"])
def test_every_plane_carries_the_load(stack):
    """Sum of the tractions on a plane; beyond a window of half side L about (z/L)^3 is missing."""
    grid = SurfaceGrid((100, 100), (40.0, 40.0))
    pressure = np.where(np.hypot(*grid.coordinates()) < 1.5, 1.0, 0.0)
    field = subsurface(stack, grid, pressure, None, [0.2, 0.6, 1.2])
    carried = field.stress.sum(axis=(2, 3)) / pressure.sum()
    np.testing.assert_allclose(carried[:, ZZ], -1, atol=1e-3)
    np.testing.assert_allclose(carried[:, [XZ, YZ, XY]], 0, atol=1e-12)


def test_section_is_the_plane_at_y(rng):
    for cells in ((24, 20), (24, 21)):
        grid = SurfaceGrid(cells, (2.4, 2.0))
        pressure, shear = rng.random(cells), rng.normal(size=(2, *cells))
        levels = default_depths(COATED, 0.5)[::5]
        whole = subsurface(COATED, grid, pressure, shear, levels)
        for y in (0.0, 0.43, grid.y[0]):
            section = subsurface_section(COATED, grid, pressure, shear, levels, y=y)
            np.testing.assert_allclose(section.stress, whole.along_x(y).stress, atol=1e-12)
            np.testing.assert_allclose(
                section.displacement, whole.along_x(y).displacement, atol=1e-12
            )


@given(st.floats(-1.75, 1.75), st.integers(4, 9))
def test_interpolation_is_exact_for_cubics(at, count):
    samples = np.linspace(-1.75, 1.75, count)

    def cubic(x):
        return 1 - 2 * x + 0.3 * x**2 - x**3

    # A place next to a sample is taken for that sample.
    off = np.min(np.abs(samples - at))
    assume(off == 0 or off > 1e-8)
    assert line_weights(samples, at) @ cubic(samples) == pytest.approx(cubic(at), abs=1e-12)
    with pytest.raises(ValueError, match="outside of the samples"):
        line_weights(samples, 1.8)


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
        (COATED, Level(0.1, 2), "not in that layer"),
        (COATED, Level(0.1, 3), "not there"),
        (Stack([(1.0, 0.3, 0.5)]), Level(0.5, 1), "not there"),
        (Stack(), 0.1, "the body is rigid"),
    ],
)
def test_depths_outside_of_the_body_are_refused(stack, depth, complaint):
    with pytest.raises(ValueError, match=complaint):
        subsurface(stack, GRID, LOAD, None, [depth])


def test_tractions_of_another_grid_are_refused():
    with pytest.raises(ValueError, match=r"pressure has shape \(7, 8\), expected \(8, 8\)"):
        subsurface(COATED, GRID, np.ones((7, 8)), None, [0.1])
    with pytest.raises(ValueError, match=r"shear has shape \(8, 8\)"):
        subsurface(COATED, GRID, LOAD, LOAD, [0.1])


def test_fields_beyond_the_memory_are_refused(monkeypatch):
    monkeypatch.setattr(stress_field, "available_bytes", lambda: 1 << 20)
    with pytest.raises(ResourceRefused, match="fields at 1 depths on 8 x 8 cells"):
        subsurface(COATED, GRID, LOAD, None, [0.1])
