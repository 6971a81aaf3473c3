"""Tests of the radial solver on points (r, θ): angular range and increments."""

from dataclasses import replace
from functools import cache

import contact_scenes
import numpy as np
import pytest
from contact_scenes import APPROACH, LOAD, A, hertz, paraboloid, steel
from coupled_scenes import bulk, press, push, scene
from numpy.testing import assert_allclose

import radial
from contact_scene import CoulombFriction
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

FRICTION = 0.3


def rough(asked, **how):
    """On half the rings, which obey the same laws."""
    plan = how.pop("plan", None) or radial.plan(asked)
    return radial.solve(asked, plan=replace(plan, fineness=0.5), **how)


def test_all_around_the_whole_circle_is_the_half_and_its_mirror_image():
    pushes = (push(part, friction=FRICTION, increments=3) for part in (0.6, 0.0))
    asked = scene(press(increments=4), *pushes, body=bulk(), friction=FRICTION)
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
def test_a_vector_that_is_the_same_everywhere_remains_so_between_points(circle, vector):
    """On the axis as well, where all angles have one vector; splines of 8 angles err by 1e-3."""
    asked = scene(press(), body=bulk())
    found = create_points(Coupling.of(asked), asked.indenter, [A], 6, 4, circle, FRICTION)

    def components(angles):
        cos, sin = np.cos(angles), np.sin(angles)
        return np.stack([np.dot(vector, (cos, sin)), np.dot(vector, (-sin, cos))])

    at_points = np.tile(components(found.angles), len(found.radii))
    expected = components(found.output_angles)
    for one, other in zip(
        TangentialSteps._interpolate_vector(found, at_points), expected, strict=True
    ):
        assert_allclose(one, np.broadcast_to(other, one.shape), atol=2e-3)


TOLERANCE = 1e-9
LAW = CoulombFriction(coefficient=FRICTION)


@cache
def alike() -> ContactPoints:
    """Two bodies of one material without lateral contraction: uncoupled, and slip along shear."""
    ball, body = paraboloid(steel(0.0)), steel(0.0)
    asked = contact_scenes.scene(press(), indenter=ball, body=body)
    radius = hertz(poisson_ratio=0.0).contact_radius
    return create_points(Coupling.of(asked), ball, [radius], 16, 4, RingAngles.HALF, FRICTION)


@cache
def pressed() -> PointState:
    loads = Loads((0.0, None, None, LOAD), (None, 0.0, 0.0, None))
    return solve_increment(alike(), LAW, loads, None, TOLERANCE)


def test_a_first_guess_has_pressure_where_the_surfaces_overlap():
    led = Loads((None, None, None, None), (0.0, 0.0, 0.0, 0.5 * APPROACH))
    *_, p = RingProblem.of(alike(), LAW, led, None).guess_closed_gap()[:-4].reshape(3, -1)
    assert np.array_equal(p > 0, alike().gap_areas < 0.5 * APPROACH * alike().areas)


def test_a_contact_beyond_the_rings_is_refused():
    loads = Loads((0.0, None, None, 4 * LOAD), (None, 0.0, 0.0, None))
    with pytest.raises(ContactAtZoneEdge, match="last ring"):
        solve_increment(alike(), LAW, loads, None, TOLERANCE)


def test_one_angle_says_all_of_what_is_the_same_all_around():
    points = alike()
    still = Loads((None, None, None, LOAD), (0.0, 0.0, 0.0, None))
    turned = solve_increment(points.axisymmetric, LAW, still, None, TOLERANCE).repeat_angles(points)
    peak = np.max(pressed().tractions)
    assert_allclose(turned.tractions, pressed().tractions, atol=1e-7 * peak)
    assert_allclose(turned.moved, pressed().moved, atol=1e-9 * APPROACH)
