"""Tests of the stress near the contact edge, where the edge lies inside the cells."""

import numpy as np
import pytest
from cell_means import ellipse_means
from numpy.typing import NDArray

from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.on_cells import OnCells
from contact_results.stress.stress_maxima import extremes
from contact_scene import Body, IsotropicMaterial, Layer
from semi_analytical import SurfaceGrid
from semi_analytical.frf.stack import Stack
from semi_analytical.stress import EdgeNotSeen, near_edge, subsurface
from verification.closed_forms.huber_stress import hamilton_stress

Field = NDArray[np.float64]

NU = 0.3
SLIDING = 0.2  # shear over pressure
STACK = Stack((), (1.0, NU))
# The contact within its grid: radius in cells, and its centre off every symmetry.
CELLS = 48
RADIUS = 15.0
CENTRE = (23.61, 23.28)


def pressed_on(spacing: tuple[float, float] = (1.0, 1.0)) -> tuple[SurfaceGrid, Field]:
    """Cell means of Hertz's unit pressure over a circle of RADIUS [length]."""
    means = ellipse_means(CELLS, (RADIUS / spacing[0], RADIUS / spacing[1]), CENTRE)
    return SurfaceGrid((CELLS, CELLS), (CELLS * spacing[0], CELLS * spacing[1])), means


def places(grid: SurfaceGrid) -> tuple[Field, Field]:
    """Of the cell centres from the centre of the contact."""
    x, y = ((np.arange(CELLS) - at) * side for at, side in zip(CENTRE, grid.spacing, strict=True))
    return np.meshgrid(x, y, indexing="ij")


@pytest.mark.parametrize("depth", [0.0, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("spacing", [(1.0, 1.0), (1.0, 0.8)])
def test_stress_near_the_edge_is_that_of_sliding(depth, spacing):
    """Every component within three cells of the edge, in the peak pressure."""
    grid, pressure = pressed_on(spacing)
    shear = np.stack([SLIDING * pressure, 0 * pressure])
    field = subsurface(STACK, grid, pressure, shear, (depth,))
    x, y = places(grid)
    near = np.abs(np.hypot(x, y) - RADIUS) < 3 * min(spacing)
    exact = hamilton_stress(x, y, max(depth, 1e-6), RADIUS, 1.0, SLIDING, NU)
    error = [
        np.max(np.abs(one.stress[0] - exact)[:, near])
        for one in (field, near_edge(STACK, grid, pressure, shear).corrected(field))
    ]
    assert error[1] < 1e-3
    assert error[0] > 8 * error[1]


def test_an_edge_of_no_root_is_not_seen():
    """Pressure of a flat punch and of roughness; shear of torsion without slip, r over the root."""
    grid, pressure = pressed_on()
    x, y = places(grid)
    inverse = np.where(pressure > 0, 1 / np.where(pressure > 0, pressure, 1.0), 0.0)
    punch = np.where(pressure > 0.3, inverse, 0.0)
    rough = np.maximum(np.cos(x) * np.cos(y) + 0.2, 0.0) * (pressure > 0)
    stuck = 0.01 * np.hypot(x, y) * inverse
    for unlike, shear in ((punch, None), (rough, None), (pressure, np.stack([stuck, 0 * stuck]))):
        with pytest.raises(EdgeNotSeen, match=None if shear is None else "stick"):
            near_edge(STACK, grid, unlike, shear)


def test_a_stress_that_is_largest_far_behind_the_contact_is_found():
    """At the base of a film, about two contact radii behind the middle."""
    radius = RADIUS / 2
    pressure = ellipse_means(24, (radius, radius), (11.8, 11.6))
    grid = SurfaceGrid((24, 24), (24.0, 24.0))
    soft, hard = (IsotropicMaterial(young_modulus=E, poisson_ratio=NU) for E in (1.0, 2.0))
    body = Body(material=soft, layers=(Layer(thickness=0.25 * radius, material=hard),))
    tractions = {"pressure": pressure, "shear": np.stack([0.2 * pressure, 0 * pressure])}
    state = LoadedBodies("", body, body, 1, {"x": grid.x, "y": grid.y}, tractions, None)
    field = OnCells(state).stress()
    found = {(e.region, e.measure): e for e in extremes(field)}
    for key in (("interface 1 above", "interface_tensile_stress"), ("base", "max_principal")):
        assert not found[key].at_window_edge
        assert -2.3 < found[key].x / radius < -1.65
    assert field.section.x.min() < -2.2 * radius
