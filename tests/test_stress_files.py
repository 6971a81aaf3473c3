"""Tests of the files of a stress: the same columns and axes for all solvers, and readable
meshes."""

import tracemalloc
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from stored_mesh import read_mesh

from contact_results.stress import on_cells
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.on_cells import OnCells
from contact_results.stress.on_section import OnSection
from contact_results.stress.points import StressField
from contact_results.stress.stress_maxima import extremes
from contact_results.stress_result import write_stress
from contact_scene import (
    Body,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    Layer,
    machine,
)
from contact_scene.solver_errors import ResourceRefused
from semi_analytical.stress import field as stress_field

RADII = np.linspace(0, 1.2, 25)
X = (np.arange(16) - 7.5) * 2.4 / 16
ALONG_Y = (0.0, 1.0)
SOFT = IsotropicMaterial(young_modulus=2.6, poisson_ratio=0.3)
FILM = Layer(thickness=0.5, material=IsotropicMaterial(young_modulus=5.2, poisson_ratio=0.3))
COATED = Body(material=SOFT, layers=(FILM,))
FRICTION = 0.5


def pressed_and_pushed(axes: dict[str, np.ndarray], pressure: np.ndarray) -> LoadedBodies:
    """Gross sliding along x under a Hertz pressure."""
    tractions = {"pressure": pressure}
    if "x" in axes:
        tractions["shear"] = np.stack([FRICTION * pressure, 0 * pressure])
    else:
        tractions["shear_along_load"] = FRICTION * pressure
    asked = FiniteElementDiscretisation(elements_per_radius=8)
    return LoadedBodies("", COATED, COATED, 1, axes, tractions, asked)


def hertz(r: np.ndarray) -> np.ndarray:
    return np.sqrt(np.maximum(1 - r**2, 0))


STATES: dict[str, LoadedBodies] = {
    "cells": pressed_and_pushed({"x": X, "y": X}, hertz(np.hypot(X[:, None], X))),
    "rings": pressed_and_pushed({"radii": RADII}, hertz(RADII)),
}
STATES["rings, along y"] = replace(STATES["rings"], direction=ALONG_Y)


@pytest.fixture(scope="module")
def fields() -> dict[str, StressField]:
    on_rings = OnSection(STATES["rings"]).stress()
    return {
        "cells": OnCells(STATES["cells"], see_edge=False).stress(),
        "rings": on_rings,
        "rings, along y": replace(on_rings, direction=ALONG_Y),
    }


@pytest.fixture(scope="module")
def written(
    fields: dict[str, StressField], tmp_path_factory: pytest.TempPathFactory
) -> dict[str, Path]:
    places = {name: tmp_path_factory.mktemp("stress") for name in fields}
    for name, field in fields.items():
        found = extremes(field)
        write_stress(STATES[name], "body", field, found, places[name], with_figures=False)
    return places


def test_stress_at_the_surface_is_the_traction_with_the_signs_of_the_convention(
    written: dict[str, Path],
) -> None:
    """Of the load along y, which lies in the plane x = 0, too."""
    for name, axis in (("cells", "x"), ("rings", "x"), ("rings, along y", "y")):
        mesh = read_mesh(written[name] / "stress_section.vtu")
        x, y, depth = mesh.points.T
        along, across = (x, y) if axis == "x" else (y, x)
        assert np.all(across == 0)
        corners = np.stack([along, depth], axis=1)[mesh.cells[1]]
        one, other = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
        twice_area = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
        assert np.all(twice_area != 0)  # its edges do not cross
        inside = (depth == 0) & (np.abs(along) < 0.7)
        pressure = hertz(along[inside])
        tensor = mesh.at_points["stress [Pa]"].reshape(-1, 3, 3)[inside]
        np.testing.assert_array_equal(tensor, np.swapaxes(tensor, 1, 2))
        np.testing.assert_allclose(tensor[:, 2, 2], -pressure, atol=0.03)
        np.testing.assert_allclose(tensor[:, "xy".index(axis), 2], -FRICTION * pressure, atol=0.03)


def test_stress_is_refused_before_it_takes_more_memory_than_there_is(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Fields of the whole volume. The estimate adds the numbers of the file to their peak."""
    x = (np.arange(64) - 31.5) * 2.4 / 64
    state = pressed_and_pushed({"x": x, "y": x}, hertz(np.hypot(x[:, None], x)))
    required: list[int] = []
    monkeypatch.setattr(stress_field, "FIXED", 0)
    monkeypatch.setattr(machine, "available_bytes", lambda: max(required, default=1 << 40))
    tracemalloc.start()
    volume = OnCells(state, see_edge=False).stress(volume=True).volume
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    required.append(int(0.95 * peak))
    with pytest.raises(ResourceRefused, match="Use fewer cells or depths"):
        OnCells(state, see_edge=False).stress(volume=True)
    required.append(int((1 + on_cells.WRITTEN / on_cells.COMPUTED) * peak))
    again = OnCells(state, see_edge=False).stress(volume=True).volume
    assert volume is not None
    assert again is not None
    assert again.stress.shape == volume.stress.shape
