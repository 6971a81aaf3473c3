"""Numbers that are hardly what was meant are remarked on, and no others."""

import json
from pathlib import Path

import numpy as np
import pytest
from command import slipstick
from contact_scenes import bump
from scene_texts import STEEL_ON_STEEL

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


COATED = (
    STEEL_ON_STEEL
    + """
[[body.layers]]
thickness = "5 um"
material = { young_modulus = "400 GPa", poisson_ratio = 0.2 }
[friction]
coefficient = 0.3
[[loading]]
normal_force = 100
[[loading]]
tangential_force = [20, 0]
"""
)
MISTAKES = {  # of a steel ball on a coated one: the contact radius is 0.19 mm
    "GPa left out": ("body.material.young_modulus=210", 'was "210 GPa" meant?'),
    "MPa below a film": ("body.material.young_modulus=210e3", "strains of about 0.63"),
    "mm left out": ("indenter.radius=10", 'was "10 mm" meant?'),
    "um for mm": ('indenter.radius="10 um"', "strains of about"),
    "thickness without unit": ("body.layers[1].thickness=5", 'was "5 um" meant?'),
    "mm for um": ('body.layers[1].thickness="50 mm"', "hardly anything shows of what lies below"),
    "nm for um": ('body.layers[1].thickness="5 nm"', "hardly anything shows of it"),
    "a sign before a ratio": ("body.material.poisson_ratio=-0.3", "below the usual 0"),
    "kN for N": ('loading[1].normal_force="60 kN"', "hardest ceramics yield before"),
    "a tenth of a degree": ("loading[2]={tilt=[0,0.05]}", 'was "0.05 deg" meant?'),
    "per cent": ("friction.coefficient=30", 'was "30 per cent" meant?'),
    "MN for kN": ('loading[1].normal_force="1 MN"', "strains of about"),
    "mm of shift": ('loading[2]={tangential_shift=["0.5 mm",0]}', "further than the contact"),
    "degrees of twist": ("loading[2]={twist=1}", 'was "1 deg" meant?'),
    "degrees of tilt": ("loading[2]={tilt=[0.5,0]}", 'was "0.5 deg" meant?'),
    "degrees of slope": (
        'indenter={shape="cone",slope_angle=0.5,material="rigid"}', 'was "0.5 deg" meant?',
    ),
    "mm of approach": ('loading[1]={approach="10 mm"}', "strains of about"),
    "a tolerance of cells": ("semi_analytical.tolerance=0.1", "above the usual 0.001"),
}  # fmt: skip


@pytest.fixture
def coated(tmp_path: Path) -> Path:
    path = tmp_path / "coated.toml"
    path.write_text(COATED)
    return path


@pytest.mark.parametrize(("change", "remark"), MISTAKES.values(), ids=MISTAKES)
def test_a_usual_mistake_is_told(coated, change, remark):
    sound, wrong = (read_scene_file(coated, overrides) for overrides in ((), (change,)))
    assert implausible(sound.scene) == ()
    told = implausible(wrong.scene, semi_analytical=wrong.semi_analytical)
    assert any(remark in one for one in told), told


@pytest.mark.parametrize("command", ["plan", "run"])
def test_whoever_does_not_check_is_told_too(
    command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Once each, and a run says it again to whoever reads its summary."""
    changes = ("friction.coefficient=30", "semi_analytical.cells=[16,16]")
    words = [word for change in changes for word in ("--set", change)]
    out = ("-o", tmp_path / "out", "--figures", "none", "--no-error") if command == "run" else ()
    assert slipstick(command, SCENES[2], *words, *out) == 0
    assert capsys.readouterr().err.count('was "30 per cent" meant?') == 1
    if out:
        summary = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
        assert any('was "30 per cent" meant?' in remark for remark in summary["remarks"])


@pytest.mark.parametrize("unit", [1e6, 1e3])
def test_heights_that_are_not_in_metres_are_told(unit):
    heights = bump(64, 5e-6)
    for scale, expected in ((1.0, 0), (unit, 1)):
        surface = {"shape": "height_map", "file": scale * heights, "spacing": 5e-6}
        document = ball(210e9, 18e-3, 1e-3).model_dump()
        document["indenter"] = {**surface, "material": document["body"]["material"]}
        told = implausible(Scene.model_validate(document))
        assert ["read in metres" in remark for remark in told] == [True] * expected


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
    assert 'file "h.npy" (3.472e-10 to 1.378e-06 in SI units, 64 x 64 values)' in shown
    assert 'map "mu.npy" (0.1 to 0.2 in SI units, 64 x 32 values)' in shown
    assert "elements: box 50" in shown
