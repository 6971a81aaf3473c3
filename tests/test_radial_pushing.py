"""Tests of friction on rings: full stick, slip narrower than a ring, and refusals."""

from __future__ import annotations

from dataclasses import replace

import pytest
from contact_scenes import RIGID_BALL, YOUNG, A, steel

import radial
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.solver_errors import NotConverged, UnsupportedScene

# Of half-spaces with E* = 1 below a ball with R = 1, so that a = W = 1 are of a kind.
SOFT = IsotropicMaterial(young_modulus=0.91, poisson_ratio=0.3)
RADIUS = 0.01
LOAD = 4 / 3 * RADIUS**3
FRICTION = 0.3
PRESS = LoadStep(normal_force=LOAD, increments=4)
PUSH = LoadStep(tangential_force=(0.3 * FRICTION * LOAD, 0.0), increments=4)


def scene(*steps: LoadStep, friction: float = FRICTION) -> Scene:
    return Scene(
        indenter=Paraboloid(radius=1.0, material=RIGID),
        body=Body(material=SOFT),
        friction=CoulombFriction(coefficient=friction),
        loading=steps,
    )


def test_an_annulus_of_slip_that_no_ring_sees_is_refused_by_name() -> None:
    sticky = scene(PRESS, PUSH, friction=50.0)
    with pytest.raises(UnsupportedScene, match="narrower than a ring"):
        radial.solve(sticky, plan=replace(radial.plan(sticky), fineness=0.5))


def test_a_ball_that_all_but_sticks_is_as_deep_as_one_that_does() -> None:
    """Rings begin to slip one at a time, more of them than Newton's method has steps elsewhere.
    Spence 1968, by superposition of bonded punches: δ = 8.089263338 µm."""
    base = IsotropicMaterial(young_modulus=3e9 / 0.013, poisson_ratio=0.0)
    sticky = Scene(
        indenter=RIGID_BALL,
        body=Body(material=base),
        friction=CoulombFriction(coefficient=2.0),
        loading=(LoadStep(normal_force=1e3, increments=8),),
    )
    assert radial.solve(sticky).steps[0].approach == pytest.approx(8.089263338e-6, rel=1.5e-3)


def test_slip_that_is_narrower_than_rings_is_told_by_its_name() -> None:
    """All but the edge sticks; and the coefficient is named, which is what helps."""
    base, film = steel(0.0), steel(young_modulus=2 * YOUNG)
    asked = Scene(
        indenter=RIGID_BALL,
        body=Body(material=base, layers=(Layer(thickness=A, material=film),)),
        friction=CoulombFriction(coefficient=5.0),
        loading=(LoadStep(normal_force=1e3, increments=4),),
    )
    with pytest.raises(NotConverged, match="coefficient of friction of 5 only the last") as ended:
        radial.solve(asked)
    assert ended.value.tolerance == 0.0 < ended.value.residual
    weaker = asked.model_copy(update={"friction": CoulombFriction(coefficient=2.0)})
    assert radial.solve(weaker).steps[0].stick_radius is not None
