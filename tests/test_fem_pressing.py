"""Tests of normal contact by finite elements: contact radius, mesh, overlap, paths and refusals."""

import numpy as np
import pytest
from contact_scenes import (
    INDENTERS,
    LOAD,
    NU,
    PRESS,
    RIGID_BALL,
    YOUNG,
    A,
    paraboloid,
    push,
    scene,
    steel,
)
from fem_scenes import both_laws, elements, end, solved

from contact_scene import (
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
)
from contact_scene.solver_errors import (
    ContactNotResolved,
    SurfacesOverlap,
)
from fem_reference import ContactAtZoneEdge, Increment, Method, Path, Result, plan, solve
from fem_reference.expected_radius import expected_radius

SMOOTH = scene(PRESS, friction=None)


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


def penalised(asked: Scene, per_radius: int = 16, **more) -> Result:
    """With a number of augmentations, whatever they leave."""
    if "augmentations" in more:
        more = {"overlap": 1.0, **more}
    return solve(asked, elements(per_radius, **more), method=Method.PENALTY)


def penalised_state(asked: Scene, per_radius: int = 16, **more) -> Increment:
    return penalised(asked, per_radius, **more).increments[-1]


@pytest.mark.parametrize("augmentations", [0, 1])
def test_springs_that_leave_overlap_are_refused(augmentations: int) -> None:
    asked = scene({**PRESS, "increments": 2}, friction=None)
    with pytest.raises(SurfacesOverlap, match=r"larger penalty or more augmentations"):
        solve(asked, elements(penalty=0.1, augmentations=augmentations), method=Method.PENALTY)


def test_overlap_is_reported() -> None:
    """Springs alone overlap by p0/ε; augmentation leaves a small part of it."""
    asked = scene(PRESS, friction=None)
    springs, augmented = (penalised_state(asked, augmentations=n) for n in (0, 1))
    modulus = steel().plane_strain_modulus / 2
    stiffness = 10.0 * modulus * 16 / A
    assert springs.overlap == pytest.approx(springs.peak_pressure / stiffness, rel=1e-2)
    assert augmented.overlap < 0.1 * springs.overlap
    assert np.all(springs.gap >= 0)


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
        pytest.param(scene(PRESS, indenter=RIGID_BALL), Path.PRESSING_WITH_FRICTION, id="rigid"),
        pytest.param(
            scene(PRESS, indenter=RIGID_BALL, body=HALF), Path.PRESSING, id="incompressible"
        ),
        pytest.param(scene(PRESS, push(0.5)), Path.SHEARING, id="pushed"),
        pytest.param(scene(PRESS, push(0.5), indenter=RIGID_BALL), Path.HARMONICS, id="coupled"),
        pytest.param(scene(PRESS, TWIST), Path.TWISTING, id="twisted"),
        pytest.param(
            scene(PRESS, TWIST, indenter=RIGID_BALL),
            Path.TWISTING_WITH_FRICTION,
            id="coupled and twisted",
        ),
        pytest.param(scene(PRESS, push(0.3), TWIST), Path.WHOLE_CIRCLE, id="pushed and twisted"),
        pytest.param(scene(PRESS, push(0.3), push(0, 0.3)), Path.WHOLE_CIRCLE, id="turning"),
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


@pytest.mark.parametrize(
    ("loading", "counts"),
    [
        pytest.param((PRESS, push(0.9), push(-0.9)), (1, 1, 1), id="reversal"),
        pytest.param((PRESS, push(0.3), {"normal_force": 500}), (1, 1, 20), id="less pressure"),
        pytest.param(
            (PRESS, {"normal_force": 1100, **push(0.3)}), (1, 20), id="growing by more than µW"
        ),
        pytest.param((PRESS, {"bulk_strain": (1e-5, 1e-5, 0.0)}), (20, 20), id="strain"),
    ],
)
def test_steps_are_cut_where_the_path_matters(loading, counts) -> None:
    assert plan(scene(*loading)).increments == counts


def test_a_coupled_push_takes_a_twentieth_of_the_limit_at_once() -> None:
    pushed = scene(PRESS, push(0.9), push(0.7), indenter=RIGID_BALL)
    assert plan(pushed).increments == (20, 18, 4)
