"""A contact that the cells do not resolve is refused, with settings that do resolve it."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from command import slipstick
from contact_scenes import INDENTERS, PRESS, RADIUS, YOUNG, A, bump, grid, hertz, scene, steel

from contact_scene import Body, HeightMap, Layer, SurfaceDiscretisation
from contact_scene.geometry import ShapedBody
from semi_analytical import ContactNotResolved, SurfaceGrid, solve_discretised
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


@pytest.mark.parametrize("load", [1e-9, 1e-3, 1.0])
def test_a_load_that_makes_the_contact_small_is_refused_on_the_window_of_a_large_one(load):
    lowered = scene({"normal_force": load}, friction=None)
    cells = (64, 64)
    with pytest.raises(ContactNotResolved) as refusal:
        solved(lowered, SurfaceGrid(cells, (200 * hertz(load).contact_radius,) * 2))
    found = asked(lowered, cells, **advised(refusal)).steps[0].peak_pressure
    assert found == pytest.approx(hertz(load).peak_pressure, rel=0.01)


@pytest.mark.parametrize("stiffer", [1e3, 1e4])
@pytest.mark.parametrize("thickness", [0.5, 2.0])
def test_a_contact_that_a_stiff_layer_makes_small_is_refused(stiffer, thickness):
    film = Layer(thickness=thickness * A, material=steel(young_modulus=stiffer * YOUNG))
    coated = scene(
        PRESS,
        friction=None,
        indenter=INDENTERS["paraboloid"].model_copy(update={"material": "rigid"}),
    ).model_copy(update={"body": Body(material=steel(), layers=[film])})
    with pytest.raises(ContactNotResolved) as refusal:
        solved(coated, grid(32, contacts=3))
    assert resolution(asked(coated, (32, 32), **advised(refusal)))[0].contact > 8


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


class Quartic(ShapedBody):
    """Says nothing of how far it touches."""

    def initial_gap(self, x, y):
        """Of the fourth order."""
        return np.asarray((np.square(x) + np.square(y)) ** 2 / RADIUS**3)


def test_of_a_shape_that_says_nothing_of_itself_the_advice_resolves_more():
    unknown = scene(PRESS, friction=None).model_copy(update={"indenter": Quartic(material=steel())})
    with pytest.raises(ContactNotResolved) as refusal:
        solved(unknown, grid(32, contacts=200))
    assert resolution(asked(unknown, (32, 32), **advised(refusal)))[0].contact >= 1
