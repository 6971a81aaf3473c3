"""Tests of the radial solver on points (r, θ): angular range and increments."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import radial
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.solver_errors import ContactAtZoneEdge
from radial.angular_grid import RingAngles
from radial.frictional.coupling import Coupling
from radial.tangential.ring_friction import solve_increment
from radial.tangential.ring_layout import create_points
from radial.tangential.ring_points import ContactPoints
from radial.tangential.ring_problem import RingProblem
from radial.tangential.ring_state import (
    Loads,
    PointState,
)
from radial.tangential.tangential_steps import TangentialSteps

SOFT = IsotropicMaterial(young_modulus=0.91, poisson_ratio=0.3)
# of a ball with R = 1 and E* = 1: a = 1/100
LOAD = 4 / 3e6
FRICTION = 0.3
RADIUS = 0.01
LIMIT = LOAD * FRICTION
PRESS = LoadStep(normal_force=LOAD, increments=4)


def scene(*steps: LoadStep, **more: Any) -> Scene:
    """A rigid ball on a soft body."""
    return Scene(
        **{
            "indenter": Paraboloid(radius=1.0, material=RIGID),
            "body": Body(material=SOFT),
            "friction": CoulombFriction(coefficient=FRICTION),
            "loading": (PRESS, *steps),
        }
        | more
    )


def push(x: float, y: float, increments: int = 3) -> LoadStep:
    """To shares of µW along x and y."""
    return LoadStep(tangential_force=(x * LIMIT, y * LIMIT), increments=increments)


def rough(asked: Scene, **how: Any) -> radial.Result:
    """On half the rings, which obey the same laws."""
    plan = how.pop("plan", None) or radial.plan(asked)
    return radial.solve(asked, plan=replace(plan, fineness=0.5), **how)


def test_all_around_the_whole_circle_is_the_half_and_its_mirror_image() -> None:
    asked = scene(push(0.6, 0.0), push(0.0, 0.0))
    half = rough(asked)
    whole = rough(asked, plan=replace(half.plan, circle=RingAngles.WHOLE))
    for one, other in zip(half.increments, whole.increments, strict=True):
        for name in ("approach", "stick_radius", "tangential_shift", "dissipated_energy"):
            scale = np.max(np.abs(getattr(one, name)))
            assert_allclose(getattr(other, name), getattr(one, name), atol=1e-10 * scale)
        if one.pressure.ndim > 1:
            assert_allclose(
                other.pressure[:, : one.pressure.shape[1]],
                one.pressure,
                atol=1e-9 * one.peak_pressure,
            )


@pytest.mark.parametrize(
    ("circle", "vector"), [(RingAngles.HALF, (0.8, 0.0)), (RingAngles.WHOLE, (0.8, -0.6))]
)
def test_a_vector_that_is_the_same_everywhere_remains_so_between_points(
    circle: RingAngles, vector: tuple[float, float]
) -> None:
    """On the axis as well, where all angles have one vector; splines of 8 angles err by 1e-3."""
    asked = scene()
    found = create_points(Coupling.of(asked), asked.indenter, [RADIUS], 6, 4, circle, FRICTION)

    def components(angles: np.ndarray) -> np.ndarray:
        cos, sin = np.cos(angles), np.sin(angles)
        return np.stack([np.dot(vector, (cos, sin)), np.dot(vector, (-sin, cos))])

    at_points = np.tile(components(found.angles), len(found.radii))
    expected = components(found.output_angles)
    for one, other in zip(
        TangentialSteps._interpolate_vector(found, at_points), expected, strict=True
    ):
        assert_allclose(one, np.broadcast_to(other, one.shape), atol=2e-3)


TOLERANCE = 1e-9
RING_LOAD = 4 / 3  # of a ball with R = 1 on E* = 1: a = 1
LAW = CoulombFriction(coefficient=FRICTION)


@cache
def alike() -> ContactPoints:
    """Two bodies of one material without lateral contraction: uncoupled, and slip along shear."""
    material = IsotropicMaterial(young_modulus=2.0, poisson_ratio=0.0)
    ball = Paraboloid(radius=1.0, material=material)
    asked = scene(indenter=ball, body=Body(material=material))
    return create_points(Coupling.of(asked), ball, [1.0], 16, 4, RingAngles.HALF, FRICTION)


@cache
def pressed() -> PointState:
    loads = Loads((0.0, None, None, RING_LOAD), (None, 0.0, 0.0, None))
    return solve_increment(alike(), LAW, loads, None, TOLERANCE)


def test_a_first_guess_has_pressure_where_the_surfaces_overlap() -> None:
    led = Loads((None, None, None, None), (0.0, 0.0, 0.0, 0.5))
    *_, p = RingProblem.of(alike(), LAW, led, None).guess_closed_gap()[:-4].reshape(3, -1)
    assert np.array_equal(p > 0, alike().gap_areas < 0.5 * alike().areas)


def test_a_contact_beyond_the_rings_is_refused() -> None:
    loads = Loads((0.0, None, None, 4 * RING_LOAD), (None, 0.0, 0.0, None))
    with pytest.raises(ContactAtZoneEdge, match="last ring"):
        solve_increment(alike(), LAW, loads, None, TOLERANCE)


def test_one_angle_says_all_of_what_is_the_same_all_around() -> None:
    points = alike()
    still = Loads((None, None, None, RING_LOAD), (0.0, 0.0, 0.0, None))
    turned = solve_increment(points.axisymmetric, LAW, still, None, TOLERANCE).repeat_angles(points)
    assert_allclose(turned.tractions, pressed().tractions, atol=1e-7)
    assert_allclose(turned.moved, pressed().moved, atol=1e-9)
