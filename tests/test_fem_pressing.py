"""Tests of normal contact by finite elements: contact radius, mesh, overlap, paths and refusals."""

import numpy as np
import pytest
from contact_scenes import (
    INDENTERS,
    LOAD,
    PRESS,
    RIGID_BALL,
    YOUNG,
    A,
    push,
    scene,
    steel,
)
from fem_scenes import elements, end

import slipstick
from contact_scene import (
    RIGID,
    Body,
    FlatPunch,
    IsotropicMaterial,
    Layer,
    Paraboloid,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.quantities.summary import ContactStatus
from fem_reference import Method, Path, Result, plan, solve
from fem_reference.expected_radius import expected_radius

SMOOTH = scene(PRESS, friction=None)


@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("times", [250.0])
@pytest.mark.parametrize("shape", ["paraboloid", "cone", "flat punch"])
def test_contact_radius_that_is_too_large_does_not_decide_the_answer(shape, times, method):
    asked = scene(PRESS, friction=None, indenter=INDENTERS[shape])
    own = solve(asked, elements(32), method).increments[-1]
    large = elements(32, contact_radius=times * own.contact_radius)
    found = solve(asked, large, method).increments[-1]
    assert found.approach == pytest.approx(own.approach, rel=1e-3)
    assert found.contact_radius == pytest.approx(own.contact_radius, rel=5e-3)
    assert found.contact_radius / (found.radii[-1] - found.radii[0]) > 0.6


def on_film(ratio: float, thickness: float) -> Scene:
    """A rigid ball on a coating, by its modulus in those of what is below and its thickness."""
    film = Layer(thickness=thickness * A, material=steel(young_modulus=ratio * YOUNG))
    coated = Body(material=steel(), layers=(film,))
    return scene(PRESS, friction=None, indenter=RIGID_BALL, body=coated)


@pytest.mark.parametrize("method", Method)
def test_a_punch_that_a_stiff_coating_leaves_between_middle_and_rim_touches_less(
    method,
):
    """The coating bends below the punch: a disc and a ring at the rim touch, as on cells."""
    film = Layer(thickness=0.275 * A, material=steel(0.45, 18 * YOUNG))
    punch = FlatPunch(radius=A, material=RIGID)
    body = Body(material=steel(0.49), layers=(film,))
    asked = scene(PRESS, friction=None, indenter=punch, body=body)
    found = solve(asked, elements(32), method)
    assert found.radius == A
    on_cells = slipstick.solve(asked, "semi-analytical", SurfaceDiscretisation(cells=(96, 96)))
    exact = on_cells.steps[-1].contact_radius
    assert found.increments[-1].contact_radius == pytest.approx(exact, rel=0.05)
    assert exact < 0.6 * A


@pytest.mark.parametrize(
    ("ratio", "thickness"), [(0.05, 0.2), (0.05, 2.0), (20.0, 0.2), (20.0, 2.0), (1e-3, 1e-3)]
)
def test_mesh_fits_the_contact_of_a_coated_body(ratio, thickness):
    """So that the elements over the radius are as many as asked for, whatever the layers."""
    asked = on_film(ratio, thickness)
    found = end(asked)
    assert expected_radius(asked) == pytest.approx(found.contact_radius, rel=0.05)
    assert found.contact_radius / found.radii[1] == pytest.approx(16, rel=0.05)


def penalised(asked: Scene, per_radius: int = 16, **more) -> Result:
    """With a number of augmentations, whatever they leave."""
    if "augmentations" in more:
        more = {"overlap": 1.0, **more}
    return solve(asked, elements(per_radius, **more), method=Method.PENALTY)


def test_overlap_is_reported():
    """Springs alone overlap by p0/ε; augmentation leaves a small part of it."""
    asked = scene(PRESS, friction=None)
    springs, augmented = (penalised(asked, augmentations=n).increments[-1] for n in (0, 1))
    modulus = steel().plane_strain_modulus / 2
    stiffness = 10.0 * modulus * 16 / A
    assert springs.overlap == pytest.approx(springs.peak_pressure / stiffness, rel=1e-2)
    assert augmented.overlap < 0.1 * springs.overlap
    assert np.all(springs.gap >= 0)


TWIST = {"torque": 0.01}
FILM = Layer(thickness=A, material=steel())
HALF = IsotropicMaterial(young_modulus=1e9, poisson_ratio=0.5)


def coated_alike(*loading: dict) -> Scene:
    coating = {"material": steel(young_modulus=210e9), "layers": (FILM,)}
    indenter = Paraboloid(radius=0.018, **coating)
    return scene(*loading, indenter=indenter, body=Body(**coating))


PATHS = {
    "frictionless": (SMOOTH, Path.PRESSING),
    "rigid": (scene(PRESS, indenter=RIGID_BALL), Path.PRESSING_WITH_FRICTION),
    "incompressible": (scene(PRESS, indenter=RIGID_BALL, body=HALF), Path.PRESSING),
    "pushed": (scene(PRESS, push(0.5)), Path.SHEARING),
    "coupled": (scene(PRESS, push(0.5), indenter=RIGID_BALL), Path.HARMONICS),
    "twisted": (scene(PRESS, TWIST), Path.TWISTING),
    "coupled and twisted": (
        scene(PRESS, TWIST, indenter=RIGID_BALL),
        Path.TWISTING_WITH_FRICTION,
    ),
    "pushed and twisted": (scene(PRESS, push(0.3), TWIST), Path.WHOLE_CIRCLE),
    "turning": (scene(PRESS, push(0.3), push(0, 0.3)), Path.WHOLE_CIRCLE),
    "coupled and on one line": (
        scene(PRESS, push(0.2, 0.1), push(0.4, 0.2), indenter=RIGID_BALL),
        Path.HARMONICS,
    ),
    # A layer couples by itself, but not below its mirror image.
    "coated alike": (coated_alike(PRESS), Path.PRESSING),
    "coated alike, pushed": (coated_alike(PRESS, push(0.5)), Path.SHEARING),
}


@pytest.mark.parametrize(("asked", "path"), PATHS.values(), ids=PATHS)
def test_path_follows_the_scene(asked, path):
    assert plan(asked).path is path


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
def test_steps_are_cut_where_the_path_matters(loading, counts):
    assert plan(scene(*loading)).increments == counts


def test_a_coupled_push_takes_a_twentieth_of_the_limit_at_once():
    pushed = scene(PRESS, push(0.9), push(0.7), indenter=RIGID_BALL)
    assert plan(pushed).increments == (20, 18, 4)


@pytest.mark.parametrize("method", Method)
def test_a_contact_of_one_element_grows_to_the_friction_limit(method):
    """The first pressure of the iteration must carry the load: no neighbour corrects it."""
    force, friction = 1e-6 * LOAD, 0.3
    grown = {"normal_force": force, "tangential_force": (friction * force, 0.0)}
    asked = scene({"normal_force": force / 7}, grown, friction=friction, indenter=RIGID_BALL)
    found = end(asked, 4, method, contact_radius=0.27 * A)
    assert found.status is ContactStatus.GROSS_SLIDING
    assert found.normal_force == force
