"""Tests of units and directions: neither changes a result."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import PRESS, A, scene
from fem_scenes import elements

import radial
import slipstick
from contact_results.stress.below_contact import body_response
from contact_results.stress.loaded_bodies import state_of_result
from contact_results.stress.stress_maxima import extremes
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from fem_reference import Method
from fem_reference import solve as solve_on_rings
from semi_analytical import SurfaceGrid, solve

nightly = [pytest.mark.slow, pytest.mark.timeout(3600)]
OF = {
    "approach": (1, 0),
    "peak_pressure": (0, 1),
    "contact_area": (2, 0),
    "stick_area": (2, 0),
    "dissipated_energy": (3, 1),
    "elastic_energy": (3, 1),
}
"""Powers of length and of stress."""


TO_AND_FRO = (1.0, -0.5)


def pushed(way, pose, angle, length, stress, parts=TO_AND_FRO):
    """The end of a contact of revolution that is pushed along a line by parts of a force."""
    push, rigid, film = pose
    force = 1e3 * stress * length**2

    def material(modulus: float) -> IsotropicMaterial:
        return IsotropicMaterial(young_modulus=210e9 * stress * modulus, poisson_ratio=0.3)

    def step(part: float) -> LoadStep:
        size = 0.1 * part * push * force
        along = (size * round(math.cos(angle), 15), size * round(math.sin(angle), 15))
        return LoadStep(tangential_force=along, increments=2)

    films = (Layer(thickness=2e-4 * length, material=material(film)),) if film else ()
    scene = Scene(
        indenter=Paraboloid(radius=0.018 * length, material=RIGID if rigid else material(1.0)),
        body=Body(material=material(1.0), layers=films),
        friction=CoulombFriction(coefficient=0.1),
        loading=(LoadStep(normal_force=force, increments=2), *map(step, parts)),
    )
    if way == "radial":
        return radial.solve(scene).steps[-1]
    if way == "semi-analytical":
        side = 1.2e-3 * length
        return solve(scene, SurfaceGrid((24, 24), (side, side)), 1e-10).steps[-1]
    mesh = FiniteElementDiscretisation(
        elements_per_radius=4, box=10.0, harmonics=2, tolerance=1e-10
    )
    return solve_on_rings(scene, mesh, way).steps[-1]


@pytest.mark.parametrize("way", ["radial", "semi-analytical", *Method])
@pytest.mark.parametrize("seed", [0, *(pytest.param(n, marks=nightly) for n in range(1, 20))])
def test_no_direction_and_no_unit_counts(way, seed):
    chance = random.Random(seed)
    # Iterations on turned cells take another path, and fits of edges magnify the difference.
    within = 1e-5 if way == "semi-analytical" else 1e-9
    pose = chance.uniform(0.2, 0.9), chance.random() < 0.5, chance.choice((0.0, 0.5, 2.0))
    angles = math.pi, math.pi / 2, chance.uniform(0, 2 * math.pi)
    angle = chance.choice(angles[: 2 if way == "semi-analytical" else 3])  # cells are squares
    length, stress = (10.0 ** chance.randint(-6, 6) for _ in range(2))
    there, here = pushed(way, pose, 0.0, 1.0, 1.0), pushed(way, pose, angle, length, stress)
    for name, (of_length, of_stress) in OF.items():
        if getattr(there, name) is not None:
            expected = getattr(there, name) * length**of_length * stress**of_stress
            assert getattr(here, name) == pytest.approx(expected, rel=within), name
    size = math.copysign(math.hypot(*there.tangential_shift), there.tangential_shift[0])
    for found, line in zip(here.tangential_shift, (math.cos(angle), math.sin(angle)), strict=True):
        assert found == pytest.approx(length * size * line, abs=within * abs(size) * length)
    # On cells a turned load turns the field.
    found, expected = (np.sort(end.pressure, axis=None) for end in (here, there))
    assert np.max(np.abs(found / stress - expected)) <= within * expected[-1]


@pytest.mark.parametrize("way", ["radial", "semi-analytical", *Method])
def test_nothing_sticks_at_the_friction_limit_of_the_softest_bodies(way):
    """The peak pressure is 1 mPa."""
    end = pushed(way, (1.0, False, 0.0), 0.0, 1.0, 1e-12, (1.0,))
    assert end.stick_area == 0
    assert not np.any(end.in_stick)


@pytest.mark.parametrize("way", ["radial", "semi-analytical", *Method])
@pytest.mark.parametrize("rigid", [False, True])
def test_a_power_of_two_as_unit_of_stress_changes_no_bit(way, rigid):
    """Only a number with a unit in the program would: the soft contact has pressures below 1."""
    unit = 2.0**-40
    stiff, soft = (pushed(way, (0.5, rigid, 0.5), 0.0, 1.0, stress) for stress in (1.0, unit))
    assert np.array_equal(stiff.pressure * unit, soft.pressure)
    assert (stiff.iterations, stiff.residuals) == (soft.iterations, soft.residuals)
    for name, (_, of_stress) in OF.items():
        assert getattr(soft, name) == getattr(stiff, name) * unit**of_stress, name


def test_a_largest_stress_of_elements_is_found_on_both_sides_of_the_load():
    """Shear like 1 + sin θ, and its mirror image."""
    state = state_of_result(slipstick.solve(scene(PRESS), "fem", elements(8)), None)
    pressure, radii = state.tractions["pressure"][:, None], state.axes["radii"][:, None] / A
    angles = np.arange(16) * np.pi / 8
    found = []
    for side in (-1, 1):
        shear = -0.5 * pressure * radii**2 * (1 + side * np.sin(angles))
        tractions = {"pressure": pressure + 0 * angles, "shear_radial": shear}
        one_sided = replace(state, tractions=tractions, axes={**state.axes, "angles": angles})
        largest = extremes(body_response(one_sided).stress())
        found.append(next(one for one in largest if one.measure == "max_principal"))
    left, right = found
    assert left.value == pytest.approx(right.value, rel=1e-6)
    assert left.y == pytest.approx(-right.y, rel=1e-6)
    assert abs(left.y) > 0.5 * A


@pytest.mark.parametrize("solver", ["radial", "fem"])
def test_a_largest_stress_is_found_in_whatever_plane_it_lies(solver):
    """Shear like cos 2θ, and the same turned by a right angle out of the plane of the load."""
    fineness = elements(8) if solver == "fem" else None
    state = state_of_result(slipstick.solve(scene(PRESS), solver, fineness), None)
    pressure, radii = state.tractions["pressure"], state.axes["radii"][:, None] / A
    angles = state.axes.get("angles", np.linspace(0, np.pi, 9))
    pressure = pressure if pressure.ndim > 1 else np.repeat(pressure[:, None], len(angles), axis=1)
    found = []
    for sign in (-1, 1):
        shear = sign * 0.5 * pressure * radii**2 * np.cos(2 * angles)
        tractions = {"pressure": pressure, "shear_radial": shear}
        turned = replace(state, tractions=tractions, axes={**state.axes, "angles": angles})
        largest = extremes(body_response(turned).stress())
        found.append(next(one for one in largest if one.measure == "max_principal"))
    inside, beside = found
    assert beside.value == pytest.approx(inside.value, rel=0.01)
    assert abs(beside.y) == pytest.approx(abs(inside.x), rel=0.01)
    assert abs(inside.y) < 1e-6 * A
