"""Points of a stress field say the same whoever computed them and however they lie."""

import numpy as np
import pytest

from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.on_cells import stress_on_cells
from contact_results.stress.on_section import stress_on_section
from contact_results.stress.points import StressField, StressPoints
from contact_scene import Body, FiniteElementDiscretisation, IsotropicMaterial, Layer

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


@pytest.fixture(scope="module")
def on_section() -> StressField:
    radii = np.linspace(0, 1.2, 61)
    pressure = np.sqrt(np.maximum(1 - radii**2, 0))
    return stress_on_section(pressed_and_pushed({"radii": radii}, pressure))


@pytest.fixture(scope="module")
def on_cells() -> StressField:
    x = (np.arange(33) - 16) * 2.4 / 33
    pressure = np.sqrt(np.maximum(1 - x[:, None] ** 2 - x**2, 0))
    return stress_on_cells(pressed_and_pushed({"x": x, "y": x}, pressure))


def test_both_halves_of_a_section_meet_on_the_axis(on_section: StressField) -> None:
    section = on_section.section
    on_axis = section.chosen((section.x == 0) & (section.depth <= 1))
    ahead, behind = (on_axis.chosen(np.signbit(on_axis.x) == side) for side in (False, True))
    np.testing.assert_array_equal(ahead.depth, behind.depth)
    scale = np.abs(section.stress).max()
    # What recovery leaves of the first harmonic there is 2e-3 at 8 elements per radius.
    for name, values in ahead.components.items():
        np.testing.assert_allclose(behind.components[name], values, atol=4e-3 * scale)
    assert np.abs(ahead.components["xz"]).max() > 0.1 * scale


def test_cells_and_rings_draw_the_same_picture(
    on_cells: StressField, on_section: StressField
) -> None:
    """Down the axis, one material after the other."""
    scale = np.abs(on_section.section.stress).max()
    for material in (0, 1):
        one, other = (
            axis.chosen(axis.material == material) for axis in (on_cells.axis, on_section.axis)
        )
        inside = one.chosen(one.depth > 0.1)
        for name, values in inside.components.items():
            expected = np.interp(inside.depth, other.depth, other.components[name])
            np.testing.assert_allclose(values, expected, atol=0.02 * scale)


def test_measures_of_a_pure_shear() -> None:
    nothing, one = np.zeros(1), np.zeros((3, 1))
    shear = np.array([0, 0, 0, 0, 3.0, 0])[:, None]
    points = StressPoints(nothing, nothing, nothing, nothing.astype(int), one, shear, nothing > 0)
    found = {name: value.item() for name, value in points.measures.items()}
    expected = {"von_mises": 3 * np.sqrt(3), "max_principal": 3.0, "max_shear": 3.0}
    assert found == pytest.approx(expected)
