"""Tests of the surface of a result: axisymmetric fields are equal on cells and on rings."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from contact_results.surface import Cells, Rings, Surface, surface_on
from contact_scene.array_types import Field

REACH = 1.5  # of the places
ROUND_OFF = 1e-15
ALONG_X = (1.0, 0.0)
OBLIQUE = (0.6, 0.8)
PARTS = ("radial", "circumferential", "along_load")


def hump(r: Field) -> Field:
    """Smooth, of integral π/3 over the plane, and zero from r = 1 on."""
    return np.maximum(1.0 - r**2, 0.0) ** 2


def sizes(r: Field) -> dict[str, Field]:
    """What a vector has outward, around the axis and along the load."""
    return dict(zip(PARTS, (r * hump(r), -2 * r * hump(r), 3 * hump(r)), strict=True))


def units(place: Field, direction: tuple[float, float]) -> dict[str, Field]:
    """Unit vectors (2, …) there."""
    outward = place / np.maximum(np.hypot(*place), 1e-300)
    load = np.broadcast_to(np.reshape(direction, (2, 1, 1)[: place.ndim]), place.shape)
    return dict(zip(PARTS, (outward, np.stack([-outward[1], outward[0]]), load), strict=True))


def cells(count: int) -> Cells:
    side = 2 * REACH / count
    centres = (np.arange(count) - (count - 1) / 2) * side
    return Cells(centres, centres, side**2)


def rings(radii: Field, points: int | None, direction: tuple[float, float] = ALONG_X) -> Rings:
    angles = None if points is None else np.linspace(0.0, np.pi, points)
    return Rings(radii, angles, direction, polar=False)


def on_cells(surface: Cells, *parts: str) -> Any:
    """The field as a solver on cells states it."""
    place = surface.positions
    r = np.hypot(*place)
    shear = [sizes(r)[part] * units(place, ALONG_X)[part] for part in parts]
    return SimpleNamespace(pressure=hump(r), shear=np.sum(shear, axis=0) if parts else None)


def on_rings(surface: Rings, *parts: str, at_angles: bool = False) -> Any:
    """The field as a solver on rings states it: one value per ring, or one at every angle."""
    r = surface.radii
    if at_angles and surface.angles is not None:
        r = np.repeat(r[:, None], len(surface.angles), axis=1)
    shear = {f"shear_{part}": sizes(r)[part] if part in parts else None for part in PARTS}
    return SimpleNamespace(pressure=hump(r), **shear)


@pytest.mark.parametrize("direction", [ALONG_X, OBLIQUE, (0.0, -1.0)])
@pytest.mark.parametrize("points", [None, 9])
def test_vectors_are_in_x_and_y_wherever_the_load_points(
    points: int | None, direction: tuple[float, float]
) -> None:
    ring = rings(np.linspace(0.0, REACH, 16), points, direction)
    place = ring.positions
    for part in PARTS:
        found = ring.vector(on_rings(ring, part), "shear")
        expected = sizes(np.hypot(*place))[part] * units(place, direction)[part]
        np.testing.assert_allclose(found, expected, atol=ROUND_OFF)
        if part == "along_load":
            ahead, across = ring.vector_along(found)
            np.testing.assert_allclose(
                ahead, sizes(np.abs(ring.profile_line.places))[part], atol=1e-14
            )
            np.testing.assert_allclose(across, 0.0, atol=ROUND_OFF)


def integrals(surface: Surface, increment: Any) -> tuple[float, float]:
    """∫p dA, and ∫q_x dA."""
    pressure, shear = surface.scalar(increment, "pressure"), surface.vector(increment, "shear")
    assert pressure is not None
    assert shear is not None
    return float(np.sum(surface.weights * pressure)), float(np.sum(surface.weights * shear[0]))


def test_weights_integrate_over_the_surface() -> None:
    exact = np.array([np.pi / 3, np.pi])
    parts = ("radial", "along_load")
    for fineness in (40, 80):
        grid = cells(fineness)
        radii = np.linspace(0.0, REACH, fineness)
        allowed = 4 / fineness**2 * exact
        both = [integrals(grid, on_cells(grid, *parts))]
        for surface in (rings(radii, 9), rings(radii[1:], 9)):
            both.append(integrals(surface, on_rings(surface, *parts)))
        both.append(integrals(rings(radii, None), on_rings(rings(radii, None), "along_load")))
        assert np.max(np.abs(np.array(both) - exact) / allowed) <= 1


@pytest.mark.parametrize(("rows", "area"), [(1, 0.5), (8, 0.125)])
def test_cells_at_stored_coordinates_have_their_area(rows: int, area: float) -> None:
    """A line contact has one row of cells, whose weight is their width."""
    made = surface_on({"x": 0.5 * np.arange(12), "y": 0.25 * np.arange(rows)}, ALONG_X)
    np.testing.assert_allclose(made.weights, area)
