"""A result of large strains is told as such, whatever is pressed on what; others are not."""

from math import atan
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scene_texts import STEEL_ON_STEEL

import semi_analytical
from contact_results.files.summary_file import summary_of
from contact_scene import (
    RIGID,
    Body,
    Cone,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
    SurfaceDiscretisation,
    read_scene_file,
)
from contact_scene.checks.plausibility import implausible
from contact_scene.checks.strain_check import (
    SMALL_STRAIN,
    beyond_linear_theory,
)
from semi_analytical import Result
from verification.problems import paper_scene as paper

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
FOAM = IsotropicMaterial(young_modulus=2e6, poisson_ratio=0.1)
MILLIMETRE = 1e-3


def solved(indenter: Any, body: Body, approach: float) -> Result:
    scene = Scene(indenter=indenter, body=body, loading=(LoadStep(approach=approach),))
    return semi_analytical.solve_discretised(scene, SurfaceDiscretisation(cells=(16, 16)))


def remarks(result: Result) -> tuple[str, ...]:
    return beyond_linear_theory(result.scene, result.steps)


@pytest.mark.parametrize("slope", [0.05, 0.15, 0.3, 0.6])
@pytest.mark.parametrize("material", [STEEL, FOAM])
def test_cone_is_told_by_its_slope_alone(slope: float, material: IsotropicMaterial) -> None:
    """Half the slope is the mean pressure over the modulus."""
    cone = Cone(slope_angle=atan(slope), material=RIGID)
    found = [remarks(solved(cone, Body(material=material), depth)) for depth in (1e-6, 1e-2)]
    assert [bool(told) for told in found] == [slope / 2 > SMALL_STRAIN] * 2


@pytest.mark.parametrize(("radii", "large"), [(0.05, False), (0.2, False), (0.3, True)])
def test_ball_is_told_by_its_contact_radius(radii: float, large: bool) -> None:
    ball = Paraboloid(radius=MILLIMETRE, material=RIGID)
    result = solved(ball, Body(material=STEEL), radii**2 * MILLIMETRE)
    assert bool(remarks(result)) is large
    said = summary_of(result, ()).remarks
    assert tuple(told for told in said if told.startswith("strains of")) == remarks(result)


class End:
    """A state that presses so hard."""

    approach, contact_area, contact_radius = 0.0, 1.0, 0.5

    def __init__(self, pressure: float) -> None:
        self.normal_force = pressure


@given(st.floats(1e-6, 1e6))
def test_softest_within_a_contact_radius_counts(depth: float) -> None:
    body = Body(
        material=STEEL,
        layers=(Layer(thickness=depth, material=STEEL), Layer(thickness=0.1, material=FOAM)),
    )
    scene = Scene(
        indenter=paper.paraboloid(STEEL), body=body, loading=(LoadStep(normal_force=1.0),)
    )
    assert bool(beyond_linear_theory(scene, [End(1e6)])) is (depth < End.contact_radius)


# ---- Numbers that are hardly what was meant are remarked on, and no others.


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
