"""Tests of load steps: prescribed quantities, ramps, and the limits of force control."""

from contextlib import nullcontext
from typing import Any

import numpy as np
import pytest

from contact_scene import (
    Body,
    ControlKind,
    CoulombFriction,
    HeightMap,
    IsotropicMaterial,
    LoadStep,
    ScalarControl,
    Scene,
    SceneError,
    Sphere,
    VectorControl,
)
from contact_scene.stepping.load_path import along_one_line, first_direction

STEEL = IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)
FORCE = ControlKind.FORCE
DISPLACEMENT = ControlKind.DISPLACEMENT


def scene(*steps: dict[str, Any], mu: float | None = 0.1) -> Scene:
    return Scene(
        indenter=Sphere(radius=0.018, material=STEEL),
        body=Body(material=STEEL),
        friction=None if mu is None else CoulombFriction(coefficient=mu),
        loading=tuple(LoadStep(**step) for step in steps),
    )


def test_what_a_step_does_not_name_is_held_under_its_last_control() -> None:
    path = scene(
        {"normal_force": 100.0},
        {"tangential_force": (5.0, 0.0), "increments": 3},
        {"normal_force": 200.0},
        {"approach": 1e-6},
        {"tangential_shift": (1e-6, -1e-6)},
        {"approach": 2e-6, "tangential_shift": (0.0, 0.0)},
        {"normal_force": 50.0},
    ).load_path()
    assert [(ramp.step, ramp.increments) for ramp in path] == [
        (step, 3 if step == 2 else None) for step in range(1, 8)
    ]
    assert [ramp.normal for ramp in path] == [
        ScalarControl(FORCE, 0.0, 100.0),
        ScalarControl(FORCE, 100.0, 100.0),
        ScalarControl(FORCE, 100.0, 200.0),
        ScalarControl(DISPLACEMENT, None, 1e-6),  # the approach so far: known once solved
        ScalarControl(DISPLACEMENT, 1e-6, 1e-6),
        ScalarControl(DISPLACEMENT, 1e-6, 2e-6),
        ScalarControl(FORCE, None, 50.0),
    ]
    held = VectorControl(FORCE, (5.0, 0.0), (5.0, 0.0))
    assert [ramp.tangential for ramp in path] == [
        VectorControl(FORCE, (0.0, 0.0), (0.0, 0.0)),
        VectorControl(FORCE, (0.0, 0.0), (5.0, 0.0)),
        held,
        held,
        VectorControl(DISPLACEMENT, None, (1e-6, -1e-6)),
        VectorControl(DISPLACEMENT, (1e-6, -1e-6), (0.0, 0.0)),
        VectorControl(DISPLACEMENT, (0.0, 0.0), (0.0, 0.0)),
    ]


def test_rotations_that_no_step_has_named_are_held_at_zero() -> None:
    path = scene(
        {"normal_force": 100.0},
        {"moment": (0.1, -0.2), "torque": 0.3},
        {"twist": 0.01, "tilt": (0.0, 0.0)},
    ).load_path()
    assert [ramp.twisting for ramp in path] == [
        ScalarControl(DISPLACEMENT, 0.0, 0.0),
        ScalarControl(FORCE, None, 0.3),  # the torque that holding took: known once solved
        ScalarControl(DISPLACEMENT, None, 0.01),
    ]
    assert [ramp.tilting for ramp in path] == [
        VectorControl(DISPLACEMENT, (0.0, 0.0), (0.0, 0.0)),
        VectorControl(FORCE, None, (0.1, -0.2)),
        VectorControl(DISPLACEMENT, None, (0.0, 0.0)),
    ]
    (first,) = scene({"normal_force": 100.0, "moment": (0.1, 0.0), "torque": 0.3}).load_path()
    assert (first.tilting, first.twisting) == (
        VectorControl(FORCE, (0.0, 0.0), (0.1, 0.0)),
        ScalarControl(FORCE, 0.0, 0.3),
    )


@pytest.mark.parametrize(
    ("last", "straight"),
    [((-6.0, -8.0), True), ((0.0, 0.0), True), ((4.0, 4.0), False), ((3.0, -4.0), False)],
)
def test_the_direction_is_that_of_the_first_push_and_a_line_goes_both_ways(
    last: tuple[float, float], straight: bool
) -> None:
    ramps = scene(
        {"normal_force": 200.0}, {"tangential_force": (3.0, 4.0)}, {"tangential_force": last}
    ).load_path()
    assert (first_direction(ramps), along_one_line(ramps)) == ((0.6, 0.8), straight)


def test_a_moment_tips_a_map_over_its_shorter_side_alone() -> None:
    narrow = HeightMap.model_validate(
        {"file": np.zeros((8, 4)), "spacing": 1e-3, "material": STEEL}
    )
    for moment, tips in (((0.0, 3e-3), False), ((3e-3, 0.0), True)):
        step = LoadStep(normal_force=1.0, moment=moment)
        with pytest.raises(SceneError, match="tips over") if tips else nullcontext():
            posed = Scene(indenter=narrow, body=Body(material=STEEL), loading=(step,))
    assert posed.loading[0].moment == (0.0, 3e-3)
