"""Tests of contacts that the cells do not resolve: refusal, and advice that resolves them."""

import json
import re
from statistics import NormalDist

import numpy as np
import pytest
from contact_scenes import APPROACH, INDENTERS, PRESS, RADIUS, A, bump, grid, push, scene, steel

from contact_results.result_warnings import warnings_of
from contact_scene import (
    HeightMap,
    SurfaceDiscretisation,
)
from semi_analytical import ContactNotResolved, SurfaceGrid, discretised, solve, solve_discretised
from semi_analytical.discretised import CellSolver
from semi_analytical.resolution import resolution

SETTING = r"--set semi_analytical\.(cells|window)=(\[[^\]]*\])"


def solved(described, surface):
    """On a grid that was asked for."""
    return asked(described, surface.cells, window=surface.window)


def asked(described, cells, **window):
    fineness = SurfaceDiscretisation(**{"cells": cells, **window}, tolerance=1e-6)
    return solve_discretised(described, fineness)


def advised(refusal):
    """The settings that a refusal advises."""
    name, value = re.search(SETTING, str(refusal.value)).groups()
    return {name: json.loads(value)}


# Between four centres nothing of a flat punch touches, which is refused beforehand.
@pytest.mark.parametrize(
    ("shape", "cells"),
    [(shape, n) for shape in INDENTERS for n in (31, 32) if (shape, n) != ("flat punch", 32)],
)
def test_a_contact_below_a_cell_is_refused_and_resolved_as_advised(shape, cells):
    described = scene(PRESS, friction=None, indenter=INDENTERS[shape])
    with pytest.raises(ContactNotResolved, match="smaller than the cells") as refusal:
        solved(described, grid(cells, contacts=cells / 2 / 0.2))
    assert resolution(asked(described, (cells, cells), **advised(refusal)))[0].contact > 8


@pytest.mark.parametrize("height", [0.5, 5.0])
def test_a_load_that_rests_on_one_height_of_a_map_is_refused(height):
    heights = bump(64, 3 * A / 64)
    heights[40, 30] -= height * A**2 / RADIUS
    spiked = HeightMap(file=heights, spacing=3 * A / 64, material=steel())
    light = scene({"normal_force": 1.0}, friction=None, indenter=spiked)
    with pytest.raises(ContactNotResolved, match=r"1 of them.*a map of this spacing"):
        solved(light, grid(64))


@pytest.mark.parametrize("left", [1e-3, 1e-6])
def test_a_history_that_unloads_to_next_to_nothing_is_not_refused(left):
    history = scene(PRESS, {"normal_force": left * 1e3}, PRESS, friction=None)
    first, second, third = resolution(solved(history, grid()))
    assert first == third
    assert second.contact < 1
    assert first.contact > 8


# ---- waves between cells


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
        found = [re.search(r"pressure of (\S+) of the peak", told) for told in warnings_of(result)]
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


def test_what_waves_between_cells_take_counts_with_their_highest(monkeypatch):
    """A height of a Gaussian surface that one place in a thousand exceeds."""
    monkeypatch.setattr(discretised, "unresolved_pressure", lambda result: 0.1)
    lost = CellSolver(scene(PRESS), SurfaceDiscretisation()).neglected_errors(None)
    assert lost["peak_pressure"] == pytest.approx(0.1 * NormalDist().inv_cdf(0.999), rel=0.05)


def test_increments_are_measured_on_eleven_cells_per_contact_radius():
    fine = SurfaceDiscretisation(cells=(96, 96), window=(3 * A, 3 * A), edge="off")
    solver = CellSolver(scene(PRESS, friction=None), fine)
    result = solver.run(lambda *_: None)
    few = solver.few(solver.fineness_of(result), result).space
    assert A / few.spacing[0] == pytest.approx(11, rel=0.05)


# ---- sizes in cells


TOLERANCE = 1e-8


def solved_on(*loading, cells=32, contacts=1.5, **parts):
    return solve(scene(*loading, **parts), grid(cells, contacts), TOLERANCE)


def resolved(*loading, **parts):
    return resolution(solved_on(*loading, **parts))[-1]


def test_cells_count_with_their_larger_side_and_strips_with_their_width():
    assert SurfaceGrid((8, 4), (2.0, 2.0)).cell_side == 0.5
    assert SurfaceGrid((8, 1), (2.0, 1.0)).cell_side == 0.25


@pytest.mark.parametrize("cells", [31, 32])
@pytest.mark.parametrize("radius", [1.6, 3.0, 8.3])
def test_contact_is_counted_in_cells(cells, radius):
    found = resolved(PRESS, friction=None, cells=cells, contacts=cells / 2 / radius)
    assert found.contact == pytest.approx(radius, abs=0.8 / radius)


def test_the_stick_zone_shrinks_as_cattaneo_says_and_slip_takes_the_rest():
    for part in (0.3, 0.7, 0.9):
        found = resolved(PRESS, push(part), cells=64)
        assert found.stick == pytest.approx(found.contact * np.cbrt(1 - part), abs=0.5)
        assert found.annulus == found.contact - found.stick
    held = resolved(PRESS, push(1e-6), cells=64)
    assert (held.stick, held.annulus) == (pytest.approx(held.contact), None)
    free = resolved(PRESS, friction=None)
    assert (free.stick, free.annulus) == (None, None)
    slid = solved_on(PRESS, {"tangential_shift": (20 * A**2 / RADIUS, 0.0)})
    assert CellSolver.of(slid).features(slid)[-1].slides


def egg_box(wave, cells=64):
    """Crests so many cells apart, on a window of three contact radii."""
    ridges = np.cos(2 * np.pi * (np.arange(cells) + 0.5) / wave)
    heights = A**2 / RADIUS * np.add.outer(ridges, ridges)
    return HeightMap(file=heights, spacing=3 * A / cells, material=steel())


@pytest.mark.parametrize("wave", [8, 16, 32])
def test_patches_count_as_one_of_them_and_the_wave_of_a_sine_is_its_length(wave):
    result = solved_on({"approach": A**2 / RADIUS}, friction=None, indenter=egg_box(wave), cells=64)
    patches = (64 // wave) ** 2
    across = np.sqrt(np.count_nonzero(result.steps[0].in_contact) / patches / np.pi)
    found = resolution(result)[0]
    assert found.contact == pytest.approx(across, rel=0.05) or found.contact < 1.0 < across < 1.2
    assert found.wave == pytest.approx(wave, rel=0.15)  # of the part in touch
