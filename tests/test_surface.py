"""Test of the surface of a result: cells and rings integrate axisymmetric fields alike."""

from types import SimpleNamespace

import numpy as np

from contact_results.surface import Cells, Rings, surface_on
from contact_scene.array_types import Field

REACH = 1.5  # of the places


def hump(r: Field) -> Field:
    """Smooth, of integral π/3 over the plane, and zero from r = 1 on."""
    return np.maximum(1.0 - r**2, 0.0) ** 2


def on_cells(surface):
    """Shear outward and, three times the pressure, along x, as a solver on cells states it."""
    x, y = surface.positions
    pressure = hump(np.hypot(x, y))
    return SimpleNamespace(pressure=pressure, shear=pressure * np.stack([3 + x, y]))


def on_rings(surface):
    """The same as a solver on rings states it; without angles no shear outward."""
    r = surface.radii
    outward = None if surface.angles is None else r * hump(r)
    shear = {
        "shear_radial": outward,
        "shear_circumferential": None,
        "shear_along_load": 3 * hump(r),
    }
    return SimpleNamespace(pressure=hump(r), **shear)


def integrals(surface, increment):
    """∫p dA, and ∫q_x dA."""
    pressure, shear = surface.scalar(increment, "pressure"), surface.vector(increment, "shear")
    return float(np.sum(surface.weights * pressure)), float(np.sum(surface.weights * shear[0]))


def test_weights_integrate_over_the_surface():
    exact = np.array([np.pi / 3, np.pi])
    for fineness in (40, 80):
        side = 2 * REACH / fineness
        centres = (np.arange(fineness) - (fineness - 1) / 2) * side
        cells = Cells(centres, centres, side**2)
        radii, around = np.linspace(0.0, REACH, fineness), np.linspace(0.0, np.pi, 9)
        rings = [
            Rings(r, angles, (1.0, 0.0), polar=False)
            for r, angles in ((radii, around), (radii[1:], around), (radii, None))
        ]
        found = [integrals(cells, on_cells(cells)), *(integrals(x, on_rings(x)) for x in rings)]
        assert np.max(np.abs(np.array(found) - exact) / exact) <= 4 / fineness**2


def test_cells_at_stored_coordinates_have_their_area():
    """A line contact has one row of cells, whose weight is their width."""
    for rows, area in ((1, 0.5), (8, 0.125)):
        made = surface_on({"x": 0.5 * np.arange(12), "y": 0.25 * np.arange(rows)}, (1.0, 0.0))
        np.testing.assert_allclose(made.weights, area)
