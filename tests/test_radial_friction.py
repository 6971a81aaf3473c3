"""Pressing with friction by the radial solver: reference contacts, laws, and other solvers."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from contact_scenes import RIGID_BALL, YOUNG, A, steel
from numpy.testing import assert_allclose

import radial
from contact_errors.on_radii import stated_errors
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
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import NotConverged
from radial.frictional.rings import (
    OUTSIDE,
    rings_about,
)
from verification.problems.indentation import STRONG, WEAK, Indentation

# Of half-spaces with E* = 1 below a ball with R = 1, so that a = W = 1 are of a kind.
SOFT = IsotropicMaterial(young_modulus=0.91, poisson_ratio=0.3)
BALL = Paraboloid(radius=1.0, material=RIGID)


def scene(
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


# ---- rings ------------------------------------------------------------------------------------


@pytest.mark.parametrize("front", [0.001, 0.2, 0.95])
def test_half_spaces_answer_the_pressure_of_hertz_as_hertz_says(front: float) -> None:
    """√(1-x²) is among the tractions of the rings, whatever these are."""
    rings = rings_about(front, 64)
    x = rings.places
    p = np.sqrt(np.maximum(1 - x[: rings.count] ** 2, 0.0))
    inside, outside = x <= 1, x > 1
    lifted, drawn = rings.logarithmic[0] @ p, rings.sideways[1] @ p
    assert_allclose(lifted[inside], math.pi / 8 * (2 - x[inside] ** 2), rtol=2e-8)
    y = OUTSIDE
    beyond = ((2 - y**2) * np.arcsin(1 / y) + np.sqrt(y**2 - 1)) / 4
    assert_allclose(lifted[outside], beyond, rtol=2e-8)
    carried = -np.expm1(1.5 * np.log1p(-(np.minimum(x, 1 - 1e-16) ** 2))) / 3
    assert_allclose(drawn[1:], carried[1:] / x[1:], rtol=1e-7)


# ---- references -------------------------------------------------------------------------------


# ---- laws -------------------------------------------------------------------------------------

UP_AND_DOWN = (LoadStep(normal_force=1e-3, increments=4), LoadStep(normal_force=3e-4, increments=3),
               LoadStep(approach=0.01, increments=3))  # fmt: skip


def test_bodies_that_change_places_have_shear_of_the_other_sign() -> None:
    """A rigid body below an elastic ball is the mirror image."""
    elastic = Paraboloid(radius=1.0, material=SOFT)
    below = radial.solve(scene()).steps[0]
    above = radial.solve(scene(body=Body(material=RIGID), indenter=elastic)).steps[0]
    assert_allclose(above.approach, below.approach, rtol=1e-12)
    assert below.shear_radial is not None
    assert above.shear_radial is not None
    assert_allclose(above.shear_radial, -below.shear_radial, atol=1e-12)
    assert np.max(below.shear_radial) > 0


@pytest.mark.parametrize("body", [None, coated(2.0, 0.1)], ids=["bare", "coated"])
def test_shear_is_within_its_limit_and_energy_is_lost_whatever_the_load_does(
    body: Body | None,
) -> None:
    result = radial.solve(scene(*UP_AND_DOWN, body=body))
    lost = 0.0
    for end in result.increments:
        assert end.shear_radial is not None
        assert end.dissipated_energy is not None
        assert end.in_stick is not None
        limit = 0.2 * end.pressure
        assert np.all(np.abs(end.shear_radial) <= limit + 1e-9 * end.peak_pressure)
        slides = end.in_contact & ~end.in_stick
        missed = np.abs(np.abs(end.shear_radial[slides]) / limit[slides] - 1) > 1e-6
        assert np.sum(missed) <= 2  # between rings there are fronts
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
    sticky = scene(
        LoadStep(normal_force=1e3, increments=8),
        body=Body(material=IsotropicMaterial(young_modulus=3e9 / 0.013, poisson_ratio=0.0)),
        friction=2.0,
        indenter=Paraboloid(radius=0.018, material=RIGID),
    )
    assert radial.solve(sticky).steps[0].approach == pytest.approx(8.089263338e-6, rel=1.5e-3)


# ---- errors, standing and refusals ------------------------------------------------------------


@pytest.mark.parametrize("one", [WEAK, STRONG], ids=lambda one: one.file_name)
def test_stated_errors_hold_the_true_ones(one: Indentation) -> None:
    result = radial.solve(one.problem(16).scene)
    end, errors = result.steps[0], stated_errors(result).steps[0]
    assert errors["normal_force"].status == "exact"
    front = one.stick_part * one.contact_radius
    for name, exact in (
        ("approach", one.approach), ("contact_radius", one.contact_radius), ("stick_radius", front)
    ):  # fmt: skip
        error = errors[name].error
        assert isinstance(error, float)
        assert abs(getattr(end, name) - exact) < error < 0.1 * exact


def test_slip_that_is_narrower_than_rings_is_told_by_its_name() -> None:
    """All but the edge sticks; and the coefficient is named, which is what helps."""
    base, film = steel(0.0), steel(young_modulus=2 * YOUNG)
    asked = Scene(
        indenter=RIGID_BALL,
        body=Body(material=base, layers=(Layer(thickness=A, material=film),)),
        friction=CoulombFriction(coefficient=5.0),
        loading=(LoadStep(normal_force=1e3, increments=4),),
    )
    with pytest.raises(NotConverged, match="coefficient of friction of 5 lets none slip but in"):
        radial.solve(asked)
    weaker = asked.model_copy(update={"friction": CoulombFriction(coefficient=2.0)})
    assert radial.solve(weaker).steps[0].stick_radius is not None
