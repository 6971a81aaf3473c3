"""Solving with another plan than the scene's: effects forced on, or coupled one way only."""

import numpy as np
import pytest
from contact_scenes import PRESS, grid, paraboloid, push, slide
from contact_scenes import scene as alike_scene
from coupled_scenes import BALL, bulk, coated, press, scene
from coupled_scenes import push as coupled_push

from semi_analytical import Coupling, all_effects, one_way, plan, solve
from semi_analytical.operator.domain import WINDOW
from semi_analytical.plan import COMPUTED, EDGES, MIRROR_PLANES

TOLERANCE = 1e-8

REDUCED = {
    "frictionless": alike_scene(PRESS, friction=None),
    "rigid on elastic, frictionless": alike_scene(PRESS, friction=None, indenter=BALL),
    "no tangential load": alike_scene(PRESS),
    "pushed to and fro": alike_scene(PRESS, push(0.8), push(-0.8)),
    "shifted until it slides": alike_scene(PRESS, slide(0.5), slide(20), slide(0)),
    "turning": alike_scene(PRESS, push(0.5, increments=2), push(0, 0.5, increments=4)),
    "unloading": alike_scene(PRESS, push(0.3), {"normal_force": 500, "increments": 3}),
    "pushed, where bodies couple": scene(press(), coupled_push(0.5)),
    "coated alike": scene(
        PRESS, push(0.7), body=coated(), indenter=paraboloid().model_copy(update=dict(coated()))
    ),
}


def test_forcing_says_what_it_forces():
    decided = plan(REDUCED["frictionless"])
    forced = all_effects(decided)
    assert forced.coupling is Coupling.FULL
    assert forced.shear
    assert forced.increments == decided.increments
    changed = [e for e, old in zip(forced.effects, decided.effects, strict=True) if e != old]
    assert {e.name for e in changed} == {*COMPUTED, MIRROR_PLANES}
    assert all(e.on and "forced on" in e.why for e in changed if e.name in COMPUTED)
    assert forced.symmetry == WINDOW


def test_edges_are_not_known_of_bodies_of_which_one_way_of_coupling_is_left_out():
    decided = plan(scene(press(), coupled_push(0.5)), edge="last")
    assert decided.edge == "last"
    one = one_way(decided)
    assert one.edge == "off"
    assert not any(e.on for e in one.effects if e.name == EDGES)


def coupled_one_way(described, cells=48):
    return solve(described, grid(cells, 1.2), TOLERANCE, plan=one_way(plan(described)))


@pytest.mark.parametrize("body", [bulk(), coated()], ids=["homogeneous", "coated"])
def test_one_way_every_increment_obeys_friction(body):
    described = scene(press(), coupled_push(0.6), coupled_push(-0.6), press(0.7), body=body)
    lost = 0.0
    for increment in coupled_one_way(described).increments:
        assert increment.residuals.worst <= TOLERANCE
        assert np.any(increment.in_contact & ~increment.in_stick)
        assert increment.dissipated_energy >= lost
        lost = increment.dissipated_energy
    assert lost > 0
