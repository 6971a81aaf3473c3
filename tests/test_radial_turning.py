"""Torsion beside a push and pushes that turn, by the radial solver: laws, and what is shown."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import meshio
import numpy as np
import pytest
from numpy.testing import assert_allclose
from turning_contacts import (
    LIMIT,
    LOAD,
    PATH,
    PRESS,
    RADIUS,
    SOFT,
    TORQUE,
    beside,
    push,
    rough,
    scene,
    turned,
    turning,
    twist,
)

import radial
import slipstick
from contact_results.figures.map_panels import RingsAbove
from contact_results.files.surface_file import write_surface
from contact_results.stress.loaded_bodies import state_of_result, state_of_run
from contact_results.stress.on_disc import stress_on_disc
from contact_results.surface import Rings, surface_of
from contact_scene import Body, CoulombFriction, IsotropicMaterial, Layer, LoadStep
from contact_scene.solver_errors import UnsupportedScene

Pair = tuple[float, float]


@pytest.mark.parametrize(("angle", "line"), [(math.pi / 2, (1.0, 0.0)), (math.radians(217), None)])
def test_turned_loads_turn_all(angle: float, line: Pair | None) -> None:
    """By two of eight points with angles from the same line; by any angle with the line, too."""
    asked = scene(*(push(*turned(end, angle)) for end in PATH))
    plan = radial.plan(asked)
    other = rough(asked, plan=replace(plan, direction=line or plan.direction))
    size = math.hypot(*turning().steps[1].tangential_shift)
    for one, two in zip(turning().steps, other.steps, strict=True):
        assert_allclose(two.tangential_shift, turned(one.tangential_shift, angle),
                        atol=1e-10 * size)  # fmt: skip
        for name in ("approach", "contact_radius", "elastic_energy", "dissipated_energy"):
            assert_allclose(getattr(two, name), getattr(one, name), rtol=1e-10)


def test_mirrored_loads_mirror_all() -> None:
    """About x: what is along y and about z goes the other way."""
    other = rough(scene(twist(-0.4), push(0.5, 0.0), twist(0.3)))
    for one, two in zip(beside().steps, other.steps, strict=True):
        assert one.tangential_shift is not None
        assert two.tangential_shift is not None
        size = math.hypot(*beside().steps[2].tangential_shift)
        assert_allclose(two.tangential_shift, one.tangential_shift * np.array([1, -1]),
                        atol=1e-10 * size)  # fmt: skip
        assert two.twist == pytest.approx(-one.twist, rel=1e-10)
        assert two.torque == pytest.approx(-one.torque, rel=1e-12)
        assert two.dissipated_energy == pytest.approx(one.dissipated_energy, rel=1e-10)


def test_fields_carry_the_loads_and_obey_coulomb() -> None:
    end, surface = beside().steps[3], surface_of(beside())
    shear, (x, y) = surface.vector(end, "shear"), surface.positions
    assert shear is not None
    assert_allclose(np.sum(surface.weights), math.pi * end.radii[-1] ** 2, rtol=1e-12)
    assert_allclose(np.sum(shear * surface.weights, axis=(1, 2)), end.tangential_force,
                    atol=5e-3 * LIMIT)  # fmt: skip
    about = np.sum((shear[1] * x - shear[0] * y) * surface.weights)
    assert_allclose(about, end.torque, atol=5e-3 * TORQUE)
    assert max(step.residuals.friction_cone for step in beside().increments) < 1e-10
    assert end.residuals.torque_equilibrium < 1e-10
    assert surface.along(end.pressure).shape == (2 * len(end.radii),)


def test_motions_lead_where_their_loads_would() -> None:
    by_load = beside().steps
    led = LoadStep(
        twist=by_load[2].twist, tangential_shift=by_load[2].tangential_shift, increments=3
    )
    asked = scene(LoadStep(twist=by_load[1].twist, increments=3), led)
    end = rough(asked).steps[2]
    assert end.twist == by_load[2].twist
    assert end.tangential_force is not None
    assert_allclose(end.torque, by_load[2].torque, atol=0.05 * TORQUE)  # by another path
    assert_allclose(end.tangential_force, by_load[2].tangential_force, atol=0.05 * LIMIT)


@pytest.mark.parametrize(
    ("thickness", "share", "increments"), [(1.0, 0.2, 1), (0.2, 0.2, 2), (0.2, 0.3, 1)]
)
def test_a_twisted_ball_is_let_go_and_lifted_almost_wholly_at_once(
    thickness: float, share: float, increments: int
) -> None:
    """All slips on the way, and nothing tells how far no torque turns the ball."""
    lifted = LoadStep(normal_force=1e-6 * LOAD, increments=increments)
    film = Body(
        material=SOFT,
        layers=(Layer(thickness=thickness * RADIUS, material=_stiffer(2.0)),),
    )
    press = PRESS.model_copy(update={"increments": increments})
    steps = press, twist(share, increments), twist(0.0, increments), lifted
    asked = scene(loading=steps, body=film, friction=CoulombFriction(coefficient=0.1))
    *_, let_go, end = radial.solve(asked).steps
    assert end.torque == 0
    assert end.residuals.torque_equilibrium < 1e-10
    assert abs(end.twist) < 2 * abs(let_go.twist)


def _stiffer(times: float) -> IsotropicMaterial:
    return IsotropicMaterial(young_modulus=times * SOFT.young_modulus, poisson_ratio=0.3)


def test_stress_below_a_turning_push_is_refused_by_name() -> None:
    with pytest.raises(UnsupportedScene, match="load turns, or there is torsion beside it"):
        stress_on_disc(state_of_result(turning(), None), depths=[RADIUS])


def test_seen_from_above_the_circle_is_whole(tmp_path: Path) -> None:
    """Maps and the mesh of a run: shear carries the load on either, across the line, too."""
    result, surface = beside(), surface_of(beside())
    assert isinstance(surface, Rings)
    end, area = result.steps[3], 0.0
    above = RingsAbove.around_contact(result, surface)
    shear, area = above.vector(end, "shear"), (above.x[1] - above.x[0]) ** 2
    x, y = np.meshgrid(above.x, above.y, indexing="ij")
    assert shear is not None
    # Linear between eight rays, which cuts chords.
    assert_allclose(np.sum(shear, axis=(1, 2)) * area, end.tangential_force, atol=0.03 * LIMIT)
    about = np.sum(shear[1] * x - shear[0] * y) * area
    assert_allclose(about, end.torque, atol=0.01 * TORQUE)
    slipstick.save(result, tmp_path / "out")
    again = state_of_run(tmp_path / "out", None).surface
    assert isinstance(again, Rings)
    assert again.whole
    fields = {name: getattr(end, name) for name in ("pressure", "shear_radial")}
    write_surface(surface, fields, tmp_path / "surface.vtu", "")
    assert meshio.read(tmp_path / "surface.vtu").points.shape == (end.pressure.size, 3)
