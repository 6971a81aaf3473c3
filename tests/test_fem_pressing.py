"""Frictionless contact by finite elements, against closed forms and laws."""

import sys

import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    INDENTERS,
    LOAD,
    NU,
    PRESS,
    RADIUS,
    RIGID_BALL,
    YOUNG,
    A,
    hertz,
    scene,
)
from fem_scenes import both_laws, elements, end, solved

from contact_scene import Body, IsotropicMaterial, Layer, LoadStep, Paraboloid, Scene
from contact_scene.solver_errors import ContactNotResolved, UnsupportedScene
from fem_reference import ContactAtZoneEdge, Method, solve
from fem_reference.expected_radius import expected_radius
from verification.closed_forms.cone import ConeContact
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.closed_forms.moduli import contact_modulus

MODULUS = contact_modulus((YOUNG, NU), (YOUNG, NU))
SMOOTH = scene(PRESS, friction=None)
# No ring of the mesh lies at the edge of the contact, as in any scene that nobody has solved yet.
APART = 0.97 * A


@both_laws
def test_hertz_contact(law: Method) -> None:
    found, exact = end(SMOOTH, law=law, contact_radius=APART), hertz()
    assert found.peak_pressure == pytest.approx(exact.peak_pressure, rel=1e-3)
    assert found.approach == pytest.approx(exact.approach, rel=1e-3)
    assert found.contact_radius == pytest.approx(exact.contact_radius, rel=2e-3)
    inside = found.radii < 0.8 * A
    error = found.pressure - exact.pressure(found.radii)
    assert np.max(np.abs(error[inside])) < 5e-3 * exact.peak_pressure


def test_error_falls_with_the_square_of_the_element() -> None:
    coarse, fine = (end(SMOOTH, n, contact_radius=A) for n in (16, 32))
    peak = hertz().peak_pressure
    ratio = (coarse.peak_pressure - peak) / (fine.peak_pressure - peak)
    assert ratio == pytest.approx(4, rel=0.15)


@both_laws
def test_cone(law: Method) -> None:
    exact = ConeContact.under_load(LOAD, INDENTERS["cone"].slope_angle, MODULUS)
    found = end(scene(PRESS, friction=None, indenter=INDENTERS["cone"]), law=law)
    assert found.contact_radius == pytest.approx(exact.contact_radius, rel=4e-3)
    assert found.approach == pytest.approx(exact.approach, rel=1e-3)


def test_flat_punch_ends_at_its_rim() -> None:
    exact = FlatPunchContact(A, MODULUS, LOAD)
    found = end(scene(PRESS, friction=None, indenter=INDENTERS["flat punch"]))
    assert found.contact_radius == A
    assert found.radii[-1] == pytest.approx(A, rel=1e-12)
    assert found.approach == pytest.approx(exact.approach, rel=2e-3)
    assert found.pressure[0] == pytest.approx(float(exact.pressure(0.0)), rel=4e-3)


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


def test_pressure_does_not_depend_on_the_way_there() -> None:
    back = end(scene({"normal_force": 2 * LOAD}, {"normal_force": LOAD}, friction=None),
               contact_radius=1.3 * A)  # fmt: skip
    once = end(SMOOTH, contact_radius=1.3 * A)
    assert back.pressure == pytest.approx(once.pressure, rel=1e-9, abs=1e-9)


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


def test_gap_is_taken_where_a_particle_was() -> None:
    """So the theory stays linear: with all stresses a thousandfold nothing but them changes. Taken
    where a particle is now, under a rigid ball 0.4 % of the force would come and go with strain."""
    soft = IsotropicMaterial(young_modulus=210e9, poisson_ratio=NU)
    ball = [Paraboloid(radius=r, material="rigid") for r in (RADIUS, 1e-3 * RADIUS)]
    flat, steep = (
        end(Scene(indenter=shape, body=Body(material=soft), loading=[LoadStep(normal_force=load)]))
        # Contact radius as before, approach and stress times a thousand.
        for shape, load in zip(ball, (LOAD, 1e3 * LOAD), strict=True)
    )
    assert steep.contact_radius == pytest.approx(flat.contact_radius, rel=1e-10)
    assert steep.approach == pytest.approx(1e3 * flat.approach, rel=1e-10)
    assert steep.peak_pressure == pytest.approx(1e3 * flat.peak_pressure, rel=1e-10)


def test_contact_that_outgrows_its_mesh_gets_a_larger_one(monkeypatch) -> None:
    whole = end(SMOOTH)
    monkeypatch.setattr(
        sys.modules["fem_reference.solve"], "meshed_radius", lambda scene, asked: 0.6 * A
    )
    found = end(SMOOTH)
    assert found.radii[-1] > A
    assert found.approach == pytest.approx(whole.approach, rel=1e-3)


@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("times", [2.5, 25.0, 250.0])
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


def test_radius_on_a_very_stiff_film_needs_no_section_of_many_decades(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """What suffices for the answer reaches to 300 000 contact radii, and takes its time."""
    asked = on_film(1e4, 0.3)
    short = expected_radius(asked)
    monkeypatch.setattr("fem_reference.expected_radius.LARGEST_COARSE_BOX", 1e20)
    assert short == pytest.approx(expected_radius(asked), rel=1e-6)


@both_laws
@pytest.mark.parametrize("friction", [None, 0.5])
def test_contact_smaller_than_a_ring_is_refused(friction: float | None, law: Method) -> None:
    asked = scene(PRESS, {"approach": 1e-10}, friction=friction, indenter=RIGID_BALL)
    with pytest.raises(ContactNotResolved, match="more elements per radius") as caught:
        solved(asked, law=law)
    assert caught.value.where.startswith("step 2, increment")
    assert 0 < caught.value.last_state.normal_force <= LOAD


def test_layers_that_are_too_thick_for_a_mesh_are_refused_by_name() -> None:
    for ratio in (1e-6, 1e6):
        with pytest.raises(UnsupportedScene, match="leave the substrate out"):
            solved(on_film(ratio, 1e12))


@both_laws
def test_same_bits_again(law: Method) -> None:
    one, two = end(SMOOTH, law=law), end(SMOOTH, law=law)
    assert np.array_equal(one.pressure, two.pressure)
    assert one.approach == two.approach


def test_approach_of_the_last_step_counts() -> None:
    steps = solved(scene({"approach": 0.5 * APPROACH}, {"approach": APPROACH}, friction=None)).steps
    assert [step.approach for step in steps] == [0.5 * APPROACH, APPROACH]
    assert steps[1].normal_force / steps[0].normal_force == pytest.approx(2**1.5, rel=5e-3)
