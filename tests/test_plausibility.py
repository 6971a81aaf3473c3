"""Numbers that are hardly what was meant are remarked on, and no others."""

import json
from pathlib import Path

import numpy as np
import pytest
from command import slipstick
from contact_scenes import bump

from contact_scene import Scene, SurfaceDiscretisation, read_scene_file
from contact_scene.plausibility import implausible

SCENES = sorted((Path(__file__).resolve().parents[1] / "scenes").glob("*.toml"))
MATERIALS = {"gel": 1e4, "rubber": 5e6, "polymer": 3e9, "steel": 210e9, "diamond": 1.1e12}


def ball(E, R, W, coefficient=0.1, **indenter):
    """A ball on its own material, with half the strain at which linear theory ends if W is 1."""
    material = {"young_modulus": E, "poisson_ratio": 0.3}
    shape = {"shape": "paraboloid", "radius": R, "material": material, **indenter}
    return Scene.model_validate(
        {
            "indenter": shape,
            "body": {"material": material},
            "friction": {"coefficient": coefficient},
            "loading": [{"normal_force": W * 1e-3 * E * R**2}],
        }
    )


@pytest.mark.parametrize("file", SCENES, ids=lambda file: file.stem)
def test_the_shipped_scenes_are_plausible(file):
    contents = read_scene_file(file)
    assert implausible(contents.scene, semi_analytical=contents.semi_analytical) == ()


@pytest.mark.parametrize("E", MATERIALS.values(), ids=MATERIALS)
@pytest.mark.parametrize("R", [1e-6, 1e-5, 18e-3, 0.5])
def test_real_materials_and_sizes_are_plausible(E, R):
    assert implausible(ball(E, R, 1.0)) == ()


@pytest.mark.parametrize(("E", "R"), [(1.0, 1.0), (1.0, 46.4), (210.0, 18.0), (210e3, 18.0)])
def test_scenes_without_units_or_in_their_own_are_left_alone(E, R):
    dimensionless = SurfaceDiscretisation(window=(3 * R, 3 * R))
    assert implausible(ball(E, R, 1.0), semi_analytical=dimensionless) == ()


@pytest.mark.parametrize(
    ("E", "R", "key", "meant"),
    [
        *((E / 1e9, 18e-3, "body.material.young_modulus", "GPa") for E in (2e9, 70e9, 420e9)),
        *((210e9, R, "indenter.radius", "mm") for R in (1.5, 6.35, 500.0)),
    ],
)
def test_a_number_that_lacks_its_prefix_is_met_with_the_unit_that_was_meant(E, R, key, meant):
    (told,) = [remark for remark in implausible(ball(E, R, 1.0)) if remark.startswith(key)]
    number = E if meant == "GPa" else R
    assert f'was "{number:g} {meant}" meant?' in told


def test_windows_shifts_and_coefficients_are_looked_at_too():
    scene = ball(210e9, 18e-3, 1.0, coefficient=10.0)
    wide = SurfaceDiscretisation(window=(1.2, 1.2e-3))
    told = implausible(scene, semi_analytical=wide)
    assert [remark.split(":")[0] for remark in told] == [
        "friction.coefficient",
        "semi_analytical.window[1]",
    ]
    assert '"10 per cent"' in told[0]


@pytest.mark.parametrize("E", MATERIALS.values(), ids=MATERIALS)
@pytest.mark.parametrize("R", [1e-8, 18e-3, 0.5])
@pytest.mark.parametrize("by", ["force", "approach"])
def test_a_load_that_ends_linear_theory_is_told_whatever_the_material_and_size(E, R, by):
    pressed = ball(E, R, 1000.0)
    if by == "approach":
        step = {"approach": 0.5 * R}
        pressed = Scene.model_validate({**pressed.model_dump(), "loading": [step]})
    assert any("strains of about" in remark for remark in implausible(pressed))


@pytest.mark.parametrize("unit", [1e6, 1e3])
def test_heights_that_are_not_in_metres_are_told(unit):
    heights = bump(64, 5e-6)
    for scale, expected in ((1.0, 0), (unit, 1)):
        surface = {"shape": "height_map", "file": scale * heights, "spacing": 5e-6}
        document = ball(210e9, 18e-3, 1e-3).model_dump()
        document["indenter"] = {**surface, "material": document["body"]["material"]}
        told = implausible(Scene.model_validate(document))
        assert ["read in metres" in remark for remark in told] == [True] * expected


def test_check_tells_remarks_and_ends_well(capsys: pytest.CaptureFixture[str]) -> None:
    soft = ("check", SCENES[0], "--set", "body.material.young_modulus=210")
    assert slipstick(*soft) == 0
    assert 'was "210 GPa" meant?' in capsys.readouterr().err
    assert slipstick(*soft, "--json") == 0
    assert "210 GPa" in json.loads(capsys.readouterr().out)["remarks"][0]


def test_check_says_how_large_maps_are(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    np.save(tmp_path / "h.npy", bump(64, 5e-6))
    np.save(tmp_path / "mu.npy", np.linspace(0.1, 0.2, 64 * 32).reshape(64, 32))
    (tmp_path / "scene.toml").write_text(
        """
        indenter = { shape = "height_map", file = "h.npy", spacing = "5 um", material = "rigid" }
        body.material = { young_modulus = "210 GPa", poisson_ratio = 0.3 }
        friction.coefficient = { map = "mu.npy", spacing = "10 um" }
        loading = [ { normal_force = "1 N" } ]
        fem_reference.box = 50
        """
    )
    assert slipstick("check", tmp_path / "scene.toml") == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "heights 0.3472 nm to 1.378 µm, 64 x 64 values on 0.32 mm x 0.32 mm" in shown
    assert "0.1 to 0.2, 64 x 32 values on 0.64 mm x 0.32 mm" in shown
    assert "elements: box 50" in shown
