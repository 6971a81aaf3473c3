"""How much of a circle the radial solver takes, and what its points know: compliances, twists in
closed form, films."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from turning_contacts import (
    ALIKE,
    FRICTION,
    LIMIT,
    LOAD,
    RADIUS,
    SOFT,
    at_points,
    points,
    push,
    rough,
    scene,
    twist,
)

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
)
from contact_scene.solver_errors import UnsupportedScene
from radial.circle import Circle
from radial.coupling import Coupling
from radial.ring_layout import laid

CALLED_FOR = {
    "pressed": ((), {}, None),
    "twisted, alike": ((twist(0.4),), ALIKE, None),
    "twisted, then pressed": ((twist(0.4), LoadStep(normal_force=2 * LOAD)), ALIKE, Circle.ONE),
    "twisted, coupled": ((twist(0.4),), {}, Circle.ONE),
    "pushed": ((push(0.4, 0.0), push(-0.4, 0.0)), {}, Circle.HALF),
    "pushed, free to turn": (
        (LoadStep(tangential_force=(0.1 * LIMIT, 0.0), torque=0.0),), {}, Circle.HALF,
    ),
    "pushed and twisted": ((push(0.4, 0.0), twist(0.1)), ALIKE, Circle.WHOLE),
    "turning": ((push(0.4, 0.0), push(0.0, 0.4)), {}, Circle.WHOLE),
}  # fmt: skip


@pytest.mark.parametrize("name", CALLED_FOR)
def test_angles_are_those_that_loads_call_for(name: str) -> None:
    steps, bodies, circle = CALLED_FOR[name]
    assert radial.plan(scene(*steps, **bodies)).circle is circle


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"friction": CoulombFriction(coefficient=0.0)}, "coefficient of friction is zero"),
        ({"indenter": FlatPunch(radius=RADIUS, material=RIGID)}, "rim"),
    ],
)
def test_what_points_do_not_have_is_refused_by_name(more: dict[str, Any], words: str) -> None:
    led = LoadStep(tangential_shift=(1e-6, 0.0)), LoadStep(twist=1e-4)
    with pytest.raises(UnsupportedScene, match=words):
        radial.plan(scene(*led, **more))


def test_all_around_the_whole_circle_is_the_half_and_its_mirror_image() -> None:
    asked = scene(push(0.6, 0.0), push(0.0, 0.0))
    half = rough(asked)
    whole = rough(asked, plan=replace(half.plan, circle=Circle.WHOLE))
    for one, other in zip(half.increments, whole.increments, strict=True):
        for name in ("approach", "contact_radius", "tangential_shift", "dissipated_energy"):
            scale = np.max(np.abs(getattr(one, name)))
            assert_allclose(getattr(other, name), getattr(one, name), atol=1e-10 * scale)
        if one.pressure.ndim > 1:
            assert_allclose(other.pressure[:, : one.pressure.shape[1]], one.pressure,
                            atol=1e-9 * one.peak_pressure)  # fmt: skip


@pytest.mark.parametrize("circle", Circle)
def test_compliances_are_positive_and_the_same_both_ways(circle: Circle) -> None:
    found = points(circle).compliance if circle is not Circle.ONE else points(Circle.HALF).round
    matrix = found if isinstance(found, np.ndarray) else found.compliance
    assert_allclose(matrix, matrix.T, atol=1e-14 * np.max(matrix))
    assert np.min(np.linalg.eigvalsh(matrix)) > 0


def test_torsion_twists_the_surface_by_the_shear_modulus_alone() -> None:
    """Reissner and Sagoci 1944: q = 3 M r/(4π a³ √(a² - r²)) turns a disc by 3 M/(16 G a³); in the
    mean, by the work it does, so that its edge needs no hats: here 2G φ r = ∫ q, q linear."""
    ring = points(Circle.WHOLE)
    shear = np.zeros((3, len(ring.radii), ring.count))
    shear[1] = ring.radii[:, None]
    moved = (ring.compliance @ shear.ravel()).reshape(shear.shape)
    assert np.max(np.abs(moved[[0, 2]])) < 1e-12 * np.max(moved[1])
    stiffer = Body(material=IsotropicMaterial(young_modulus=0.7, poisson_ratio=0.0))
    other = laid(
        Coupling.of(scene(body=stiffer)), scene().indenter, [RADIUS], 6, 4, Circle.WHOLE, FRICTION
    )
    assert_allclose((other.compliance @ shear.ravel()).reshape(shear.shape), moved, rtol=1e-9,
                    atol=1e-12 * np.max(moved))  # fmt: skip


@pytest.mark.parametrize("modulus", [0.2, 4.0])
def test_points_twist_films_as_the_solver_without_points_does(modulus: float) -> None:
    """Ball and body alike, coated both: they do not couple."""
    film = IsotropicMaterial(young_modulus=modulus * 0.91, poisson_ratio=0.3)
    layers = (Layer(thickness=RADIUS / 2, material=film),)
    asked = scene(
        twist(0.4), body=Body(material=SOFT, layers=layers),
        indenter=Paraboloid(radius=1.0, material=SOFT, layers=layers),
    )  # fmt: skip
    known = radial.solve(asked)
    found = at_points(asked.model_dump_json()).steps[1]
    assert known.plan.circle is None
    assert_allclose(found.twist, known.steps[1].twist, rtol=5e-4)
    assert_allclose(found.contact_radius, known.steps[1].contact_radius, rtol=1e-3)
    at = found.radii < 0.9 * found.contact_radius
    shear = np.interp(found.radii[at], known.steps[1].radii, known.steps[1].shear_circumferential)
    # Rings of 1/64 of the radius about the front, where shear has a corner.
    assert np.mean(np.abs(found.shear_circumferential[at] - shear)) < 0.01 * np.max(shear)
