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
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.frf.stack import HalfSpace, Stack
from semi_analytical.stress import EdgeNotSeen, near_edge, subsurface
from semi_analytical.stress.edge_rays import stress_by_root
from semi_analytical.stress.point_force import stress_by_force
from semi_analytical.stress.rectangle import half_space_response
from verification.closed_forms.huber_stress import (
    huber_stress,
    stress_by_hertz_shear,
)

Field = NDArray[np.float64]

NU = 0.3
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


def huber(x: Field, y: Field, depth: float) -> Field:
    """Under Hertz's unit pressure, in the axes of the scene (6, …)."""
    r = np.hypot(x, y)
    of = huber_stress(r, depth, RADIUS, 1.0, NU)
    c, s = x / r, y / r
    return np.stack(
        [
            of.radial * c * c + of.hoop * s * s,
            of.radial * s * s + of.hoop * c * c,
            of.axial,
            of.shear * s,
            of.shear * c,
            (of.radial - of.hoop) * c * s,
        ]
    )


@pytest.mark.parametrize("depth", [0.0, 0.3])
def test_a_point_force_is_a_small_rectangle(depth: float) -> None:
    half, force = 1e-3, np.array([0.3, -0.8, 1.7])
    corners = (np.array([0.7 - half, 0.7 + half]), np.array([-0.4 - half, -0.4 + half]))
    response = half_space_response(*corners, depth, HalfSpace(1.0, NU))
    found = stress_by_force(np.array(0.7), np.array(-0.4), depth, NU, force)
    expected = response[3:, :, 0, 0] @ force / (2 * half) ** 2
    np.testing.assert_allclose(found, expected, atol=1e-6)


@pytest.mark.parametrize("direction", [0.0, 0.6, 2.5])
def test_rays_over_the_whole_circle_give_the_stress_of_hertz(direction: float) -> None:
    """Inside, on the edge and outside: phi = 1 - r² is the whole pressure."""
    r = np.array([0.3, 0.9, 0.999, 1.0, 1.001, 1.1, 1.5])
    x, y = r * np.cos(direction), r * np.sin(direction)
    bend = np.full(len(r), -2.0)
    phi = Quadratic(x, y, (1 - r) * (1 + r), -2 * x, -2 * y, bend, 0 * r, bend)
    stress = stress_by_root(phi, np.full((4, len(r)), 9.0), np.zeros((2, len(r))), NU)
    np.testing.assert_allclose(stress, huber(RADIUS * x, RADIUS * y, 0.0), atol=1e-8)
    if direction == 0:
        pushed = stress_by_root(
            phi, np.full((4, len(r)), 9.0), np.array([1.0, 0.0])[:, None] + 0 * x, NU
        )
        expected = stress_by_hertz_shear(r, 1.0, 1.0, NU)
        np.testing.assert_allclose((pushed - stress)[0], expected, atol=1e-8)


@pytest.mark.parametrize("depth", [0.0, 0.5, 1.0, 2.0])
@pytest.mark.parametrize("spacing", [(1.0, 1.0), (1.0, 0.8)])
def test_stress_near_the_edge_is_that_of_hertz(depth: float, spacing: tuple[float, float]) -> None:
    """Every component within three cells of the edge, in the peak pressure."""
    grid, pressure = pressed_on(spacing)
    field = subsurface(STACK, grid, pressure, None, (depth,))
    x, y = places(grid)
    near = np.abs(np.hypot(x, y) - RADIUS) < 3 * min(spacing)
    error = [
        np.max(np.abs(one.stress[0] - huber(x, y, depth))[:, near])
        for one in (field, near_edge(STACK, grid, pressure, None).corrected(field))
    ]
    assert error[1] < 1e-3
    assert error[0] > 8 * error[1]


def test_an_edge_of_no_root_is_not_seen() -> None:
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


def test_a_stress_that_is_largest_far_behind_the_contact_is_found() -> None:
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
