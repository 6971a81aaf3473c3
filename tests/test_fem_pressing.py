"""Frictionless contact by finite elements, against closed forms and laws."""

import numpy as np
import pytest
from contact_scenes import (
    INDENTERS,
    LOAD,
    NU,
    PRESS,
    RADIUS,
    RIGID_BALL,
    YOUNG,
    A,
    scene,
)
from fem_scenes import both_laws, elements, end, solved

from contact_scene import Body, IsotropicMaterial, Layer, LoadStep, Paraboloid, Scene
from contact_scene.solver_errors import ContactNotResolved
from fem_reference import ContactAtZoneEdge, Method, solve
from fem_reference.expected_radius import expected_radius

SMOOTH = scene(PRESS, friction=None)


def test_force_and_approach_lead_to_the_same_contact() -> None:
    by_force = end(SMOOTH, contact_radius=A)
    by_approach = end(scene({"approach": by_force.approach}, friction=None), contact_radius=A)
    assert by_approach.normal_force == pytest.approx(LOAD, rel=1e-9)
    assert by_approach.pressure == pytest.approx(by_force.pressure, abs=1e-6 * LOAD / A**2)


@both_laws
@pytest.mark.parametrize("indenter", ["sphere", "paraboloid", "cone", "flat punch"])
def test_equations_hold_to_round_off(indenter: str, law: Method) -> None:
    found = end(scene(PRESS, friction=None, indenter=INDENTERS[indenter]), law=law)
    assert found.residuals.worst < 1e-12
    assert np.all(found.pressure >= 0)
    assert np.all(found.gap >= 0)
    assert not np.any(found.gap * found.pressure)


@both_laws
@pytest.mark.parametrize(("length", "stress"), [(1e-6, 1.0), (1e3, 1e-6), (1e-3, 1e3)])
def test_units_do_not_matter(length: float, stress: float, law: Method) -> None:
    """The same problem in other units of length and stress has the same answer."""
    body = IsotropicMaterial(young_modulus=YOUNG * stress, poisson_ratio=NU)
    other = Scene(
        indenter=Paraboloid(radius=RADIUS * length, material=body),
        body=Body(material=body),
        loading=[LoadStep(normal_force=LOAD * stress * length**2)],
    )
    one, two = end(SMOOTH, law=law), end(other, law=law)
    assert two.approach == pytest.approx(one.approach * length, rel=1e-10)
    assert two.contact_radius == pytest.approx(one.contact_radius * length, rel=1e-10)
    assert two.pressure / stress == pytest.approx(one.pressure, rel=1e-9, abs=1e-9 * LOAD / A**2)


@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("times", [250.0])
@pytest.mark.parametrize("shape", ["paraboloid", "cone", "flat punch"])
def test_contact_radius_that_is_too_large_does_not_decide_the_answer(
    shape: str, times: float, method: Method
) -> None:
    asked = scene(PRESS, friction=None, indenter=INDENTERS[shape])
    own = solve(asked, elements(32), method).increments[-1]
    large = elements(32, contact_radius=times * own.contact_radius)
    found = solve(asked, large, method).increments[-1]
    assert found.approach == pytest.approx(own.approach, rel=1e-3)
    assert found.contact_radius == pytest.approx(own.contact_radius, rel=5e-3)
    assert found.contact_radius / (found.radii[-1] - found.radii[0]) > 0.6


@both_laws
def test_contact_beyond_the_zone_asked_for_is_refused(law: Method) -> None:
    with pytest.raises(ContactAtZoneEdge, match="contact_radius") as caught:
        solved(SMOOTH, law=law, contact_radius=0.6 * A)
    assert caught.value.where == "step 1, increment 1 of 1"


def on_film(ratio: float, thickness: float) -> Scene:
    """A rigid ball on a coating, by its modulus in those of what is below and its thickness."""
    film = Layer(
        thickness=thickness * A,
        material=IsotropicMaterial(young_modulus=ratio * YOUNG, poisson_ratio=NU),
    )
    coated = Body(material=IsotropicMaterial(young_modulus=YOUNG, poisson_ratio=NU), layers=(film,))
    return Scene(indenter=RIGID_BALL, body=coated, loading=[LoadStep(**PRESS)])


@pytest.mark.parametrize(
    ("ratio", "thickness"), [(0.05, 0.2), (0.05, 2.0), (20.0, 0.2), (20.0, 2.0), (1e-3, 1e-3)]
)
def test_mesh_fits_the_contact_of_a_coated_body(ratio: float, thickness: float) -> None:
    """So that the elements over the radius are as many as asked for, whatever the layers."""
    asked = on_film(ratio, thickness)
    found = end(asked)
    assert expected_radius(asked) == pytest.approx(found.contact_radius, rel=0.05)
    assert found.contact_radius / found.radii[1] == pytest.approx(16, rel=0.05)


@both_laws
@pytest.mark.parametrize("friction", [None, 0.5])
def test_contact_smaller_than_a_ring_is_refused(friction: float | None, law: Method) -> None:
    asked = scene(PRESS, {"approach": 1e-10}, friction=friction, indenter=RIGID_BALL)
    with pytest.raises(ContactNotResolved, match="more elements per radius") as caught:
        solved(asked, law=law)
    assert caught.value.where.startswith("step 2, increment")
    assert 0 < caught.value.last_state.normal_force <= LOAD


# ---- Pressing with friction by finite elements: pressure and radial shear act on each other


BODY = IsotropicMaterial(young_modulus=YOUNG, poisson_ratio=NU)


@both_laws
@pytest.mark.parametrize("mu", [0.1, 1.0, 5.0])
@pytest.mark.parametrize("poisson_ratio", [-0.5, 0.0, 0.3, 0.45])
def test_equations_hold_however_strong_the_coupling(
    mu: float, poisson_ratio: float, law: Method
) -> None:
    body = IsotropicMaterial(young_modulus=YOUNG, poisson_ratio=poisson_ratio)
    asked = scene({**PRESS, "increments": 5}, indenter=RIGID_BALL, body=body, friction=mu)
    result = solved(asked, law=law, overlap=1.0)
    for increment in result.increments:
        assert increment.residuals.worst < 1e-10
        assert np.all(np.abs(increment.shear_radial) <= mu * increment.pressure)


@both_laws
def test_unloading_dissipates_and_turns_the_shear(law: Method) -> None:
    there_and_back = scene(
        {**PRESS, "increments": 10}, {"normal_force": 0.05 * LOAD, "increments": 15},
        indenter=RIGID_BALL, body=BODY,
    )  # fmt: skip
    found = solved(there_and_back, law=law).increments
    energy = [increment.dissipated_energy for increment in found]
    assert np.all(np.diff(energy) >= 0)
    assert np.min(found[-1].shear_radial) < 0
    assert max(increment.residuals.worst for increment in found) < 1e-10
