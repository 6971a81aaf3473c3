"""Tests of normal contact by finite elements, against closed forms and laws."""

from pathlib import Path as FilePath

import numpy as np
import pytest
from contact_scenes import (
    INDENTERS,
    LIMIT,
    LOAD,
    MU,
    NU,
    PRESS,
    RADIUS,
    RIGID_BALL,
    YOUNG,
    A,
    hertz,
    paraboloid,
    push,
    scene,
    slide,
    steel,
)
from fem_scenes import both_laws, elements, end, solved

from contact_scene import (
    Body,
    CoulombFriction,
    Ellipsoid,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import (
    ContactNotResolved,
    GrossSliding,
    SurfacesOverlap,
    UnsupportedScene,
)
from fem_reference import ContactAtZoneEdge, Increment, Method, Path, Result, plan, solve
from fem_reference.expected_radius import expected_radius
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.hertz import tangential_modulus
from verification.closed_forms.torsion import TorsionalPartialSlip
from verification.quantities import shift_along_x

SMOOTH = scene(PRESS, friction=None)


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
        limit = mu * increment.pressure * (1 + 4 * np.finfo(float).eps)
        assert np.all(np.abs(increment.shear_radial) <= limit)


@both_laws
def test_unloading_dissipates_and_turns_the_shear(law: Method) -> None:
    there_and_back = scene(
        {**PRESS, "increments": 10},
        {"normal_force": 0.05 * LOAD, "increments": 15},
        indenter=RIGID_BALL,
        body=BODY,
    )
    found = solved(there_and_back, law=law).increments
    energy = [increment.dissipated_energy for increment in found]
    assert np.all(np.diff(energy) >= 0)
    assert np.min(found[-1].shear_radial) < 0
    assert max(increment.residuals.worst for increment in found) < 1e-10


# ---- Contact pushed sideways or twisted, by finite elements: partial slip and its memory.


G = steel().shear_modulus
HERTZ = hertz()
VIRGIN = PartialSlip(LOAD, A, MU, tangential_modulus((YOUNG, NU), (YOUNG, NU)), 0.0)
UNTWISTED = TorsionalPartialSlip(A, HERTZ.peak_pressure, MU, G / 2, A)
EXACT = Method.COMPLEMENTARITY
PENALTY = Method.PENALTY


def test_mirrored_load_has_the_mirrored_answer() -> None:
    right, left = end(scene(PRESS, push(0.7))), end(scene(PRESS, push(-0.7)))
    assert left.tangential_shift == pytest.approx([-x for x in right.tangential_shift])
    # The plan measures along the load, so that to it the two are one and the same.
    assert np.array_equal(left.shear_along_load, right.shear_along_load)
    back = end(scene(PRESS, push(0.2), push(-0.7)))
    forth = end(scene(PRESS, push(-0.2), push(0.7)))
    assert np.array_equal(back.shear_along_load, forth.shear_along_load)
    for last in (1.0, -1.0):
        assert end(scene(PRESS, push(0.2), push(last))).status is ContactStatus.GROSS_SLIDING


def test_oblique_load_is_the_same_along_its_line() -> None:
    along, oblique = end(scene(PRESS, push(0.5))), end(scene(PRESS, push(0.3, 0.4)))
    across = solved(scene(PRESS, push(0.0, 0.2), {**push(0.0, 0.5), "increments": 3}))
    forces = [each.tangential_force[1] / LIMIT for each in across.increments[-4:]]
    assert forces == pytest.approx([0.2, 0.3, 0.4, 0.5])
    assert oblique.shear_along_load == pytest.approx(along.shear_along_load, rel=1e-9, abs=1.0)
    x, y = oblique.tangential_shift
    assert np.hypot(x, y) == pytest.approx(shift_along_x(along), rel=1e-9)
    assert y / x == pytest.approx(4 / 3, rel=1e-12)


def test_force_and_shift_lead_to_the_same_state() -> None:
    by_force = end(scene(PRESS, push(0.7)))
    by_shift = end(scene(PRESS, {"tangential_shift": by_force.tangential_shift}))
    assert by_shift.tangential_force == pytest.approx((0.7 * LIMIT, 0.0), rel=1e-9)
    assert by_shift.shear_along_load == pytest.approx(by_force.shear_along_load, rel=1e-8, abs=1.0)


@both_laws
def test_sliding_contact_carries_all_that_friction_can(law: Method) -> None:
    sliding = end(scene(PRESS, {"tangential_shift": (3 * VIRGIN.sliding_shift, 0.0)}), law=law)
    assert sliding.status is ContactStatus.GROSS_SLIDING
    assert sliding.tangential_force[0] == pytest.approx(LIMIT, rel=1e-9)
    assert sliding.stick_radius == 0
    at_limit = end(scene(PRESS, push(1.0)), law=law)
    assert at_limit.status is ContactStatus.GROSS_SLIDING
    assert at_limit.tangential_shift is None
    assert at_limit.dissipated_energy is None
    assert at_limit.shear_along_load == pytest.approx(sliding.shear_along_load)


@both_laws
def test_gross_sliding_under_force_is_refused_by_name(law: Method) -> None:
    """Unloading by approach leaves too little pressure: nothing in the scene gives that away."""
    asked = scene(PRESS, push(0.5), {"approach": 0.2 * HERTZ.approach, "increments": 5})
    with pytest.raises(GrossSliding, match="prescribe tangential_shift instead") as caught:
        solved(asked, law=law)
    assert caught.value.where.startswith("step 3, increment")
    assert caught.value.last_state.tangential_force == (0.5 * LIMIT, 0.0)


def test_torque_and_twist_lead_to_the_same_state() -> None:
    torque = 0.6 * UNTWISTED.sliding_moment
    by_torque = end(scene(PRESS, {"torque": torque}))
    by_twist = end(scene(PRESS, {"twist": by_torque.twist}))
    assert by_twist.torque == pytest.approx(torque, rel=1e-9)
    with pytest.raises(GrossSliding, match="torque"):
        end(scene(PRESS, {"torque": 1.2 * UNTWISTED.sliding_moment}))


# The gap of springs is the small difference of a large overlap and their strain.
ROUND_OFF = {EXACT: 1e-11, PENALTY: 1e-10}


@both_laws
def test_sheared_equations_hold_to_round_off(law: Method) -> None:
    loop = scene(PRESS, push(0.9), push(-0.9), push(0.9))
    twisted = scene(PRESS, {"torque": 0.01}, {"torque": -0.01}, {"twist": 0.0})
    for asked in (loop, twisted):
        result = solved(asked, law=law)
        assert max(i.residuals.worst for i in result.increments) < ROUND_OFF[law]
        energy = [i.dissipated_energy for i in result.increments]
        assert np.all(np.diff(energy) >= 0)


# ---- Scenes solved with a penalty: closed forms, the error that a penalty makes, history, ref


def penalised(asked: Scene, per_radius: int = 16, **more) -> Result:
    """With a number of augmentations, whatever they leave."""
    if "augmentations" in more:
        more = {"overlap": 1.0, **more}
    return solve(asked, elements(per_radius, **more), method=Method.PENALTY)


def penalised_state(asked: Scene, per_radius: int = 16, **more) -> Increment:
    return penalised(asked, per_radius, **more).increments[-1]


@pytest.mark.parametrize("factor", [0.1, 1.0])
def test_penalty_does_not_decide_the_answer(factor: float) -> None:
    """Soft springs are corrected until they leave hardly any overlap."""
    asked = scene(PRESS, friction=None)
    found = penalised_state(asked, 32, penalty=factor)
    assert found.augmentations > 1
    assert found.overlap < 1e-3 * found.approach
    assert found.approach == pytest.approx(HERTZ.approach, rel=2e-4)
    assert found.peak_pressure == pytest.approx(HERTZ.peak_pressure, rel=5e-4)
    # An overlap of 1e-3 of the approach enlarges the contact by about as much, or an eighth of an
    # element.
    assert found.contact_radius == pytest.approx(A, abs=A / 32 / 8)


@pytest.mark.parametrize("augmentations", [0, 1])
def test_springs_that_leave_overlap_are_refused(augmentations: int) -> None:
    asked = scene({**PRESS, "increments": 2}, friction=None)
    with pytest.raises(SurfacesOverlap, match=r"larger penalty or more augmentations"):
        solve(asked, elements(penalty=0.1, augmentations=augmentations), method=Method.PENALTY)


@pytest.mark.parametrize("share", [0.5, 0.1, 0.01])
def test_residual_shear_is_unloaded_with_the_contact(share: float) -> None:
    """The displacement of residual shear is too small a scale for the strain of springs."""
    unload = {"normal_force": share * LOAD, "increments": 16}
    asked = scene(PRESS, push(0.4, increments=4), push(0.0, increments=4), unload)
    found = penalised(asked)
    exact = solve(asked, elements(), method=Method.COMPLEMENTARITY).steps[-1]
    last, hertz_approach = found.steps[-1], HERTZ.approach * share ** (2 / 3)
    assert last.approach == pytest.approx(hertz_approach, abs=1e-3 * HERTZ.approach)
    assert last.dissipated_energy == pytest.approx(exact.dissipated_energy, rel=0.08)
    largest = max(abs(step.tangential_shift[0]) for step in found.steps)
    assert last.tangential_shift == pytest.approx(exact.tangential_shift, abs=5e-3 * largest)


def test_overlap_is_reported() -> None:
    """Springs alone overlap by p0/ε; augmentation leaves a small part of it."""
    asked = scene(PRESS, friction=None)
    springs, augmented = (penalised_state(asked, augmentations=n) for n in (0, 1))
    modulus = steel().plane_strain_modulus / 2
    stiffness = 10.0 * modulus * 16 / A
    assert springs.overlap == pytest.approx(springs.peak_pressure / stiffness, rel=1e-2)
    assert augmented.overlap < 0.1 * springs.overlap
    assert np.all(springs.gap >= 0)


# ---- Which path a scene takes in the finite-element reference, and what is refused by name.


TWIST = {"torque": 0.01}
FILM = Layer(thickness=A, material=steel())
COATED = Body(material=steel(young_modulus=210e9), layers=(FILM,))
HALF = IsotropicMaterial(young_modulus=1e9, poisson_ratio=0.5)


def on_coating(*loading: dict) -> Scene:
    return Scene(
        indenter=paraboloid(),
        body=COATED,
        friction=CoulombFriction(coefficient=0.1),
        loading=[LoadStep(**step) for step in loading],
    )


@pytest.mark.parametrize(
    ("asked", "path"),
    [
        pytest.param(scene(PRESS, friction=None), Path.PRESSING, id="frictionless"),
        pytest.param(scene(PRESS), Path.PRESSING, id="alike"),
        pytest.param(scene(PRESS, indenter=RIGID_BALL), Path.PRESSING_WITH_FRICTION, id="rigid"),
        pytest.param(
            scene(PRESS, indenter=RIGID_BALL, body=HALF), Path.PRESSING, id="incompressible"
        ),
        pytest.param(on_coating(PRESS), Path.PRESSING_WITH_FRICTION, id="coated"),
        pytest.param(scene(PRESS, push(0.5)), Path.SHEARING, id="pushed"),
        pytest.param(scene(PRESS, slide(1)), Path.SHEARING, id="shifted"),
        pytest.param(scene(PRESS, push(0.5), indenter=RIGID_BALL), Path.HARMONICS, id="coupled"),
        pytest.param(on_coating(PRESS, push(0.5)), Path.HARMONICS, id="coated and pushed"),
        pytest.param(scene(PRESS, TWIST), Path.TWISTING, id="twisted"),
        pytest.param(
            scene(PRESS, TWIST, indenter=RIGID_BALL),
            Path.TWISTING_WITH_FRICTION,
            id="coupled and twisted",
        ),
        pytest.param(scene(PRESS, push(0.3), TWIST), Path.WHOLE_CIRCLE, id="pushed and twisted"),
        pytest.param(scene(PRESS, push(0.3), push(0, 0.3)), Path.WHOLE_CIRCLE, id="turning"),
        pytest.param(scene(PRESS, push(0.3), push(-0.3)), Path.SHEARING, id="reversing"),
        pytest.param(
            scene(PRESS, push(0.2, 0.1), push(0.4, 0.2), indenter=RIGID_BALL),
            Path.HARMONICS,
            id="coupled and on one line",
        ),
    ],
)
def test_path_follows_the_scene(asked: Scene, path: Path) -> None:
    assert plan(asked).path is path


def test_alike_coatings_leave_no_shear() -> None:
    """A layer couples by itself, but not below its mirror image."""
    coated = Paraboloid(radius=0.018, material=COATED.material, layers=COATED.layers)
    asked = on_coating(PRESS).model_copy(update={"indenter": coated})
    assert plan(asked).path is Path.PRESSING
    pushed = on_coating(PRESS, push(0.5)).model_copy(update={"indenter": coated})
    assert plan(pushed).path is Path.SHEARING


def test_neglected_slip_is_listed() -> None:
    """Mindlin's approximation is made where it is, and nowhere silently."""
    (cross,) = [
        e for e in plan(scene(PRESS, push(0.5))).effects if e.name == "slip across the load"
    ]
    assert not cross.on
    assert "neglected" in cross.why


@pytest.mark.parametrize(
    ("loading", "counts"),
    [
        pytest.param((PRESS, push(0.9), push(-0.9)), (1, 1, 1), id="reversal"),
        pytest.param((PRESS, push(0.3), {"normal_force": 500}), (1, 1, 20), id="less pressure"),
        pytest.param(({**PRESS, **push(0.3)},), (1,), id="both at once"),
        pytest.param(
            (PRESS, {"normal_force": 1100, **push(0.3)}), (1, 20), id="growing by more than µW"
        ),
        pytest.param(({**PRESS, "increments": 7}, push(0.3)), (7, 1), id="as asked"),
        pytest.param((PRESS, {"bulk_strain": (1e-5, 1e-5, 0.0)}), (20, 20), id="strain"),
    ],
)
def test_steps_are_cut_where_the_path_matters(loading, counts) -> None:
    assert plan(scene(*loading)).increments == counts


def test_a_coupled_push_takes_a_twentieth_of_the_limit_at_once() -> None:
    pushed = scene(PRESS, push(0.9), push(0.7), indenter=RIGID_BALL)
    assert plan(pushed).increments == (20, 18, 4)


@pytest.mark.parametrize(
    ("asked", "named"),
    [
        pytest.param(
            scene(PRESS, indenter=Ellipsoid(radii=(1e-2, 2e-2), material=steel())),
            "ellipsoid",
            id="ellipsoid",
        ),
        pytest.param(scene(PRESS, {"tilt": (1e-3, 0.0)}), "tilt", id="tilt"),
        pytest.param(scene(PRESS, {"moment": (0.0, 1e-3)}), "moment", id="moment"),
        pytest.param(
            scene(PRESS, {"moment": (0.0, 0.0)}, push(0.3), indenter=RIGID_BALL),
            "tilt",
            id="free to tilt",
        ),
        pytest.param(
            scene(PRESS, body=steel(young_modulus=1e3)).model_copy(
                update={"body": Body(material=steel(young_modulus=1e3), layers=(FILM,))}
            ),
            "shear moduli",
            id="contrast",
        ),
    ],
)
def test_what_is_not_axisymmetric_is_refused_by_name(asked: Scene, named: str) -> None:
    with pytest.raises(UnsupportedScene, match=named):
        plan(asked)


def test_maps_are_refused_by_name(tmp_path: FilePath) -> None:
    np.save(tmp_path / "map.npy", np.eye(16))
    rough = {
        "shape": "height_map",
        "file": str(tmp_path / "map.npy"),
        "spacing": 1e-4,
        "material": "rigid",
    }
    document, pushed = (scene(*steps).model_dump() for steps in ((PRESS,), (PRESS, push(0.5))))
    with pytest.raises(UnsupportedScene, match="height map"):
        plan(Scene.model_validate({**document, "indenter": rough}))
    patchy = {"coefficient": {"map": str(tmp_path / "map.npy"), "spacing": 1e-4}}
    with pytest.raises(UnsupportedScene, match="coefficient of friction is a map"):
        plan(Scene.model_validate({**pushed, "friction": patchy}))
