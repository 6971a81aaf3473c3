"""Tests of friction on rings: full stick, slip narrower than a ring, and refusals."""

from dataclasses import replace

import pytest
from contact_scenes import YOUNG, A, steel
from coupled_scenes import bulk, press, push, scene

import radial
from contact_scene import Body, CoulombFriction, IsotropicMaterial, Layer
from contact_scene.solver_errors import NotConverged, UnsupportedScene
from slipstick import stated_errors


def test_an_annulus_of_slip_that_no_ring_sees_is_refused_by_name():
    pushed = push(0.3, friction=0.3, increments=4)
    sticky = scene(press(increments=4), pushed, body=bulk(), friction=50.0)
    with pytest.raises(UnsupportedScene, match="narrower than a ring"):
        radial.solve(sticky, plan=replace(radial.plan(sticky), fineness=0.5))


def test_a_ball_that_all_but_sticks_is_as_deep_as_one_that_does():
    """Rings begin to slip one at a time, more of them than Newton's method has steps elsewhere.
    Spence 1968, by superposition of bonded punches: δ = 8.089263338 µm."""
    base = IsotropicMaterial(young_modulus=3e9 / 0.013, poisson_ratio=0.0)
    sticky = scene(press(increments=8), body=Body(material=base), friction=2.0)
    assert radial.solve(sticky).steps[0].approach == pytest.approx(8.089263338e-6, rel=1.5e-3)


def test_slip_that_is_narrower_than_rings_is_told_by_its_name():
    """All but the edge sticks; and the coefficient is named, which is what helps."""
    film = Layer(thickness=A, material=steel(young_modulus=2 * YOUNG))
    body = Body(material=steel(0.0), layers=(film,))
    asked = scene(press(increments=4), body=body, friction=5.0)
    with pytest.raises(NotConverged, match="coefficient of friction of 5 only the last") as ended:
        radial.solve(asked)
    assert ended.value.tolerance == 0.0 < ended.value.residual
    weaker = asked.model_copy(update={"friction": CoulombFriction(coefficient=2.0)})
    assert radial.solve(weaker).steps[0].stick_radius is not None


def test_a_stick_zone_within_the_first_ring_leaves_numbers_open():
    """Friction of pressing alone slides nothing as a whole: the axis sticks. Without the push, the
    other method resolves peak and radius; rings at the same edge do not show their error."""
    loads = press(increments=4), push(0.3, friction=0.01)
    pushed = radial.solve(scene(*loads, body=bulk(0.4), friction=0.01))
    (alone,) = radial.solve(scene(*loads[:1], body=bulk(0.4), friction=0.01)).steps
    assert [end.status for end in pushed.steps] == ["no stick area left", "partial slip"]
    errors = stated_errors(pushed).steps[0]
    assert errors["peak_pressure"].status == "not converged"
    missed = abs(alone.contact_radius - pushed.steps[0].contact_radius)
    assert 1e-5 * A < missed < errors["contact_radius"].error < 1e-3 * A
