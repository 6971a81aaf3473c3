"""Stress below the radial solver's contacts: closed forms, laws of layers, the other solver."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from command import outcome
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import radial
import radial.history
import slipstick
from contact_errors.stress_errors import stress_errors
from contact_results.stress.loaded_bodies import state_of_result, state_of_run
from contact_results.stress.on_disc import stress_on_disc
from contact_results.stress.points import StressField
from contact_results.stress.stress_maxima import (
    Extreme,
    extremes,
)
from contact_scene import (
    RIGID,
    Body,
    Cone,
    FlatPunch,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.geometry import ShapedBody
from contact_scene.quantities.stated_error import (
    ErrorStatus,
    StatedError,
)
from radial.normal.disc import disc
from radial.response.bodies import Bodies
from radial.stress.subsurface_disc import Below
from semi_analytical.frf.depth import Level
from semi_analytical.frf.stack import stack_of
from verification.closed_forms.huber_stress import huber_stress

# a = 1, E* = π/2 and p_H = 1.
SOFT = IsotropicMaterial(young_modulus=0.91 * np.pi / 2, poisson_ratio=0.3)
BALL = Paraboloid(radius=1.0, material=RIGID)
BARE = Body(material=SOFT)
RADII = np.concatenate([[0.0, 1e-5], np.linspace(0.05, 3, 40), [1 - 1e-9, 1 + 1e-9]])


def coated(modulus: float, thickness: float, ratio: float = 0.3) -> Body:
    layer = IsotropicMaterial(young_modulus=modulus * SOFT.young_modulus, poisson_ratio=ratio)
    return Body(material=SOFT, layers=(Layer(thickness=thickness, material=layer),))


def scene_of(body: Body, indenter: ShapedBody = BALL, force: float = 2.0) -> Scene:
    return Scene(indenter=indenter, body=body, loading=(LoadStep(normal_force=force),))


def below(body: Body) -> Below:
    return Below(disc(Bodies.of(scene_of(body)), BALL, 1.0), stack_of(body), 3.0)


@given(depth=st.floats(1e-3, 5.0))
def test_below_a_ball_it_is_hubers(depth: float) -> None:
    fields = below(BARE).at([Level(depth, 0)], RADII)[0]
    exact = huber_stress(RADII, depth, 1.0, 1.0, 0.3)
    for ours, theirs in zip(
        fields[2:], (exact.radial, exact.hoop, exact.axial, exact.shear), strict=True
    ):
        assert_allclose(ours, theirs, rtol=0, atol=1e-11)


@given(thickness=st.floats(0.1, 2.0), part=st.just(0.0) | st.floats(0.01, 2.0))
def test_a_layer_like_its_substrate_leaves_the_stress_as_it_is(
    thickness: float, part: float
) -> None:
    # Nearer to the surface than a thousandth of a radius 1e-9 is left, not 1e-10.
    depth = part * thickness
    there = Level(depth, 0 if part < 1 else 1)
    layered = below(coated(1.0, thickness)).at([there], RADII)[0]
    assert_allclose(layered, below(BARE).at([Level(depth, 0)], RADII)[0], rtol=0, atol=1e-10)


@given(modulus=st.floats(0.1, 10.0), thickness=st.floats(0.1, 2.0), ratio=st.floats(-0.5, 0.5))
def test_an_interface_carries_what_it_is_given(
    modulus: float, thickness: float, ratio: float
) -> None:
    """Displacement and traction are the same on both sides, by two ways of the response."""
    sides = [Level(thickness, 0), Level(thickness, 1)]
    above, under = below(coated(modulus, thickness, ratio)).at(sides, RADII)
    for component in (0, 1, 4, 5):
        assert_allclose(above[component], under[component], rtol=0, atol=1e-10)


def field_of(scene: Scene) -> tuple[StressField, tuple[Extreme, ...], tuple[StatedError, ...]]:
    state = state_of_result(radial.solve(scene), None)
    field = stress_on_disc(state)
    found = extremes(field, scene.body)
    return field, found, stress_errors(state, field, found)


def test_the_largest_stresses_of_a_ball_are_known() -> None:
    _, found, errors = field_of(scene_of(BARE, force=2 * np.pi / 3))
    largest = {e.measure: e for e in found}
    # (1-2ν)/3 at the edge (Johnson 1985, 3.4); the shear by Huber's axis, to the last digit.
    z = np.linspace(0.4, 0.6, 200001)
    on_axis = huber_stress(0.0, z, 1.0, 1.0, 0.3)
    assert_allclose(largest["max_principal"].value, 0.4 / 3, rtol=1e-9)
    assert_allclose(
        largest["max_shear"].value, np.max(on_axis.radial - on_axis.axial) / 2, rtol=1e-10
    )
    for error, extreme in zip(errors, found, strict=True):
        assert error.error is not None
        assert error.error < 1e-6 * extreme.value


def test_a_run_that_was_written_has_the_same_stress(tmp_path: Path) -> None:
    result = radial.solve(scene_of(coated(2.0, 0.5), FlatPunch(radius=1.0, material=RIGID)))
    slipstick.save(result, tmp_path / "run")
    at_once = stress_on_disc(state_of_result(result, None))
    again = stress_on_disc(state_of_run(tmp_path / "run", None))
    assert np.array_equal(again.points.stress, at_once.points.stress)


@pytest.mark.parametrize(
    ("indenter", "where"),
    [('shape = "cone", slope_angle = 0.1', "a tip"), ('shape = "flat_punch", radius = 1', "a rim")],
)
def test_shear_below_infinite_pressure_is_refused_before_anything_is_solved(
    indenter: str, where: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr(radial.history, "solve")
    (tmp_path / "scene.toml").write_text(f"""
        indenter = {{ {indenter}, material = "rigid" }}
        friction = {{ coefficient = 0.1 }}
        [body]
        material = {{ young_modulus = 1, poisson_ratio = 0.5 }}
        [[loading]]
        normal_force = 1e-3
        [[loading]]
        twist = 1e-3
    """)
    asked = ("stress", "scene.toml", "--solver", "radial", "-o", "out")
    said = outcome(*asked, cwd=tmp_path)
    assert said.returncode == 2
    assert f"infinite at {where}" in said.stderr


def test_a_ball_smaller_than_a_metre_is_round_all_the_same(tmp_path: Path) -> None:
    """Its gap ends at the equator: what it is like at the axis is asked within the contact."""
    (tmp_path / "scene.toml").write_text("""
        indenter = { shape = "sphere", radius = "10 mm", material = "rigid" }
        friction = { coefficient = 0.3 }
        [body]
        material = { young_modulus = "210 GPa", poisson_ratio = 0.5 }
        [[loading]]
        normal_force = 100
        [[loading]]
        tangential_force = [20, 0]
        increments = 2
    """)
    asked = ("stress", "scene.toml", "--solver", "radial", "-o", "out", "--depths", "0")
    said = outcome(*asked, "--figures", "none", "--no-error", cwd=tmp_path)
    assert said.returncode == 0, said.stderr


@pytest.mark.parametrize(
    "indenter", [FlatPunch(radius=1.0, material=RIGID), Cone(slope_angle=0.1, material=RIGID)]
)
def test_no_error_is_trusted_where_the_stress_is_infinite(indenter: ShapedBody) -> None:
    _, found, errors = field_of(scene_of(coated(2.0, 0.5), indenter))
    status = {(e.region, e.measure): error.status for e, error in zip(found, errors, strict=True)}
    assert status["body", "von_mises"] is ErrorStatus.NOT_CONVERGED
    assert status["base", "von_mises"] is ErrorStatus.ESTIMATED
