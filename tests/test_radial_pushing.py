"""Tangential loads by the radial solver: Cattaneo, Mindlin and Masing, and laws of any history."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import radial
from contact_errors.on_radii import stated_errors
from contact_results.surface import surface_of
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    FlatPunch,
    IsotropicMaterial,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import GrossSliding, UnsupportedScene
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.tangential_history import TangentialHistory

# Two alike: E* = 1, and what shear feels of them, 1/G* = Σ (2 - ν)/4G.
ALIKE = IsotropicMaterial(young_modulus=2 * 0.91, poisson_ratio=0.3)
SOFT = IsotropicMaterial(young_modulus=0.91, poisson_ratio=0.3)
LOAD, FRICTION = 4 / 3e6, 0.3  # of a ball with R = 1 and E* = 1: a = 1/100
RADIUS, LIMIT = 0.01, LOAD * FRICTION
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


@pytest.mark.parametrize(
    "steps",
    [
        (PRESS, push(0.6)),
        (PRESS, push(0.6), push(0.5, angle=0.6)),
        (PRESS, LoadStep(tangential_shift=(1e-5, 0.0), increments=4)),
    ],
    ids=["pushed", "turned", "sliding"],
)
def test_reported_shear_of_coupled_bodies_is_within_its_limit(steps: tuple[LoadStep, ...]) -> None:
    for one in radial.solve(scene(*steps)).increments:
        assert np.all(one.pressure >= 0)
        around = 0.0 if one.shear_circumferential is None else one.shear_circumferential
        excess = np.hypot(one.shear_radial, around) - FRICTION * one.pressure
        assert np.max(excess) <= 1e-14 * one.peak_pressure


@cache
def loop() -> radial.Result:
    """Of bodies that do not couple: pressed, and pushed to and fro."""
    return radial.solve(scene(PRESS, push(0.6), push(-0.6, 6), push(0.6, 6), alike=True))


@cache
def coupled() -> radial.Result:
    """A rigid ball on a soft body, pushed and back."""
    return rough(scene(PRESS, push(0.6), push(0.0)))


def rough(asked: Scene, **how: Any) -> radial.Result:
    """On half the rings, which obey the same laws."""
    plan = how.pop("plan", None) or radial.plan(asked)
    return radial.solve(asked, plan=replace(plan, fineness=0.5), **how)


# ---- closed forms -----------------------------------------------------------------------------


def test_shear_carries_the_load_and_obeys_coulomb() -> None:
    end, surface = loop().steps[1], surface_of(loop())
    shear = surface.vector(end, "shear")
    assert shear is not None
    assert_allclose(np.sum(shear[0] * surface.weights), 0.6 * LIMIT, rtol=2e-3)
    excess = np.hypot(*shear) - FRICTION * end.pressure
    assert np.max(excess) < 2e-3 * FRICTION * end.peak_pressure


def test_stated_errors_cover_the_closed_forms() -> None:
    exact, lost = TangentialHistory(VIRGIN), 0.0
    errors = stated_errors(loop())
    once = PartialSlip(LOAD, RADIUS, FRICTION, SHEAR, 0.6 * LIMIT)
    for end, stated, share in zip(
        loop().steps[1:], errors.steps[1:], (0.6, -0.6, 0.6), strict=True
    ):
        exact = exact.loaded_to(share * LIMIT)
        lost += (2 if lost else 1) * once.dissipated_energy
        for name, true in {
            "tangential_shift": exact.shift,
            "approach": RADIUS**2,
            "contact_radius": RADIUS,
            "stick_radius": once.stick_radius,
            "dissipated_energy": lost,
            "peak_pressure": 1.5 * LOAD / (math.pi * RADIUS**2),
        }.items():
            error, size = np.ravel(stated[name].error)[0], abs(true)
            assert abs(np.ravel(getattr(end, name))[0] - true) <= error < 0.15 * size, name


# ---- laws -------------------------------------------------------------------------------------


def test_a_far_shift_slides_under_all_that_friction_carries() -> None:
    far = LoadStep(tangential_shift=(3 * VIRGIN.sliding_shift, 0.0), increments=8)
    end = rough(scene(PRESS, far, alike=True)).steps[1]
    assert end.tangential_force is not None
    assert_allclose(end.tangential_force[0], LIMIT, rtol=1e-8)
    assert end.stick_radius == 0
    assert end.status is ContactStatus.GROSS_SLIDING


def test_slip_zone_of_an_earlier_step_is_that_where_a_pressed_contact_returns_to_its_limit() -> (
    None
):
    """More pressure lets all stick; without it the shear of the slip zone is at its limit again."""
    material = IsotropicMaterial(young_modulus=70e9, poisson_ratio=0.3)
    asked = Scene(
        indenter=Paraboloid(radius=10e-3, material=material),
        body=Body(material=material),
        friction=CoulombFriction(coefficient=0.3),
        loading=(
            LoadStep(normal_force=100.0),
            LoadStep(tangential_force=(12.0, 0.0)),
            LoadStep(normal_force=150.0),
            LoadStep(normal_force=100.0),
        ),
    )
    _, pushed, more, back = radial.solve(asked).steps
    assert more.status is ContactStatus.FULL_STICK
    assert back.status is ContactStatus.PARTIAL_SLIP
    assert back.stick_radius == pytest.approx(0.22702e-3, rel=1e-4)
    assert back.stick_radius == pytest.approx(pushed.stick_radius, rel=1e-8)
    assert_allclose(back.in_stick, pushed.in_stick)


# ---- contacts of few rings --------------------------------------------------------------------


# ---- a solve that goes on ---------------------------------------------------------------------


# ---- what is refused --------------------------------------------------------------------------

VALUES = np.linspace(0.1, 0.2, 16).reshape(4, 4)
MAP = CoulombFriction.model_validate({"coefficient": {"map": VALUES, "spacing": 1.0}})
REFUSED: dict[str, dict[str, Any]] = {
    "zero": {"friction": CoulombFriction(coefficient=0.0)},
    "map": {"friction": MAP},
    "rim": {"indenter": FlatPunch(radius=RADIUS, material=RIGID)},
    "moment or a tilt": {"loading": (PRESS, LoadStep(tilt=(1e-4, 0.0)), push(0.3))},
}


@pytest.mark.parametrize("reason", REFUSED)
def test_what_points_do_not_have_is_refused_by_name(reason: str) -> None:
    asked = scene(PRESS, LoadStep(tangential_shift=(1e-6, 0.0))).model_copy(update=REFUSED[reason])
    with pytest.raises(UnsupportedScene, match=reason):
        radial.plan(asked)


def test_more_than_friction_carries_is_refused() -> None:
    with pytest.raises(GrossSliding, match="step 2"):
        rough(scene(PRESS, push(1.0, 2), alike=True))


@pytest.mark.parametrize("alike", [False, True], ids=["coupled", "alike"])
def test_an_approach_that_no_longer_carries_the_force_is_refused_by_name(alike: bool) -> None:
    """Half the approach presses with a third of the load, below which T = .6 µW slides."""
    less = LoadStep(approach=0.5 * RADIUS**2, increments=1)
    with pytest.raises(GrossSliding, match=r"step 3.*T = 2\.4e-07 N is not below .* 1\.[34]"):
        rough(scene(PRESS, push(-0.6), less, alike=alike))


def test_an_annulus_of_slip_that_no_ring_sees_is_refused_by_name() -> None:
    sticky = scene(PRESS, push(0.6)).model_copy(
        update={"friction": CoulombFriction(coefficient=50.0)}
    )
    with pytest.raises(UnsupportedScene, match="narrower than a ring"):
        rough(sticky)
