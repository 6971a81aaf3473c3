"""A result of large strains is told as such, whatever is pressed on what; others are not."""

from math import atan
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

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
    Sphere,
    SurfaceDiscretisation,
)
from contact_scene.linear_theory import SMALL_STRAIN, beyond_linear_theory
from contact_scene.material import Material
from semi_analytical import Result
from verification.problems import paper_scene as paper

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
RUBBER = IsotropicMaterial(young_modulus=2e6, poisson_ratio=0.5)
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


@pytest.mark.parametrize("base", [RIGID, STEEL])
@pytest.mark.parametrize(
    ("film", "part", "large"),
    [
        (FOAM, 0.05, False),
        (FOAM, 0.5, True),
        (RUBBER, 1e-4, False),
        (RUBBER, 0.05, True),  # squeezed out sideways, sheared by 3 a/h times as much
        (RUBBER, 0.5, True),
    ],
)
def test_film_is_told_by_how_far_it_is_pressed(
    base: Material, film: IsotropicMaterial, part: float, large: bool
) -> None:
    body = Body(material=base, layers=(Layer(thickness=1e-4, material=film),))
    found = remarks(solved(Sphere(radius=1.0, material=RIGID), body, part * 1e-4))
    assert bool(found) is large
    assert all("layer" in told for told in found)


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
