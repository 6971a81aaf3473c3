"""Tests of tangential loads by the radial solver: Cattaneo-Mindlin, Masing, and general laws."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from contact_scenes import RIGID_BALL, YOUNG, A, steel
from numpy.testing import assert_allclose

import radial
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    FlatPunch,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import GrossSliding, NotConverged, UnsupportedScene
from radial.frictional.rings import (
    OUTSIDE,
    rings_for_stick_radius,
)
from verification.closed_forms.cattaneo_mindlin import PartialSlip

# Two alike: E* = 1, and what shear feels of them, 1/G* = Σ (2 - ν)/4G.
ALIKE = IsotropicMaterial(young_modulus=2 * 0.91, poisson_ratio=0.3)
SOFT = IsotropicMaterial(young_modulus=0.91, poisson_ratio=0.3)
# of a ball with R = 1 and E* = 1: a = 1/100
LOAD = 4 / 3e6
FRICTION = 0.3
RADIUS = 0.01
LIMIT = LOAD * FRICTION
SHEAR = 2 * ALIKE.shear_modulus / (2 - ALIKE.poisson_ratio)
VIRGIN = PartialSlip(LOAD, RADIUS, FRICTION, SHEAR, 0.0)


def scene(
    *steps: LoadStep, alike: bool = False, body: Body | None = None, indenter: Any = None
) -> Scene:
    material = ALIKE if alike else SOFT
    ball = Paraboloid(radius=1.0, material=ALIKE if alike else RIGID)
    return Scene(
        indenter=indenter or ball,
        body=body or Body(material=material),
        friction=CoulombFriction(coefficient=FRICTION),
        loading=steps,
    )


PRESS = LoadStep(normal_force=LOAD, increments=4)


def push(share: float, increments: int = 4, angle: float = 0.0) -> LoadStep:
    """To a share of µW."""
    T = share * LIMIT
    force = (T * math.cos(angle), T * math.sin(angle))
    return LoadStep(tangential_force=force, increments=increments)


def rough(asked: Scene, **how: Any) -> radial.Result:
    """On half the rings, which obey the same laws."""
    plan = how.pop("plan", None) or radial.plan(asked)
    return radial.solve(asked, plan=replace(plan, fineness=0.5), **how)


def test_a_far_shift_slides_under_all_that_friction_carries() -> None:
    far = LoadStep(tangential_shift=(3 * VIRGIN.sliding_shift, 0.0), increments=8)
    end = rough(scene(PRESS, far, alike=True)).steps[1]
    assert end.tangential_force is not None
    assert_allclose(end.tangential_force[0], LIMIT, rtol=1e-8)
    assert end.stick_radius == 0
    assert end.status is ContactStatus.GROSS_SLIDING


VALUES = np.linspace(0.1, 0.2, 16).reshape(4, 4)
MAP = CoulombFriction.model_validate({"coefficient": {"map": VALUES, "spacing": 1.0}})
REFUSED: dict[str, dict[str, Any]] = {
    "map": {"friction": MAP},
    "rim": {"indenter": FlatPunch(radius=RADIUS, material=RIGID)},
    "moment or a tilt": {"loading": (PRESS, LoadStep(tilt=(1e-4, 0.0)), push(0.3))},
}


@pytest.mark.parametrize("reason", REFUSED)
def test_what_points_do_not_have_is_refused_by_name(reason: str) -> None:
    asked = scene(PRESS, LoadStep(tangential_shift=(1e-6, 0.0))).model_copy(update=REFUSED[reason])
    with pytest.raises(UnsupportedScene, match=reason):
        radial.plan(asked)


@pytest.mark.parametrize("alike", [False, True], ids=["coupled", "alike"])
def test_at_the_friction_limit_all_points_carry_it_along_the_force(alike: bool) -> None:
    """Below the limit by less than a solver can tell, the shear is smaller by this part; θ = 0 is
    the direction of the force."""
    *_, end = rough(scene(PRESS, push(-(1 - 5e-10), 2), alike=alike)).steps
    assert end.angles is not None
    limit = FRICTION * end.pressure
    along = end.shear_radial * np.cos(end.angles) - end.shear_circumferential * np.sin(end.angles)
    # Output angles lie between the points: their shear is interpolated.
    assert along == pytest.approx(limit, abs=0.02 * np.max(limit))
    assert end.status is ContactStatus.GROSS_SLIDING
    assert (end.tangential_shift, end.dissipated_energy, end.stick_radius) == (None, None, 0)


@pytest.mark.parametrize("alike", [False, True], ids=["coupled", "alike"])
def test_an_approach_that_no_longer_carries_the_force_is_refused_by_name(alike: bool) -> None:
    """Half the approach presses with a third of the load, below which T = .6 µW slides."""
    less = LoadStep(approach=0.5 * RADIUS**2, increments=1)
    with pytest.raises(GrossSliding, match=r"step 3.*force 2\.4e-07 N exceeds .* 1\.[34]"):
        rough(scene(PRESS, push(-0.6), less, alike=alike))


def test_an_annulus_of_slip_that_no_ring_sees_is_refused_by_name() -> None:
    sticky = scene(PRESS, push(0.6)).model_copy(
        update={"friction": CoulombFriction(coefficient=50.0)}
    )
    with pytest.raises(UnsupportedScene, match="narrower than a ring"):
        rough(sticky)


# Of half-spaces with E* = 1 below a ball with R = 1, so that a = W = 1 are of a kind.
BALL = Paraboloid(radius=1.0, material=RIGID)


def indented_scene(
    *steps: LoadStep, body: Body | None = None, friction: float = 0.2, indenter: Any = BALL
) -> Scene:
    return Scene(
        indenter=indenter,
        body=body or Body(material=SOFT),
        friction=CoulombFriction(coefficient=friction),
        loading=steps or (LoadStep(normal_force=1e-3, increments=4),),
    )


def coated(stiffness: float, thickness: float) -> Body:
    film = IsotropicMaterial(young_modulus=0.91 * stiffness, poisson_ratio=0.3)
    return Body(material=SOFT, layers=(Layer(thickness=thickness, material=film),))


@pytest.mark.parametrize("front", [0.001, 0.2, 0.95])
def test_half_spaces_answer_the_pressure_of_hertz_as_hertz_says(front: float) -> None:
    """√(1-x²) is among the tractions of the rings, whatever these are."""
    rings = rings_for_stick_radius(front, 64)
    x = rings.places
    p = np.sqrt(np.maximum(1 - x[: rings.count] ** 2, 0.0))
    inside, outside = x <= 1, x > 1
    lifted, drawn = rings.direct_responses[0] @ p, rings.coupling_responses[1] @ p
    assert_allclose(lifted[inside], math.pi / 8 * (2 - x[inside] ** 2), rtol=2e-8)
    y = OUTSIDE
    beyond = ((2 - y**2) * np.arcsin(1 / y) + np.sqrt(y**2 - 1)) / 4
    assert_allclose(lifted[outside], beyond, rtol=2e-8)
    carried = -np.expm1(1.5 * np.log1p(-(np.minimum(x, 1 - 1e-16) ** 2))) / 3
    assert_allclose(drawn[1:], carried[1:] / x[1:], rtol=1e-7)


UP_AND_DOWN = (
    LoadStep(normal_force=1e-3, increments=4),
    LoadStep(normal_force=3e-4, increments=3),
    LoadStep(approach=0.01, increments=3),
)


def test_bodies_that_change_places_have_shear_of_the_other_sign() -> None:
    """A rigid body below an elastic ball is the mirror image."""
    elastic = Paraboloid(radius=1.0, material=SOFT)
    below = radial.solve(indented_scene()).steps[0]
    above = radial.solve(indented_scene(body=Body(material=RIGID), indenter=elastic)).steps[0]
    assert_allclose(above.approach, below.approach, rtol=1e-12)
    assert below.shear_radial is not None
    assert above.shear_radial is not None
    assert_allclose(above.shear_radial, -below.shear_radial, atol=1e-12)
    assert np.max(below.shear_radial) > 0


@pytest.mark.parametrize("body", [None, coated(2.0, 0.1)], ids=["bare", "coated"])
def test_shear_is_within_its_limit_and_energy_is_lost_whatever_the_load_does(
    body: Body | None,
) -> None:
    result = radial.solve(indented_scene(*UP_AND_DOWN, body=body))
    lost = 0.0
    for end in result.increments:
        assert end.shear_radial is not None
        assert end.dissipated_energy is not None
        assert end.in_stick is not None
        limit = 0.2 * end.pressure
        assert np.all(np.abs(end.shear_radial) <= limit + 1e-9 * end.peak_pressure)
        slides = end.in_contact & ~end.in_stick
        missed = np.abs(np.abs(end.shear_radial[slides]) / limit[slides] - 1) > 1e-6
        # A ring between a sticking and a slipping node counts as slipping.
        assert np.sum(missed) <= np.count_nonzero(np.diff(end.in_stick[end.in_contact]))
        assert end.dissipated_energy >= lost
        assert np.all(end.gap >= 0)
        assert end.status is ContactStatus.PARTIAL_SLIP
        lost = end.dissipated_energy
    unloaded = result.steps[1]
    assert unloaded.shear_radial is not None
    assert np.min(unloaded.shear_radial) < 0 < np.max(unloaded.shear_radial)


def test_a_ball_that_all_but_sticks_is_as_deep_as_one_that_does() -> None:
    """Rings begin to slip one at a time, more of them than Newton's method has steps elsewhere.
    Spence 1968, by superposition of bonded punches: δ = 8.089263338 µm."""
    sticky = indented_scene(
        LoadStep(normal_force=1e3, increments=8),
        body=Body(material=IsotropicMaterial(young_modulus=3e9 / 0.013, poisson_ratio=0.0)),
        friction=2.0,
        indenter=Paraboloid(radius=0.018, material=RIGID),
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
    with pytest.raises(NotConverged, match="coefficient of friction of 5 only the last"):
        radial.solve(asked)
    weaker = asked.model_copy(update={"friction": CoulombFriction(coefficient=2.0)})
    assert radial.solve(weaker).steps[0].stick_radius is not None
