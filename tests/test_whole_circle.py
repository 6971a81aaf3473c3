"""Tests of finite elements at points on the whole circle: turned loads, a rig, and stress."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from contact_scenes import PRESS, RADIUS, RIGID_BALL, A, push, scene, steel
from fem_scenes import elements, solved

import radial
from contact_scene import Body, Layer, RadialDiscretisation, Scene
from contact_scene.rig import Rig
from fem_reference import Increment, Path, Result, plan
from fem_reference.compliance.angular_grid import AngularGrid, end_grid, whole_grid
from fem_reference.contact.method import ContactMethod
from fem_reference.expected_radius import meshed_radius
from fem_reference.history import solved_increments
from fem_reference.model import ContactModel
from fem_reference.stress import SurfaceTractions, subsurface

PRESSED = {**PRESS, "increments": 4}
COATED = Body(material=steel(), layers=(Layer(thickness=A, material=steel(0.3, 1e12)),))


TURNED = (push(0.5, increments=4), push(0.5 / 2**0.5, 0.5 / 2**0.5, increments=4))


def coated(*loading) -> Scene:
    return scene(*loading, indenter=RIGID_BALL).model_copy(update={"body": COATED})


@cache
def example() -> Result:
    return solved(coated(PRESSED, *TURNED), 8, harmonics=4)


def on_grid(of: Scene, path: Path, grid: AngularGrid, **changes) -> list[Increment]:
    """Increments of a scene on the points of a grid, along another path than that of its plan."""
    model = ContactModel.of(of, elements(8), meshed_radius(of, None))
    method = ContactMethod(model, replace(plan(of), path=path, **changes), around=grid)
    return list(solved_increments(method, 1e-10))


SHARED = ("pressure", "gap", "shear_radial", "shear_circumferential", "slip_radial", "in_stick")
SCALARS = ("approach", "contact_radius", "stick_radius", "dissipated_energy")


@pytest.mark.parametrize("bodies", [{}, {"indenter": RIGID_BALL}], ids=["uncoupled", "coupled"])
def test_loads_on_one_line_are_those_of_the_half_circle(bodies):
    of = scene(PRESSED, push(0.6, increments=2), push(-0.3, increments=2), **bodies)
    half = on_grid(of, Path.HARMONICS, end_grid(4))
    whole = on_grid(of, Path.WHOLE_CIRCLE, whole_grid(4))
    assert len(half) == len(whole) > 4
    for one, other in zip(half, whole, strict=True):
        for name in SHARED:
            a, b = getattr(one, name), getattr(other, name)
            if a is None or one.angles is None:
                continue
            size = max(float(np.max(np.abs(a))), 1e-12 * A)
            np.testing.assert_allclose(b[:, :5], a, atol=1e-9 * size, err_msg=name)
        for name in SCALARS:
            assert getattr(other, name) == pytest.approx(getattr(one, name), rel=1e-9, abs=1e-15)
        assert other.tangential_shift == pytest.approx(one.tangential_shift, rel=1e-9, abs=1e-18)


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
