"""Which path a scene takes in the finite-element reference, and what is refused by name."""

from pathlib import Path as FilePath

import numpy as np
import pytest
from contact_scenes import PRESS, RIGID_BALL, A, paraboloid, push, scene, slide, steel

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
from contact_scene.solver_errors import UnsupportedScene
from fem_reference import Path, plan

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
        pytest.param(({**PRESS, **push(0.3)},), (20,), id="both at once"),
        pytest.param(({**PRESS, "increments": 7}, push(0.3)), (7, 1), id="as asked"),
    ],
)
def test_steps_are_cut_where_the_path_matters(loading, counts) -> None:
    assert plan(scene(*loading)).increments == counts


@pytest.mark.parametrize(
    ("asked", "named"),
    [
        pytest.param(
            scene(PRESS, indenter=Ellipsoid(radii=(1e-2, 2e-2), material=steel())), "ellipsoid",
            id="ellipsoid",
        ),
        pytest.param(scene(PRESS, {"tilt": (1e-3, 0.0)}), "tilt", id="tilt"),
        pytest.param(scene(PRESS, {"moment": (0.0, 1e-3)}), "moment", id="moment"),
        pytest.param(scene(PRESS, push(0.3), TWIST), "torsion", id="pushed and twisted"),
        pytest.param(scene(PRESS, TWIST, indenter=RIGID_BALL), "radial shear", id="coupled twist"),
        pytest.param(scene(PRESS, push(0.3), push(0, 0.3)), "one direction", id="turning"),
        pytest.param(
            scene(PRESS, {"moment": (0.0, 0.0)}, push(0.3), indenter=RIGID_BALL), "tilt freely",
            id="free to tilt",
        ),
        pytest.param(
            scene(PRESS, body=steel(young_modulus=1e3)).model_copy(
                update={"body": Body(material=steel(young_modulus=1e3), layers=(FILM,))}
            ),
            "shear moduli", id="contrast",
        ),
    ],
)  # fmt: skip
def test_what_is_not_axisymmetric_is_refused_by_name(asked: Scene, named: str) -> None:
    with pytest.raises(UnsupportedScene, match=named):
        plan(asked)


def test_maps_are_refused_by_name(tmp_path: FilePath) -> None:
    np.save(tmp_path / "map.npy", np.eye(16))
    rough = {"shape": "height_map", "file": str(tmp_path / "map.npy"), "spacing": 1e-4,
             "material": "rigid"}  # fmt: skip
    document = scene(PRESS).model_dump()
    with pytest.raises(UnsupportedScene, match="height map"):
        plan(Scene.model_validate({**document, "indenter": rough}))
    patchy = {"coefficient": {"map": str(tmp_path / "map.npy"), "spacing": 1e-4}}
    with pytest.raises(UnsupportedScene, match="friction is given as a map"):
        plan(Scene.model_validate({**document, "friction": patchy}))
