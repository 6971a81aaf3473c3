"""What cells leave out of a finer map of heights is told, by how much it would change the peak."""

import re

import numpy as np
import pytest
from contact_scenes import APPROACH, PRESS, RADIUS, A, bump, scene, steel

from contact_errors.on_cells import stated_errors
from contact_results.remarks import remarks
from contact_scene import HeightMap
from semi_analytical import SurfaceGrid, solve

POINTS = 192


def told(amplitude, wave, cells, size=1.0):
    """The share of the peak that a remark names, None without one; and the one that is missed.

    amplitude  of waves on a ball, over the approach
    wave       their length over the contact radius
    size       of everything
    """
    spacing = 2.4 * A / POINTS
    x = (np.arange(POINTS) - (POINTS - 1) / 2) * spacing
    waves = np.cos(2 * np.pi * x / (wave * A))
    ball = (x[:, None] ** 2 + x**2) / (2 * RADIUS)
    heights = size * (ball + amplitude * APPROACH * np.multiply.outer(waves, waves))
    rough = HeightMap(file=heights, spacing=size * spacing, material=steel())
    pressed = scene({"normal_force": size**2 * 1e3}, friction=None, indenter=rough)
    peaks = []
    for n in (cells, POINTS):
        result = solve(pressed, SurfaceGrid((n, n), rough.extent), 1e-6)
        peaks.append(result.steps[0].peak_pressure)
        found = [re.search(r"pressure of (\S+) of the peak", told) for told in remarks(result)]
        if n == cells:
            named = next((float(match[1]) for match in found if match), None)
    assert not found, "nothing is left out on cells as fine as the map"
    return named, peaks[1] / peaks[0] - 1


# So low that they are flattened all the way.
@pytest.mark.parametrize("size", [1e-3, 1e3])
@pytest.mark.parametrize(("amplitude", "wave"), [(0.002, 0.05), (0.01, 0.05), (0.005, 0.05)])
def test_waves_that_the_cells_do_not_see_are_told_by_what_they_take_from_the_peak(
    amplitude, wave, size
):
    named, missed = told(amplitude, wave, 96, size)
    assert named == pytest.approx(missed, rel=0.3)
    assert missed > 0.03


def test_a_smooth_map_may_be_thinned():
    assert told(0.0, 1.0, 64)[0] is None


@pytest.mark.parametrize("seed", [0, 1, 2])
@pytest.mark.parametrize("cells", [64, 96])
def test_the_stated_error_of_the_peak_covers_what_the_cells_leave_out(seed, cells):
    spacing = 2.4 * A / POINTS
    k = 2 * np.pi * np.fft.fftfreq(POINTS, spacing)
    k = np.hypot(k[:, None], k)
    spectrum = np.where(k > 2 * np.pi / (0.5 * A), np.maximum(k, 1.0) ** -1.8, 0.0)
    noise = np.fft.fft2(np.random.default_rng(seed).standard_normal((POINTS, POINTS)))
    rough = np.real(np.fft.ifft2(noise * spectrum))
    heights = bump(POINTS, spacing) + 1e-3 * APPROACH * rough / np.std(rough)
    map_ = HeightMap(file=heights, spacing=spacing, material=steel())
    thinned, whole = (
        solve(scene(PRESS, friction=None, indenter=map_), SurfaceGrid((n, n), map_.extent), 1e-6)
        for n in (cells, POINTS)
    )
    found, exact = (result.steps[0].peak_pressure for result in (thinned, whole))
    stated = stated_errors(thinned).steps[0]["peak_pressure"]
    assert 0.005 * exact < abs(found - exact) < stated.error < 10 * abs(found - exact)
