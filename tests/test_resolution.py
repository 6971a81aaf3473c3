"""What is resolved of a result is counted in cells, whatever the sizes, loads and materials."""

import numpy as np
import pytest
from contact_scenes import PRESS, RADIUS, YOUNG, A, grid, push, scene, steel

from contact_scene import Body, Ellipsoid, HeightMap, Layer
from semi_analytical import SurfaceGrid, solve
from semi_analytical.resolution import resolution

TOLERANCE = 1e-8


def solved(*loading, cells=32, contacts=1.5, **parts):
    return solve(scene(*loading, **parts), grid(cells, contacts), TOLERANCE)


def resolved(*loading, **parts):
    return resolution(solved(*loading, **parts))[-1]


@pytest.mark.parametrize("cells", [31, 32])
@pytest.mark.parametrize("radius", [1.6, 3.0, 8.3])
def test_contact_is_counted_in_cells(cells, radius):
    found = resolved(PRESS, friction=None, cells=cells, contacts=cells / 2 / radius)
    assert found.contact == pytest.approx(radius, abs=0.8 / radius)


@pytest.mark.parametrize("axis", [0, 1])
def test_of_an_ellipse_the_smaller_semi_axis_counts_whatever_way_it_lies(axis):
    radii, window = (RADIUS, 9 * RADIUS), (4 * A, 6 * A)
    lying = Ellipsoid(radii=radii[:: 1 - 2 * axis], material=steel())
    surface = SurfaceGrid((48, 48), window[:: 1 - 2 * axis])
    result = solve(scene(PRESS, friction=None, indenter=lying), surface, TOLERANCE)
    across = np.max(np.sum(result.steps[0].in_contact, axis=axis))
    assert resolution(result)[0].contact == pytest.approx(across / 2, abs=0.5)


def test_the_stick_zone_shrinks_as_cattaneo_says_and_slip_takes_the_rest():
    for part in (0.3, 0.7, 0.9):
        found = resolved(PRESS, push(part), cells=64)
        assert found.stick == pytest.approx(found.contact * np.cbrt(1 - part), abs=0.5)
        assert found.annulus == found.contact - found.stick
    held = resolved(PRESS, push(1e-6), cells=64)
    assert (held.stick, held.annulus) == (pytest.approx(held.contact), None)
    free = resolved(PRESS, friction=None)
    assert (free.stick, free.annulus) == (None, None)


def test_layers_that_hardly_differ_are_resolved_as_one():
    """Of a coating cut in 50, all; of a gradient what varies by a tenth; of the base none."""

    def graded(last: float) -> float:
        moduli = np.linspace(2, last, 50) * YOUNG
        layers = [Layer(thickness=A / 50, material=steel(young_modulus=E)) for E in moduli]
        return Body(material=steel(), layers=layers).thinnest

    assert graded(2) == pytest.approx(A)
    assert A / 20 < graded(1.2) < A / 5
    assert Body(material=steel(), layers=[Layer(thickness=A, material=steel())]).thinnest == np.inf


def test_the_thinnest_layer_is_counted_in_cells():
    of = {0.5: steel(young_modulus=2 * YOUNG), 0.25: steel(poisson_ratio=0.4)}
    layers = [Layer(thickness=t * A, material=material) for t, material in of.items()]
    coated = Body(material=steel(), layers=layers)
    made = scene(PRESS, friction=None).model_copy(update={"body": coated})
    assert resolution(solve(made, grid(), TOLERANCE))[0].layer == pytest.approx(0.25 * 32 / 3)


def egg_box(wave, cells=64):
    """Crests so many cells apart, on a window of three contact radii."""
    ridges = np.cos(2 * np.pi * (np.arange(cells) + 0.5) / wave)
    heights = A**2 / RADIUS * np.add.outer(ridges, ridges)
    return HeightMap(file=heights, spacing=3 * A / cells, material=steel())


@pytest.mark.parametrize("wave", [8, 16, 32])
def test_patches_count_as_one_of_them_and_the_wave_of_a_sine_is_its_length(wave):
    result = solved({"approach": A**2 / RADIUS}, friction=None, indenter=egg_box(wave), cells=64)
    patches = (64 // wave) ** 2
    across = np.sqrt(np.count_nonzero(result.steps[0].in_contact) / patches / np.pi)
    found = resolution(result)[0]
    assert found.contact == pytest.approx(across, rel=0.05) or found.contact < 1.0 < across < 1.2
    assert found.wave == pytest.approx(wave, rel=0.15)  # of the part in touch
