"""Tests of warnings about scenes and results: strains beyond linear theory, implausible numbers."""

from math import atan
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import semi_analytical
from contact_scene import (
    RIGID,
    Body,
    Cone,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Scene,
    SurfaceDiscretisation,
    read_scene_file,
)
from contact_scene.checks.expected_contact import (
    SMALL_STRAIN,
    beyond_linear_theory,
)
from contact_scene.checks.plausibility import implausible_input
from semi_analytical import Result
from verification.problems import problem as paper

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
FOAM = IsotropicMaterial(young_modulus=2e6, poisson_ratio=0.1)


def strain_solved(indenter, body, approach):
    scene = Scene(indenter=indenter, body=body, loading=(LoadStep(approach=approach),))
    return semi_analytical.solve_discretised(scene, SurfaceDiscretisation(cells=(16, 16)))


def strain_remarks(result: Result) -> tuple[str, ...]:
    return beyond_linear_theory(result.scene, result.steps)


@pytest.mark.parametrize("slope", [0.05, 0.15, 0.3, 0.6])
@pytest.mark.parametrize("material", [STEEL, FOAM])
def test_cone_is_told_by_its_slope_alone(slope, material):
    """Half the slope is the mean pressure over the modulus."""
    cone = Cone(slope_angle=atan(slope), material=RIGID)
    found = [
        strain_remarks(strain_solved(cone, Body(material=material), depth))
        for depth in (1e-6, 1e-2)
    ]
    assert [bool(told) for told in found] == [slope / 2 > SMALL_STRAIN] * 2


class End:
    """A state that presses so hard."""

    approach = 0.0
    contact_area = 1.0
    contact_radius = 0.5

    def __init__(self, pressure: float) -> None:
        self.normal_force = pressure


@given(st.floats(1e-6, 1e6))
def test_softest_within_a_contact_radius_counts(depth):
    body = Body(
        material=STEEL,
        layers=(Layer(thickness=depth, material=STEEL), Layer(thickness=0.1, material=FOAM)),
    )
    scene = Scene(
        indenter=paper.paraboloid(STEEL), body=body, loading=(LoadStep(normal_force=1.0),)
    )
    told = beyond_linear_theory(scene, [End(1e6)])
    assert bool(told) is (depth < End.contact_radius)
    assert all("in layer 2 of the body" in text for text in told)


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
    assert implausible_input(contents.scene, semi_analytical=contents.semi_analytical) == ()


@pytest.mark.parametrize("E", MATERIALS.values(), ids=MATERIALS)
@pytest.mark.parametrize("R", [1e-6, 1e-5, 18e-3, 0.5])
def test_real_materials_and_sizes_are_plausible(E, R):
    assert implausible_input(ball(E, R, 1.0)) == ()
