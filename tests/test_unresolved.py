"""A contact that the cells do not resolve is refused, with settings that do resolve it."""

import json
import re
from pathlib import Path

import pytest
from command import slipstick
from contact_scenes import INDENTERS, PRESS, RADIUS, A, bump, grid, scene, steel

from contact_scene import HeightMap, SurfaceDiscretisation
from semi_analytical import ContactNotResolved, solve_discretised
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
    with pytest.raises(ContactNotResolved, match=r"1 of them.*heights measured as closely"):
        solved(light, grid(64))


@pytest.mark.parametrize("left", [1e-3, 1e-6])
def test_a_history_that_unloads_to_next_to_nothing_is_not_refused(left):
    history = scene(PRESS, {"normal_force": left * 1e3}, PRESS, friction=None)
    first, second, third = resolution(solved(history, grid()))
    assert first == third
    assert second.contact < 1
    assert first.contact > 8


def test_the_command_says_so_with_exit_code_3_and_writes_nothing(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    coarse = ("--set", "semi_analytical.window=[1,1]", "--set", "semi_analytical.cells=[32,32]")
    assert slipstick("run", "scenes/hertz.toml", "-o", tmp_path / "out", *coarse) == 3
    assert "--set semi_analytical.window=[0.0008" in capfd.readouterr().err
    assert not (tmp_path / "out").exists()
