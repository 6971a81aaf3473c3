"""Tests of finite elements at points on the whole circle: turned loads, a rig, and stress."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from contact_scenes import PRESS, RADIUS, RIGID_BALL, A, push, scene, steel
from fem_scenes import elements, solved

import radial
from contact_scene import Body, Layer, RadialDiscretisation
from contact_scene.rig import Rig
from fem_reference import Result
from fem_reference.stress import SurfaceTractions, subsurface

PRESSED = {**PRESS, "increments": 4}
COATED = Body(material=steel(), layers=(Layer(thickness=A, material=steel(0.3, 1e12)),))


TURNED = (push(0.5, increments=4), push(0.5 / 2**0.5, 0.5 / 2**0.5, increments=4))


@cache
def example() -> Result:
    ball = scene({**PRESS, "increments": 1}, *TURNED, indenter=RIGID_BALL)
    return solved(ball.model_copy(update={"body": COATED}), 6, harmonics=3)


def test_springs_of_a_rig_act_along_and_across_the_load():
    rig = Rig(normal_stiffness=2e8, tangential_stiffness=5e7)
    of = scene(PRESSED, *TURNED, indenter=RIGID_BALL).model_copy(update={"rig": rig})
    one = solved(of, 16, harmonics=6).steps[-1]
    other = radial.solve(of, RadialDiscretisation()).steps[-1]
    for name in ("tangential_shift", "actuator_shift", "actuator_approach"):
        assert getattr(one, name) == pytest.approx(getattr(other, name), rel=5e-3)
    assert one.elastic_energy == pytest.approx(other.elastic_energy, rel=2e-3)


def test_stress_below_turned_tractions_is_the_turned_stress():
    """Tractions turned by two points of a ring, and a uniform torsion."""
    end = example().steps[-1]
    own = SurfaceTractions.of(end)
    turned = replace(
        own,
        **{
            name: np.roll(getattr(own, name), 2, axis=1)
            for name in ("pressure", "shear_radial", "shear_circumferential")
        },
    )
    field, other = (subsurface(COATED, each, elements(4)) for each in (own, turned))
    step, peak = own.angles[2], end.peak_pressure
    for theta in (0.0, 1.0):
        np.testing.assert_allclose(
            other.stress(theta + step), field.stress(theta), atol=1e-9 * peak
        )
        np.testing.assert_allclose(
            other.displacement(theta + step), field.displacement(theta), atol=1e-9 * RADIUS
        )
