"""What a scene calls for: the effects, and into how many increments its steps are cut."""

import pytest
from contact_scenes import PRESS, RIGID_BALL, paraboloid, push, scene, slide, steel

from semi_analytical import Coupling, plan

ONE, MANY = False, True


def effects(*loading, **more) -> dict[str, bool]:
    return {effect.name: effect.on for effect in plan(scene(*loading, **more)).effects}


def test_effects_follow_the_scene():
    loop = effects(PRESS, push(0.5))
    assert loop["pressure"]
    assert loop["friction"]
    assert loop["tangential load"]
    assert loop["load history"]
    assert loop["second elastic body"]
    assert not loop["normal-tangential coupling"]
    assert not loop["layers"]
    smooth = effects(PRESS, friction=None, indenter=RIGID_BALL)
    assert not smooth["friction"]
    assert not smooth["tangential load"]
    assert not smooth["second elastic body"]


@pytest.mark.parametrize(
    ("loading", "cut"),
    [
        pytest.param((PRESS, push(0.9)), (ONE, ONE), id="one branch"),
        pytest.param((PRESS, push(0.9), push(-0.9)), (ONE, ONE, ONE), id="reversal"),
        pytest.param((PRESS, push(0.5), push(0, 0.5)), (ONE, ONE, MANY), id="turning"),
        pytest.param((PRESS, slide(1), slide(-1)), (ONE, ONE, ONE), id="shift"),
        pytest.param((PRESS, slide(1), slide(-1, 1e-16)), (ONE, ONE, ONE), id="round-off"),
        pytest.param((PRESS, slide(1), push(-0.5)), (ONE, ONE, ONE), id="taking over"),
        pytest.param((PRESS, slide(1), push(0, 0.5)), (ONE, ONE, MANY), id="over and turning"),
        pytest.param(
            (PRESS, push(0.3), {"normal_force": 500}), (ONE, ONE, MANY), id="unloading under shear"
        ),
        pytest.param(
            (PRESS, {"normal_force": 500}, push(0.3)), (ONE, ONE, ONE), id="unloading before shear"
        ),
        pytest.param(({**PRESS, **push(0.3)},), (MANY,), id="both at once"),
    ],
)
def test_steps_are_cut_only_where_the_path_matters(loading, cut):
    assert tuple(count > 1 for count in plan(scene(*loading)).increments) == cut


@pytest.mark.parametrize(
    ("indenter", "body"),
    [
        (RIGID_BALL, steel(0.3)),
        (paraboloid(steel(0.3)), steel(0.2)),
        (paraboloid(steel(0.3, 1e9)), steel(0.3)),
    ],
    ids=["rigid on elastic", "another Poisson's ratio", "another stiffness"],
)
def test_unlike_bodies_couple_where_there_is_friction(indenter, body):
    assert effects(PRESS, indenter=indenter, body=body)["normal-tangential coupling"]
    assert not effects(PRESS, indenter=indenter, body=body, friction=None)[
        "normal-tangential coupling"
    ]


@pytest.mark.parametrize(
    ("indenter", "body"),
    [
        (RIGID_BALL, steel(0.5)),
        (paraboloid(steel(0.5, 1e9)), steel(0.5)),
        (paraboloid(steel(0.3, 2e5 * 1e6)), steel(0.3, 200e9)),
        # (1 - 2 nu) / G equal, though both nu and G differ
        (paraboloid(steel(0.2, 1.2 * 0.6 / (1.3 * 0.4) * 1e9)), steel(0.3, 1e9)),
    ],
    ids=["rigid on incompressible", "both incompressible", "same in other units", "same ratio"],
)
def test_bodies_with_equal_ratios_do_not_couple(indenter, body):
    decided = plan(scene(PRESS, push(0.5), indenter=indenter, body=body))
    assert decided.shear
    assert decided.coupling is Coupling.NONE
